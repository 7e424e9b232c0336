#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "camera/self_pixels.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_core {

/// A camera without distortion, in its optical frame C: x to the right of the image, y down, z forwards (REP 103). Pixel (u, v) sees
/// along ((u - cx) / fx, (v - cy) / fy, 1).
struct Pinhole {
  double fx, fy;  ///< [pixels]
  double cx, cy;  ///< [pixels]
};

/// How the depths of a camera are taken.
struct DepthOptions {
  double nearest = 0.1;   ///< smallest depth that counts [m], > 0
  double farthest = 4.0;  ///< largest [m], > nearest
  /// A surface counts as nearer to the camera by margin[0] + margin[1] z^2, z its depth: the error of the camera [m], [1/m], >= 0.
  std::array<double, 2> margin = {0.005, 0.003};
};

/// The surface that a depth camera sees, from image to image. A pixel without a depth is no vertex: no triangle at it exists. Nor does
/// one across a step, where something nearer ends in front of something else: between them nothing was seen. A step is what would be
/// a surface that one sees at less than 6 degrees.
///
/// While the camera rests, a pixel that shows the robot itself is a vertex where it was last before the robot hid it, and a pixel
/// whose depth changes by little has moved along its ray. A larger change says that something came or went.
///
/// Takes a pass over the pixels each for positions, triangles and motion, and allocates nothing once it is made.
class DepthSurface {
 public:
  /// @throws InvalidInput if camera or options are not as above, or not finite
  DepthSurface(const Grid& grid, const Pinhole& camera, const DepthOptions& options);

  /// Takes an image.
  /// @param depths  depth z of each pixel [m], row by row; NaN, infinite, or out of range: not seen
  /// @param X_FC    pose of the camera in the frame F of the surface [m]
  /// @param reach   largest distance by which a pixel moves along its ray from the image before [m], >= 0
  /// @param bodies_F  volumes around the bodies of the robot, see SelfPixels
  void take(const std::vector<float>& depths, const Eigen::Isometry3d& X_FC, double reach = 0.0,
            const std::vector<SweptVolume>& bodies_F = {});

  /// Returns the vertices at their places: x0 y0 z0 x1 ... in F [m]. Where nothing is seen, that of the place before, so
  /// that boxes around blocks stay small. TriangleMesh::deform() may exchange the buffer.
  std::vector<float>& places_F() { return places_F_; }
  /// Returns where the vertices were in the image before; where they are if they have not moved since, or came; the same.
  std::vector<float>& before_F() { return before_F_; }
  /// Returns for each cluster the bits of its triangles that exist; the same.
  std::vector<std::uint64_t>& existing() { return existing_; }
  size_t seen() const { return seen_; }          ///< pixels of the newest image that are vertices
  size_t self() const { return self_.count(); }  ///< pixels of the newest image that show the robot

 private:
  static constexpr size_t kColumns = Grid::kTileColumns;
  static constexpr size_t kRows = Grid::kTileRows;
  using Row = std::array<float, kColumns>;  // of a tile

  // With the pixels to its right and below it.
  struct Tile {
    std::array<std::array<float, kColumns + 1>, kRows + 1> depth;
    std::array<std::array<float, kColumns + 1>, kRows + 1> step;

    std::uint8_t joined(size_t row, size_t column, size_t other_row, size_t other_column) const;
    std::uint64_t triangles() const;
  };

  void findVertices(const std::vector<float>& depths, const Eigen::Isometry3d& X_FC);
  void readRow(const std::vector<float>& depths, std::uint32_t column, std::uint32_t row, size_t place);
  void setDepth(size_t place, float depth);
  void placeRow(const Eigen::Isometry3d& X_FC, std::uint32_t column, std::uint32_t row, size_t place);
  void forget();
  void hideSelf(const std::vector<SweptVolume>& bodies_F, const Eigen::Isometry3d& X_FC);
  void findMotion(double reach);
  void fillUnseen(const Eigen::Vector3d& p_FC);
  void findTriangles();
  Tile tileAt(std::uint32_t tile_column, std::uint32_t tile_row) const;

  const Grid grid_;
  const DepthOptions options_;
  const std::array<float, 2> margin_;
  const float slope_;                 // largest difference of depths between neighbors, by depth
  std::vector<double> x_;             // of a ray at depth 1, by column of the tiles
  std::vector<double> y_;             // by row
  std::vector<float> inverse_;        // of the length of a ray up to depth 1; this and the following at their places
  std::vector<float> depths_;         // NaN: not seen
  std::vector<float> steps_;          // smallest difference to a neighbor's depth that is a step [m]; NaN: not seen
  std::vector<float> remembered_;     // depth where a pixel last showed something else than the robot; NaN: never
  std::vector<float> depths_before_;  // of the image before
  std::vector<float> places_before_F_;
  std::vector<float> places_F_;
  std::vector<float> before_F_;
  std::vector<std::uint64_t> existing_;
  Eigen::Isometry3d X_FC_ = Eigen::Isometry3d::Identity();
  SelfPixels self_;
  size_t seen_ = 0;
};

}  // namespace sweep_guard_core
