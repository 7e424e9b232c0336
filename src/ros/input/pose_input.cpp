#include "ros/input/pose_input.h"

#include <boost/make_shared.hpp>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Reason;

constexpr auto kTransformMayBeLate = std::chrono::milliseconds(20);
constexpr size_t kMissingKept = 64;        // made-up frame names must not fill the memory
constexpr std::uint32_t kQueueLength = 0;  // no bound: a pose that ROS drops for another is a hole nobody hears of

struct PoseRefused : sweep_guard_core::InvalidInput {
  PoseRefused(Reason why, const std::string& story) : InvalidInput(story), reason(why) {}
  Reason reason;
};

class Call : public ros::CallbackInterface {
 public:
  explicit Call(std::function<void()> function) : function_(std::move(function)) {}
  CallResult call() override {
    function_();
    return Success;
  }

 private:
  std::function<void()> function_;
};

}  // namespace

PoseInput::PoseInput(const ros::NodeHandle& node, const Parameters& parameters, Frames& frames,
                     const WorkpieceStore& workpieces, sweep_guard_core::WarningMonitor& monitor, Sink sink)
    : fixed_frame_(parameters.fixed_frame),
      tool_frame_(parameters.tool_frame),
      frames_(frames),
      workpieces_(workpieces),
      monitor_(monitor),
      sink_(std::move(sink)) {
  if (parameters.tool_source == ToolSource::kTf) {
    transforms_changed_ = frames_.onChange([this] { onTransforms(); });
  } else {
    subscriber_ = thread_.on(node).subscribe("tool_pose", kQueueLength, &PoseInput::onMessage, this,
                                             ros::TransportHints().tcpNoDelay());
  }
}

std::string PoseInput::source() const {
  return subscriber_ ? subscriber_.getTopic() : "tf " + fixed_frame_ + " to " + tool_frame_;
}

std::optional<std::uint32_t> PoseInput::publishers() const {
  return subscriber_ ? std::optional(subscriber_.getNumPublishers()) : std::nullopt;
}

void PoseInput::onMessage(const geometry_msgs::PoseStamped& msg) {
  const sweep_guard_core::SteadyTime received = std::chrono::steady_clock::now();
  acceptOrRefuse({fromMsg(msg.header.stamp), received}, [&] {
    try {
      return Incoming{fromMsg(msg.header.stamp), received, msg.header.frame_id, fromMsg(msg.pose)};
    } catch (const sweep_guard_core::InvalidInput& error) {
      throw PoseRefused(sweep_guard_core::kPoseInvalid, error.what());
    }
  });
}

// Runs in the thread of the tf listener, which must not wait for transforms: the pose is only read here.
void PoseInput::onTransforms() {
  const std::optional<sweep_guard_core::Time> newest = frames_.newest(fixed_frame_, tool_frame_);
  if (newest == last_transform_) return;  // some other transform has changed
  last_transform_ = newest;
  if (!newest) return;
  try {
    const Incoming incoming{*newest, std::chrono::steady_clock::now(), fixed_frame_,
                            frames_.lookup(fixed_frame_, tool_frame_, *newest)};
    const sweep_guard_core::Timestamps seen{incoming.stamp, incoming.received};
    thread_.queue().addCallback(
        boost::make_shared<Call>([this, seen, incoming] { acceptOrRefuse(seen, [incoming] { return incoming; }); }));
  } catch (const FrameError& error) {
    record_.failed(error.what());
    monitor_.fault(sweep_guard_core::kTfFail, error.what());
  }
}

void PoseInput::acceptOrRefuse(const sweep_guard_core::Timestamps& seen, const std::function<Incoming()>& read) {
  record_.came(seen);
  try {
    accept(read());
  } catch (const PoseRefused& error) {
    refuse(error.reason, error.what());
  } catch (const FrameError& error) {
    refuse(sweep_guard_core::kTfFail, error.what());
  } catch (const std::exception& error) {  // no memory
    refuse(sweep_guard_core::kPoseInvalid, error.what());
  }
}

void PoseInput::refuse(Reason reason, const std::string& why) {
  record_.refused(why);
  monitor_.fault(reason, "tool pose refused: " + why);
  log_.error(std::to_string(reason), "tool pose on " + source() + " refused: " + why);
}

void PoseInput::accept(const Incoming& incoming) {
  const sweep_guard_core::WarningMonitor::Checkpoint came = monitor_.checkpoint();
  if (came.epoch != last_epoch_) last_.reset();
  last_epoch_ = came.epoch;
  checkStamp(incoming.stamp);
  const Eigen::Isometry3d X_WT = lookup(fixed_frame_, incoming.frame, incoming.stamp) * incoming.X_FT;
  last_ = incoming.stamp;
  sink_({{incoming.stamp, incoming.received, X_WT, locate(*workpieces_.frames(), incoming.stamp)}, came});
}

void PoseInput::checkStamp(sweep_guard_core::Time stamp) const {
  if (stamp == sweep_guard_core::Time())
    throw PoseRefused(sweep_guard_core::kPoseInvalid, "its stamp is 0: stamp each pose");
  if (liesInFuture(stamp)) {
    throw PoseRefused(sweep_guard_core::kFutureStamp, "its stamp lies in the future: are the clocks synchronised?");
  }
  if (last_ && stamp < *last_) {
    throw PoseRefused(sweep_guard_core::kOutOfOrder, "its stamp goes back behind the pose before");
  }
}

std::map<std::string, Eigen::Isometry3d> PoseInput::locate(const std::set<std::string>& mesh_frames,
                                                           sweep_guard_core::Time stamp) {
  std::map<std::string, Eigen::Isometry3d> X_WM;
  for (const std::string& frame : mesh_frames) {
    try {
      X_WM[frame] = lookup(fixed_frame_, frame, stamp);
    } catch (const FrameError& error) {
      record_.failed("workpieces in '" + frame + "' are not swept: " + error.what());
      monitor_.fault(sweep_guard_core::kTfFail, error.what());
      log_.error(frame, "workpieces in '" + frame + "' are not swept: " + error.what());
    }
  }
  return X_WM;
}

// Waits for a transform that is late, but not again for one whose publisher has gone silent: that would hold up every
// pose.
Eigen::Isometry3d PoseInput::lookup(const std::string& target, const std::string& source,
                                    sweep_guard_core::Time stamp) {
  const FramePair frames(target, source);
  const auto missed = missing_.find(frames);
  const bool silent = missed != missing_.end() && missed->second == frames_.newest(target, source);
  try {
    Eigen::Isometry3d X =
        frames_.lookup(target, source, stamp, silent ? sweep_guard_core::Duration(0) : kTransformMayBeLate);
    if (missed != missing_.end()) missing_.erase(missed);
    return X;
  } catch (const FrameError&) {
    if (missing_.size() >= kMissingKept) missing_.clear();
    missing_[frames] = frames_.newest(target, source);
    throw;
  }
}

}  // namespace sweep_guard_ros
