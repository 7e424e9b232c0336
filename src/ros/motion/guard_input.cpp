#include "ros/motion/guard_input.h"

#include <memory>

#include "common/frame_name.h"
#include "ros/connection/sole_publisher.h"
#include "ros/input/future_stamp.h"
#include "ros/motion/absent_guard.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InputRecord;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::PlaneSet;

constexpr std::uint32_t kGuardQueued = 1;  // only the newest counts
constexpr size_t kMaxPlanesSize = 64 << 20;
constexpr size_t kMaxPlanes = 64;  // as Proximity says

template <typename Msg>
Eigen::Vector3d vectorFrom(const Msg& msg) {
  return {msg.x, msg.y, msg.z};
}

void readPlanes(const sweep_guard::Proximity& msg, sweep_guard_core::SteadyTime received, PlaneSet& planes) {
  if (msg.planes.size() > kMaxPlanes) throw InvalidInput("there are more than 64 planes");
  planes.timestamps = {fromMsg(msg.header.stamp), received};
  planes.valid_until = fromMsg(msg.valid_until);
  planes.X_WT = fromMsg(msg.tool_pose);
  planes.complete = msg.valid;
  planes.tool_revision = msg.tool_revision;
  if (msg.joints.size() != msg.positions.size()) throw InvalidInput("there is not one position of each joint");
  planes.joints = msg.joints;
  planes.positions = msg.positions;
  planes.uncovered = {msg.uncovered_distance, msg.uncovered_speed};
  planes.planes.clear();
  for (const sweep_guard::SeparatingPlane& plane : msg.planes) {
    planes.planes.push_back({plane.piece, vectorFrom(plane.normal), vectorFrom(plane.point), plane.gap, plane.speed});
  }
  requireUsable(planes);
}

std::shared_ptr<const sweep_guard_core::ToolBalls> toolFrom(const sweep_guard::ToolBalls& msg) {
  auto tool = std::make_shared<sweep_guard_core::ToolBalls>();
  tool->revision = msg.revision;
  for (const sweep_guard::ToolPiece& piece : msg.pieces) {
    tool->pieces.emplace_back();
    tool->frames.push_back(piece.frame);
    for (const sweep_guard::ToolBall& ball : piece.balls) {
      tool->pieces.back().push_back({vectorFrom(ball.center), ball.radius});
    }
  }
  requireUsable(*tool);
  return tool;
}

}  // namespace

GuardInput::GuardInput(const ros::NodeHandle& node, const std::string& guard, const PoseSource& tool)
    : guard_(guard), fixed_frame_(tool.fixed_frame), tool_frame_(tool.frame), silence_(tool.silence) {
  planes_ = subscribe(node, guard + "/proximity", planes_record_, &GuardInput::acceptPlanes);
  tool_ = subscribe(node, guard + "/tool_balls", tool_record_, &GuardInput::acceptTool);
  warning_ = subscribe(node, guard + "/warning", warning_record_, &GuardInput::acceptWarning);
}

template <typename Msg>
BoundedSubscriber GuardInput::subscribe(const ros::NodeHandle& node, const std::string& topic, InputRecord& record,
                                        void (GuardInput::*accept)(const ros::MessageEvent<const Msg>&)) {
  return subscribeBounded<Msg>(
      thread_.on(node), {topic, kGuardQueued, kMaxPlanesSize},
      [this, topic, &record, accept,
       sole = SolePublisher(silence_)](const ros::MessageEvent<const Msg>& event) mutable {
        const sweep_guard_core::SteadyTime received = std::chrono::steady_clock::now();
        record.received({fromMsg(event.getConstMessage()->header.stamp), received});
        try {
          if (!sole.alone(event.getPublisherName(), received)) throw InvalidInput("several nodes publish it");
          (this->*accept)(event);
        } catch (const InvalidInput& error) {
          refuse(topic, error.what(), record);
        }
      },
      [this, topic, &record](const std::string& reason) { refuse(topic, reason, record); });
}

sweep_guard_core::MotionInputs GuardInput::inputs(sweep_guard::Proximity::ConstPtr* message) const {
  const sweep_guard_core::Lock lock(mutex_);
  if (message != nullptr) *message = newest_planes_;
  return newest_;
}

void GuardInput::report(DiagnosticsLine& line) const {
  using diagnostic_msgs::DiagnosticStatus;
  const std::string absent = absence();
  const bool is_there = absent.empty();
  line.summary(is_there ? DiagnosticStatus::OK : DiagnosticStatus::ERROR, is_there ? "received" : absent);
  reportTopic(planes_, planes_record_.summary(), is_there, line);
  reportTopic(tool_, tool_record_.summary(), is_there, line);
  reportTopic(warning_, warning_record_.summary(), is_there, line);
}

std::string GuardInput::absence() const { return warning_.getNumPublishers() > 0 ? "" : absentGuardText(guard_); }

void GuardInput::acceptPlanes(const ros::MessageEvent<const sweep_guard::Proximity>& event) {
  sweep_guard::Proximity::ConstPtr msg = event.getConstMessage();
  checkFrame(msg->header.frame_id, fixed_frame_);
  const auto planes = plane_sets_.take();
  readPlanes(*msg, std::chrono::steady_clock::now(), *planes);
  checkStamp(planes->timestamps);
  const sweep_guard_core::Lock lock(mutex_);
  newest_.planes = planes;
  newest_planes_.swap(msg);
}

void GuardInput::acceptTool(const ros::MessageEvent<const sweep_guard::ToolBalls>& event) {
  checkFrame(event.getConstMessage()->header.frame_id, tool_frame_);
  auto tool = toolFrom(*event.getConstMessage());
  const sweep_guard_core::Lock lock(mutex_);
  newest_.tool.swap(tool);
}

void GuardInput::acceptWarning(const ros::MessageEvent<const sweep_guard::Warning>& event) {
  const sweep_guard::Warning& msg = *event.getConstMessage();
  const bool known = msg.level <= sweep_guard::Warning::CONTACT;
  const auto level =
      known ? static_cast<sweep_guard_core::WarningLevel>(msg.level) : sweep_guard_core::WarningLevel::kUnknown;
  const sweep_guard_core::Lock lock(mutex_);
  newest_.warning =
      sweep_guard_core::MotionInputs::GuardWarning{level, known ? msg.reasons : 0U, std::chrono::steady_clock::now()};
}

// When time went back, those before are silent soon.
void GuardInput::checkStamp(sweep_guard_core::Timestamps& timestamps) const {
  if (liesInFuture(timestamps)) throw InvalidInput(kFutureStampText);
  const sweep_guard_core::Lock lock(mutex_);
  if (!newest_.planes) return;
  const sweep_guard_core::Timestamps& before = newest_.planes->timestamps;
  if (timestamps.stamp < before.stamp && timestamps.received - before.received <= silence_) {
    throw InvalidInput("stamp is older than that of the message before");
  }
}

void GuardInput::checkFrame(const std::string& frame, const std::string& expected) const {
  if (sweep_guard_core::isSameFrame(frame, expected)) return;
  throw InvalidInput("it is in the frame '" + sweep_guard_core::printable(frame) + "' and not in '" + expected +
                     "': set fixed_frame and tool_frame as those of the guard");
}

void GuardInput::refuse(const std::string& topic, const std::string& reason, InputRecord& record) {
  record.error(reason, /*refused=*/true);
  log_.error(topic, "message on " + topic + " refused: " + reason);
}

}  // namespace sweep_guard_ros
