#include "ros/scene/placed_message.h"

#include <cmath>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;

constexpr double kMaxOffNorm = 0.1;  // as of a tool pose

}  // namespace

PoseInMessage poseIn(const MessageValue& pose) {
  const auto part = [&](const char* field, const char* axis) { return pose[field][axis].number(); };
  const Eigen::Vector3d position(part("position", "x"), part("position", "y"), part("position", "z"));
  Eigen::Quaterniond rotation(part("orientation", "w"), part("orientation", "x"), part("orientation", "y"),
                              part("orientation", "z"));
  const bool is_unset = rotation.norm() == 0.0;
  if (is_unset) rotation = Eigen::Quaterniond::Identity();
  if (!position.allFinite()) throw InvalidInput("a position is NaN or infinite");
  if (!(std::abs(rotation.norm() - 1.0) <= kMaxOffNorm))
    throw InvalidInput("a quaternion has the norm " + std::to_string(rotation.norm()) + ": it has to be 1");
  return {Eigen::Translation3d(position) * rotation.normalized(), is_unset && position.isZero(0.0)};
}

sweep_guard_core::SceneObject objectAt(const MessageValue& header, const std::string& fallback) {
  sweep_guard_core::SceneObject object;
  object.frame = header["frame_id"].text();
  object.stamp = header["stamp"].time();
  if (object.frame.empty()) object.frame = fallback;
  if (object.frame.empty())
    throw InvalidInput("header.frame_id is empty: name the frame there, or as `frame` of this topic");
  return object;
}

}  // namespace sweep_guard_ros
