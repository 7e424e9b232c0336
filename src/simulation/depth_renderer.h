#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "camera/pinhole.h"
#include "detection/offscreen_context.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Triangles that a camera sees, from both sides.
struct VisibleSurface {
  Eigen::Isometry3d X_CS = Eigen::Isometry3d::Identity();  ///< pose in the camera's optical frame C [m]
  std::vector<float> positions_S;                          ///< x0 y0 z0 x1 ... [m]
  std::vector<sweep_guard_core::Triangle> triangles;
};

/// Renders depth images by OpenGL in software, without a window. One thread.
class DepthRenderer {
 public:
  static constexpr double kNearest = 0.05;  ///< [m]; what is nearer is not drawn
  static constexpr double kFarthest = 5.0;  ///< [m]

  /// @throws sweep_guard_core::DeviceError if there is no off-screen context, or it has no framebuffer of this size
  DepthRenderer(std::uint32_t width, std::uint32_t height, const sweep_guard_core::Pinhole& camera);

  /// Returns the depth z of each pixel [m], row by row; NaN where nothing is seen. Valid until the next call.
  /// @throws sweep_guard_core::DeviceError if OpenGL fails
  const std::vector<float>& render(const std::vector<VisibleSurface>& surfaces);

 private:
  void bindFramebuffer();

  const int width_;
  const int height_;
  const Eigen::Matrix4d projection_;
  std::unique_ptr<sweep_guard_core::OffscreenContext> context_;
  std::vector<float> depths_;
};

}  // namespace sweep_guard_simulation
