#include "sweep_guard/geometry/grid.h"

#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

static_assert(Grid::kTilePixels == simd::kBlock);
static_assert(2 * simd::kBlock == simd::kCluster);

Grid::Grid(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {
  if (width >= 2 && height >= 2 && std::uint64_t{width} * height <= kMaxPixels) return;
  throw InvalidInput("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels: must be at least 2 x 2, and at most 8388608 pixels");
}

std::vector<Triangle> Grid::triangles() const {
  const std::uint32_t columns = tileColumns() * kTileColumns;
  const std::uint32_t rows = tileRows() * kTileRows;
  std::vector<Triangle> triangles(2 * places());
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t corner = place(column, row);
      const bool inside = column + 1 < columns && row + 1 < rows;
      const std::uint32_t right = inside ? place(column + 1, row) : corner;
      const std::uint32_t below = inside ? place(column, row + 1) : corner;
      const std::uint32_t opposite = inside ? place(column + 1, row + 1) : corner;
      triangles[2 * size_t{corner}] = {corner, below, right};
      triangles[2 * size_t{corner} + 1] = {right, below, opposite};
    }
  }
  return triangles;
}

}  // namespace sweep_guard_core
