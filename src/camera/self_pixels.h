#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "camera/pinhole.h"
#include "sweep_guard/geometry/grid.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/vertex_blocks.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// An image, and the vertices that it shows.
struct SeenVertices {
  const std::vector<float>& places_F;  ///< of the vertices of a grid: x0 y0 z0 x1 ... [m]
  const std::vector<float>& depths;    ///< of the pixels [m], row by row; NaN: not seen
  size_t stride;                       ///< of its rows, at least the width of the grid
};

/// Finds the pixels that the robot itself hides: those that show what lies in the volumes around its bodies, and those that show
/// nothing where their ray comes to such a volume. Keeps its buffers.
class SelfPixels {
 public:
  SelfPixels(const Grid& grid, const Pinhole& camera) : grid_(grid), camera_(camera), tiles_(grid.tiles(), 0) {}

  /// Begins an image: no pixel is found yet.
  /// @param X_FC      pose of the camera [m]
  /// @param bodies_F  convex volumes around the bodies, as much larger as what is near to them counts as the robot
  void begin(const Eigen::Isometry3d& X_FC, const std::vector<SweptVolume>& bodies_F);

  /// Finds the pixels in a row of tiles, where a body may be in the picture. Several threads may call it at once, each
  /// for rows of its own: no vertex of another row is read.
  void find(const SeenVertices& seen, size_t tile_row);

  /// Returns for each tile of the grid a bit for each of its pixels.
  const std::vector<std::uint32_t>& tiles() const { return tiles_; }
  bool hides(std::uint32_t column, std::uint32_t row) const {
    const std::uint32_t place = grid_.place(column, row);
    return (tiles_[place / Grid::kTilePixels] >> place % Grid::kTilePixels & 1U) != 0;
  }
  size_t count() const;  ///< pixels found
  /// Calls function(column, row) with each of them.
  template <typename Function>
  void forEach(const Function& function) const {
    for (size_t tile = 0; tile < tiles_.size(); ++tile) {
      for (std::uint32_t left = tiles_[tile]; left != 0; left &= left - 1) {
        const auto [u, v] = grid_.pixel(tile, static_cast<std::uint32_t>(__builtin_ctz(left)));
        function(u, v);
      }
    }
  }

 private:
  // Where a body may be in the picture, and how far.
  struct PixelBounds {
    std::uint32_t left = 0, right = 0;     // columns, the last not included
    std::uint32_t top = 0, bottom = 0;     // rows
    double nearest = 0.0, farthest = 0.0;  // depths [m]
  };

  struct Body {
    SweptVolume volume_F;
    simd::Planes planes;
    PixelBounds bounds;
  };

  void addShown(const SeenVertices& seen, const Body& body, size_t tile);
  void addCast(const SeenVertices& seen, const Body& body, std::uint32_t row);
  PixelBounds boundsOf(const Eigen::Isometry3d& X_CB, const Eigen::Vector3d& half_extents) const;
  void add(std::uint32_t place) { tiles_[place / Grid::kTilePixels] |= std::uint32_t{1} << place % Grid::kTilePixels; }

  const Grid grid_;
  const Pinhole camera_;
  Eigen::Isometry3d X_FC_ = Eigen::Isometry3d::Identity();
  std::vector<Body> bodies_;
  std::vector<std::uint32_t> tiles_;
};

}  // namespace sweep_guard_core
