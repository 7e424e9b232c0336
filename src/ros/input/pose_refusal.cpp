#include "ros/input/pose_refusal.h"

#include "ros/input/frames.h"
#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/kinematics/joint_timeline.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Reason;
using sweep_guard_core::Time;
using sweep_guard_core::Timestamps;

struct RefusedStamp : sweep_guard_core::InvalidInput {
  RefusedStamp(Reason why, const std::string& message) : InvalidInput(message), reason(why) {}
  Reason reason;
};

}  // namespace

PoseRefusal caughtRefusal() {
  try {
    throw;
  } catch (const RefusedStamp& error) {
    return {error.reason, error.what()};
  } catch (const FrameError& error) {
    return {sweep_guard_core::kTfFail, error.what()};
  } catch (const sweep_guard_core::SeveralPublishers& error) {
    return {sweep_guard_core::kMultiPublisher, error.what()};
  } catch (const sweep_guard_core::OutOfOrder& error) {
    return {sweep_guard_core::kOutOfOrder, error.what()};
  } catch (const std::exception& error) {  // InvalidInput, or out of memory
    return {sweep_guard_core::kPoseInvalid, error.what()};
  }
}

void requireStamp(Timestamps& input) {
  if (input.stamp == Time()) throw RefusedStamp(sweep_guard_core::kPoseInvalid, "stamp is 0: stamp each pose");
  if (liesInFuture(input)) throw RefusedStamp(sweep_guard_core::kFutureStamp, kFutureStampText);
}

void requireStamp(Timestamps& input, const std::string& joint) {
  try {
    requireStamp(input);
  } catch (const RefusedStamp& error) {
    const std::string text = input.stamp == Time() ? "stamp is 0: stamp each message" : error.what();
    throw RefusedStamp(error.reason, "joint '" + sweep_guard_core::printable(joint) + "': " + text);
  }
}

void requireOrder(Time stamp, Time previous) {
  if (stamp < previous) throw RefusedStamp(sweep_guard_core::kOutOfOrder, "stamp is older than the previous pose's");
}

}  // namespace sweep_guard_ros
