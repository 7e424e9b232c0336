#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "camera/free_space.h"
#include "camera/self_pixels.h"
#include "common/pool.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_core {

/// Keeps what a camera shows to be free from image to image: what was free when the robot came before it stays so for a while.
class FreeMemory {
 public:
  /// @param stride    of the rows of the depths, >= the width of the grid
  /// @param remember  how long [s], >= 0
  FreeMemory(const Grid& grid, const Pinhole& camera, size_t stride, double remember);

  /// Begins an image.
  /// @param X_FC   pose of the camera [m]
  /// @param rests  the camera is where it was before
  /// @param since  time since the image before [s], >= 0
  void begin(const Eigen::Isometry3d& X_FC, bool rests, double since);

  /// Returns up to where the pixels of a row are free, for the image to be written into.
  float* row(size_t row) { return &newest_->depths[row * newest_->stride]; }

  /// Keeps what was free at a pixel that the robot hides. Up to the robot it is free, too.
  /// @param place  in the grid
  /// @param pixel  in the depths
  void keep(std::uint32_t place, size_t pixel);

  void end(const SelfPixels& self) { self_before_ = self.tiles(); }

  std::shared_ptr<const FreeSpace> newest() const { return newest_; }  ///< null before the first image

 private:
  const Grid grid_;
  const Pinhole camera_;
  const size_t stride_;
  const double remember_;
  double since_ = 0.0;  // the image before [s]
  Pool<FreeSpace> spaces_;
  std::shared_ptr<FreeSpace> newest_;
  std::shared_ptr<const FreeSpace> before_;  // null: nothing of it counts
  std::vector<float> hidden_for_;            // pixels that the robot hides [s]; means nothing for others
  std::vector<std::uint32_t> self_before_;   // SelfPixels::tiles() in the image before
};

}  // namespace sweep_guard_core
