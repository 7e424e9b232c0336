#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// A surface over the pixels of an image: a vertex at each pixel, two triangles between each four of them. In memory it
/// consists of tiles of kTileColumns x kTileRows pixels: a tile is a block of vertices (simd::kBlock), and the triangles whose
/// upper left pixel lies in it are a cluster (simd::kCluster). Tiles at the right and lower edge reach beyond the image; what
/// lies there is a vertex or a triangle that never exists.
class Grid {
 public:
  static constexpr std::uint32_t kTileColumns = 8;
  static constexpr std::uint32_t kTileRows = 4;
  static constexpr std::uint32_t kTilePixels = kTileColumns * kTileRows;
  static constexpr std::uint32_t kMaxPixels = 1U << 23U;

  /// @param width   in pixels, at least 2
  /// @param height  the same
  /// @throws InvalidInput if it is smaller, or has more than kMaxPixels pixels
  Grid(std::uint32_t width, std::uint32_t height);

  std::uint32_t width() const { return width_; }    ///< [pixels]
  std::uint32_t height() const { return height_; }  ///< [pixels]
  std::uint32_t tileColumns() const { return (width_ + kTileColumns - 1) / kTileColumns; }
  std::uint32_t tileRows() const { return (height_ + kTileRows - 1) / kTileRows; }
  /// Returns the number of tiles, which is that of blocks and of clusters: they are in rows from the top.
  size_t tiles() const { return size_t{tileColumns()} * tileRows(); }
  size_t places() const { return tiles() * simd::kBlock; }  ///< number of vertices

  /// Returns the place of a pixel's vertex; within the tiles, not checked.
  std::uint32_t place(std::uint32_t column, std::uint32_t row) const {
    const std::uint32_t tile = row / kTileRows * tileColumns() + column / kTileColumns;
    return tile * kTilePixels + row % kTileRows * kTileColumns + column % kTileColumns;
  }

  /// Returns the column and the row of a pixel of a tile; not checked.
  /// @param i  its place in the tile, below kTilePixels
  std::pair<std::uint32_t, std::uint32_t> pixel(size_t tile, std::uint32_t i) const {
    const auto number = static_cast<std::uint32_t>(tile);
    return {number % tileColumns() * kTileColumns + i % kTileColumns,
            number / tileColumns() * kTileRows + i / kTileColumns};
  }

  /// Returns the triangles at their places. Those of tile t begin at t * simd::kCluster, two for each of its pixels: 2 i and
  /// 2 i + 1 of pixel i. Counter-clockwise as the camera sees them. What reaches beyond the tiles has three equal corners.
  std::vector<Triangle> triangles() const;

 private:
  std::uint32_t width_;
  std::uint32_t height_;
};

}  // namespace sweep_guard_core
