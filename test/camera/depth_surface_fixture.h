#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

#include "camera/depth_surface.h"
#include "scenes.h"
#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

constexpr std::uint32_t kWidth = 53;
constexpr std::uint32_t kHeight = 38;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr Pinhole kCamera{60.0, 58.0, 25.7, 18.2};
constexpr DepthOptions kExact{0.1, 4.0, {0.0, 0.0}};

inline std::vector<float> wall(float depth) { return std::vector<float>(kWidth * kHeight, depth); }

inline float& at(std::vector<float>& depths, std::uint32_t column, std::uint32_t row) {
  return depths[row * kWidth + column];
}

// With another depth in the pixel at the center of the picture.
inline std::vector<float> withSpot(std::vector<float> depths, float depth) {
  at(depths, 26, 18) = depth;
  return depths;
}

inline Eigen::Vector3d onRay(std::uint32_t column, std::uint32_t row, double depth) {
  return {depth * (column - kCamera.cx) / kCamera.fx, depth * (row - kCamera.cy) / kCamera.fy, depth};
}

class DepthSurfaceTest : public testing::Test {
 protected:
  TriangleMesh take(const std::vector<float>& depths, const Eigen::Isometry3d& X_FC = Eigen::Isometry3d::Identity(),
                    const DepthOptions& options = kExact) {
    DepthSurface surface(grid_, kCamera, options);
    surface.take(depths, X_FC);
    TriangleMesh mesh_F(grid_);
    mesh_F.deform(surface.places_F(), surface.before_F(), surface.existing());
    return mesh_F;
  }

  static std::set<std::set<std::uint32_t>> trianglesOf(const TriangleMesh& mesh) {
    std::set<std::set<std::uint32_t>> all;
    Submesh(mesh).forEachTriangle([&](std::uint32_t i) {
      const Triangle& triangle = mesh.triangles()[i];
      all.insert({triangle.begin(), triangle.end()});
    });
    return all;
  }

  const Grid grid_{kWidth, kHeight};
};

// The middle of a box of 0.1 m at the center of the picture.
inline SweptVolume boxAt(double depth) {
  SweptVolume box;
  box.box.X_MB = placedAt(0.0, 0.0, depth);
  box.box.half_extents = Eigen::Vector3d::Constant(0.05);
  return box;
}

// Of two images of a wall, with the same pose of the camera unless it is stated.
class DepthMotionTest : public DepthSurfaceTest {
 protected:
  Eigen::Vector3d before(std::uint32_t column, std::uint32_t row) {
    return Eigen::Map<const Eigen::Vector3f>(&surface_.before_F()[3 * size_t{grid_.place(column, row)}]).cast<double>();
  }
  Eigen::Vector3d now(std::uint32_t column, std::uint32_t row) {
    return Eigen::Map<const Eigen::Vector3f>(&surface_.places_F()[3 * size_t{grid_.place(column, row)}]).cast<double>();
  }
  void take(const std::vector<float>& depths, double reach, const std::vector<SweptVolume>& bodies = {}) {
    surface_.take(depths, X_FC_, reach, bodies);
  }

  DepthSurface surface_{grid_, kCamera, kExact};
  // A robot before a wall, in one pixel.
  void takeRobotBefore(float depth) { take(withSpot(wall(depth), 0.5F), 0.0, {boxAt(0.5)}); }

  Eigen::Isometry3d X_FC_ = Eigen::Isometry3d::Identity();
};

}  // namespace sweep_guard_core
