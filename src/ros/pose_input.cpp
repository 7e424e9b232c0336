#include "sweep_guard/ros/pose_input.h"

#include <ros/console.h>

#include <boost/make_shared.hpp>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Reason;

constexpr auto kFutureTolerance = std::chrono::milliseconds(50);
constexpr auto kTransformMayBeLate = std::chrono::milliseconds(20);
constexpr size_t kMissingKept = 64;  // made-up frame names must not fill the memory
constexpr int kQueueLength = 4096;  // 4 s at 1 kHz

struct PoseRefused : sweep_guard::InvalidInput {
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
                     const WorkpieceStore& workpieces, sweep_guard::Ledger& ledger, Sink sink)
    : fixed_frame_(parameters.fixed_frame),
      tool_frame_(parameters.tool_frame),
      frames_(frames),
      workpieces_(workpieces),
      ledger_(ledger),
      sink_(std::move(sink)) {
  if (parameters.tool_source == ToolSource::kTf) {
    transforms_changed_ = frames_.buffer()._addTransformsChangedListener([this] { onTransforms(); });
  } else {
    subscriber_ = thread_.on(node).subscribe("tool_pose", kQueueLength, &PoseInput::onMessage, this,
                                             ros::TransportHints().tcpNoDelay());
  }
}

PoseInput::~PoseInput() { frames_.buffer()._removeTransformsChangedListener(transforms_changed_); }

std::string PoseInput::source() const {
  return subscriber_ ? subscriber_.getTopic() : "tf " + fixed_frame_ + " to " + tool_frame_;
}

int PoseInput::publisherCount() const { return subscriber_ ? static_cast<int>(subscriber_.getNumPublishers()) : 0; }

void PoseInput::onMessage(const geometry_msgs::PoseStamped& msg) {
  const sweep_guard::SteadyTime received = std::chrono::steady_clock::now();
  acceptOrRefuse([&] {
    try {
      return Incoming{fromMsg(msg.header.stamp), received, msg.header.frame_id, fromMsg(msg.pose)};
    } catch (const sweep_guard::InvalidInput& error) {
      throw PoseRefused(sweep_guard::kPoseInvalid, error.what());
    }
  });
}

// Runs in the thread of the tf listener, which must not wait for transforms: the pose is only read here.
void PoseInput::onTransforms() {
  try {
    const auto transform = frames_.buffer().lookupTransform(fixed_frame_, tool_frame_, ros::Time(0));
    const Incoming incoming{fromMsg(transform.header.stamp), std::chrono::steady_clock::now(), fixed_frame_,
                            fromMsg(transform.transform)};
    thread_.queue().addCallback(boost::make_shared<Call>([this, incoming] {
      if (last_ && incoming.stamp <= *last_ && last_epoch_ == epoch_) return;  // some other transform has changed
      acceptOrRefuse([&] { return incoming; });
    }));
  } catch (const tf2::TransformException& error) {
    ledger_.fault(sweep_guard::kTfFail, std::string("no tool pose in tf: ") + error.what());
  } catch (const sweep_guard::InvalidInput& error) {
    ledger_.fault(sweep_guard::kTfFail, std::string("tool pose in tf is not rigid: ") + error.what());
  }
}

void PoseInput::acceptOrRefuse(const std::function<Incoming()>& read) {
  ++received_;
  try {
    accept(read());
  } catch (const PoseRefused& error) {
    refuse(error.reason, error.what());
  } catch (const FrameError& error) {
    refuse(sweep_guard::kTfFail, error.what());
  }
}

void PoseInput::refuse(Reason reason, const std::string& story) {
  ++refused_;
  ledger_.fault(reason, "tool pose refused: " + story);
  ROS_ERROR_THROTTLE(1.0, "tool pose on %s refused: %s", source().c_str(), story.c_str());
}

void PoseInput::accept(const Incoming& incoming) {
  const std::uint64_t epoch = epoch_;
  if (epoch != last_epoch_) last_.reset();
  last_epoch_ = epoch;
  checkStamp(incoming.stamp);
  const std::uint64_t faults_before = ledger_.faultCount();
  const Eigen::Isometry3d X_WT = lookup(fixed_frame_, incoming.frame, incoming.stamp) * incoming.X_FT;
  last_ = incoming.stamp;
  auto X_MT = placeIn(workpieces_.frames(), incoming.stamp, X_WT);
  sink_({{incoming.stamp, incoming.received, std::move(X_MT)}, X_WT, faults_before, epoch});
}

void PoseInput::checkStamp(sweep_guard::Time stamp) const {
  if (stamp == sweep_guard::Time()) throw PoseRefused(sweep_guard::kPoseInvalid, "its stamp is 0: stamp each pose");
  if (stamp > now().stamp + kFutureTolerance) {
    throw PoseRefused(sweep_guard::kFutureStamp, "its stamp lies in the future: are the clocks synchronised?");
  }
  if (last_ && stamp < *last_) {
    throw PoseRefused(sweep_guard::kOutOfOrder, "its stamp goes back behind the pose before");
  }
}

std::map<std::string, Eigen::Isometry3d> PoseInput::placeIn(const std::set<std::string>& mesh_frames,
                                                            sweep_guard::Time stamp, const Eigen::Isometry3d& X_WT) {
  std::map<std::string, Eigen::Isometry3d> X_MT;
  for (const std::string& frame : mesh_frames) {
    try {
      X_MT[frame] = lookup(frame, fixed_frame_, stamp) * X_WT;
    } catch (const FrameError& error) {
      ledger_.fault(sweep_guard::kTfFail, error.what());
      ROS_ERROR_THROTTLE(1.0, "workpieces in '%s' are not swept: %s", frame.c_str(), error.what());
    }
  }
  return X_MT;
}

// Waits for a transform that may be late, but not again for one that did not come: that would hold up every pose.
Eigen::Isometry3d PoseInput::lookup(const std::string& target, const std::string& source, sweep_guard::Time stamp) {
  const std::pair<std::string, std::string> frames(target, source);
  const bool awaited = missing_.count(frames) == 0;
  if (missing_.size() >= kMissingKept) missing_.clear();
  missing_.insert(frames);
  const Eigen::Isometry3d X =
      frames_.lookup(target, source, stamp, awaited ? kTransformMayBeLate : sweep_guard::Duration(0));
  missing_.erase(frames);
  return X;
}

}  // namespace sweep_guard_ros
