#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "camera/pinhole.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_core {

/// Up to where the rays of a camera are known to meet no surface. What is behind a surface, out of the picture, or where the camera
/// saw nothing, is not known to be free.
struct FreeSpace {
  Eigen::Isometry3d X_CF =
      Eigen::Isometry3d::Identity();  ///< inverse pose of the camera in the frame F of its surface [m]
  Pinhole camera = {};
  std::uint32_t width = 0;    ///< of the picture [pixel]
  std::uint32_t height = 0;   ///< [pixel]
  size_t stride = 0;          ///< of the rows of `depths`, >= width
  std::vector<float> depths;  ///< up to which each pixel is free, row by row [m]; NaN: it is not known

  /// Returns whether a point is known to be free [m]: its pixel, and the eight beside it, are free up to its depth. Between rays that
  /// are so close, a surface as large as a pixel does not hide.
  bool contains(const Eigen::Vector3d& p_F) const;
};

}  // namespace sweep_guard_core
