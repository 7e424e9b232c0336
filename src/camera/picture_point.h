#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sweep_guard_core {

/// What a point of a picture is: a surface that is seen now, one that the robot hides, where it was seen last, or the robot itself.
enum class PointKind : std::uint8_t { kSeen, kRemembered, kSelf };

/// A point that a camera's picture has, for displays.
struct PicturePoint {
  Eigen::Vector3f p_F;  ///< [m]
  PointKind kind;
};

}  // namespace sweep_guard_core
