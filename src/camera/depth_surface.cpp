#include "camera/depth_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr double kSteepest = 10.0;  // tangent of the angle between a surface that is seen and the image

void check(bool right, const char* problem) {
  if (!right) throw InvalidInput(problem);
}

void checkCamera(const Pinhole& camera) {
  check(camera.fx > 0.0 && camera.fy > 0.0 && std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy),
        "the camera has no focal length, or one that is negative, NaN or infinite: it is not calibrated");
}

void checkOptions(const DepthOptions& options) {
  check(options.nearest > 0.0 && options.farthest > options.nearest && std::isfinite(options.farthest),
        "the range of a camera begins above 0 and ends above its begin [m]");
  check(options.margin[0] >= 0.0 && options.margin[1] >= 0.0 && std::isfinite(options.margin[0] + options.margin[1]),
        "the margin of a camera is at least 0 and finite");
}

}  // namespace

DepthSurface::DepthSurface(const Grid& grid, const Pinhole& camera, const DepthOptions& options)
    : grid_(grid),
      options_(options),
      margin_{static_cast<float>(options.margin[0]), static_cast<float>(options.margin[1])},
      slope_(static_cast<float>(kSteepest * std::hypot(1.0 / camera.fx, 1.0 / camera.fy))),
      inverse_(grid.places()),
      depths_(grid.places(), kNothing),
      steps_(grid.places(), kNothing),
      remembered_(grid.places(), kNothing),
      depths_before_(grid.places(), kNothing),
      places_before_F_(3 * grid.places(), 0.0F),
      places_F_(3 * grid.places(), 0.0F),
      before_F_(3 * grid.places(), 0.0F),
      existing_(grid.tiles(), 0) {
  checkCamera(camera);
  checkOptions(options);
  for (size_t u = 0; u < grid.tileColumns() * kColumns; ++u)
    x_.push_back((static_cast<double>(u) - camera.cx) / camera.fx);
  for (size_t v = 0; v < size_t{grid.tileRows()} * Grid::kTileRows; ++v)
    y_.push_back((static_cast<double>(v) - camera.cy) / camera.fy);
  for (std::uint32_t v = 0; v < y_.size(); ++v) {
    for (std::uint32_t u = 0; u < x_.size(); ++u)
      inverse_[grid.place(u, v)] = static_cast<float>(1.0 / std::hypot(x_[u], y_[v], 1.0));
  }
}

void DepthSurface::take(const std::vector<float>& depths, const Eigen::Isometry3d& X_FC, double reach,
                        const std::vector<SweptVolume>& bodies_F) {
  assert(depths.size() == size_t{grid_.width()} * grid_.height());
  if (X_FC.matrix() != X_FC_.matrix()) forget();
  X_FC_ = X_FC;
  findVertices(depths, X_FC);
  hideSelf(bodies_F, X_FC);
  fillUnseen(X_FC.translation());
  findTriangles();
  findMotion(reach);
}

// Where the camera goes, its pixels show something else.
void DepthSurface::forget() {
  std::fill(remembered_.begin(), remembered_.end(), kNothing);
  std::fill(depths_before_.begin(), depths_before_.end(), kNothing);
}

void DepthSurface::findVertices(const std::vector<float>& depths, const Eigen::Isometry3d& X_FC) {
  for (std::uint32_t row = 0; row < y_.size(); ++row) {
    for (std::uint32_t column = 0; column < x_.size(); column += kColumns) {
      const std::uint32_t place = grid_.place(column, row);
      readRow(depths, column, row, place);
      placeRow(X_FC, column, row, place);
    }
  }
}

void DepthSurface::hideSelf(const std::vector<SweptVolume>& bodies_F, const Eigen::Isometry3d& X_FC) {
  self_.find(places_F_, bodies_F);
  for (std::uint32_t row = 0; self_.count() > 0 && row < y_.size(); ++row) {
    for (std::uint32_t column = 0; column < x_.size(); column += kColumns) {
      const std::uint32_t place = grid_.place(column, row);
      const auto hidden = self_.tiles()[place / Grid::kTilePixels] >> place % Grid::kTilePixels & 0xFFU;
      if (hidden == 0) continue;
      for (size_t i = 0; i < kColumns; ++i) {
        if ((hidden >> i & 1U) != 0) setDepth(place + i, remembered_[place + i]);
      }
      placeRow(X_FC, column, row, place);
    }
  }
  std::transform(depths_.begin(), depths_.end(), remembered_.begin(), remembered_.begin(),
                 [](float depth, float before) { return std::isnan(depth) ? before : depth; });
}

void DepthSurface::findMotion(double reach) {
  const auto most = static_cast<float>(reach);
  for (size_t place = 0; place < depths_.size(); ++place) {
    const bool goes_on = std::abs(depths_[place] - depths_before_[place]) <= most * inverse_[place];
    std::copy_n(&(goes_on ? places_before_F_ : places_F_)[3 * place], 3, &before_F_[3 * place]);
  }
  depths_before_ = depths_;
  places_before_F_ = places_F_;
}

void DepthSurface::readRow(const std::vector<float>& depths, std::uint32_t column, std::uint32_t row, size_t place) {
  const auto nearest = static_cast<float>(options_.nearest);
  const auto farthest = static_cast<float>(options_.farthest);
  Row read;
  read.fill(kNothing);
  const std::uint32_t count = row < grid_.height() ? std::min<std::uint32_t>(kColumns, grid_.width() - column) : 0;
  std::copy_n(depths.data() + (count == 0 ? 0 : size_t{row} * grid_.width() + column), count, read.data());
  for (size_t i = 0; i < kColumns; ++i)
    setDepth(place + i, read[i] >= nearest && read[i] <= farthest ? read[i] : kNothing);
}

void DepthSurface::setDepth(size_t place, float depth) {
  depths_[place] = depth;
  steps_[place] = slope_ * depth + 2.0F * (margin_[0] + margin_[1] * depth * depth);
}

void DepthSurface::placeRow(const Eigen::Isometry3d& X_FC, std::uint32_t column, std::uint32_t row, size_t place) {
  const Eigen::Vector3d across = X_FC.linear().col(0);
  const Eigen::Vector3d ahead = y_[row] * X_FC.linear().col(1) + X_FC.linear().col(2);
  for (size_t i = 0; i < kColumns; ++i) {
    const float depth = depths_[place + i];
    const float margin = margin_[0] + margin_[1] * depth * depth;
    const double nearer = std::max(0.0F, depth - margin * inverse_[place + i]);
    for (int axis = 0; axis < 3; ++axis) {
      places_F_[3 * (place + i) + static_cast<size_t>(axis)] =
          static_cast<float>((across[axis] * x_[column + i] + ahead[axis]) * nearer + X_FC.translation()[axis]);
    }
  }
}

void DepthSurface::fillUnseen(const Eigen::Vector3d& p_FC) {
  const auto is_seen = [](float depth) { return !std::isnan(depth); };
  const auto first = std::find_if(depths_.begin(), depths_.end(), is_seen);
  Eigen::Vector3f p_F = p_FC.cast<float>();
  if (first != depths_.end()) std::copy_n(&places_F_[3 * static_cast<size_t>(first - depths_.begin())], 3, p_F.data());
  seen_ = 0;
  for (size_t place = 0; place < depths_.size(); ++place) {
    float* const p = &places_F_[3 * place];
    if (is_seen(depths_[place])) {
      std::copy_n(p, 3, p_F.data());
      ++seen_;
    } else {
      std::copy_n(p_F.data(), 3, p);
    }
  }
}

void DepthSurface::findTriangles() {
  size_t tile = 0;
  for (std::uint32_t row = 0; row < grid_.tileRows(); ++row) {
    for (std::uint32_t column = 0; column < grid_.tileColumns(); ++column)
      existing_[tile++] = tileAt(column, row).triangles();
  }
}

DepthSurface::Tile DepthSurface::tileAt(std::uint32_t tile_column, std::uint32_t tile_row) const {
  Tile tile;
  const std::uint32_t u = tile_column * Grid::kTileColumns;
  const bool is_last = u + kColumns >= x_.size();
  for (std::uint32_t row = 0; row <= kRows; ++row) {
    const std::uint32_t v = tile_row * Grid::kTileRows + row;
    auto& depth = tile.depth[row];
    auto& step = tile.step[row];
    depth.fill(kNothing);
    step.fill(kNothing);
    if (v >= y_.size()) continue;
    std::copy_n(&depths_[grid_.place(u, v)], kColumns, depth.data());
    std::copy_n(&steps_[grid_.place(u, v)], kColumns, step.data());
    if (is_last) continue;
    depth[kColumns] = depths_[grid_.place(u + kColumns, v)];
    step[kColumns] = steps_[grid_.place(u + kColumns, v)];
  }
  return tile;
}

// What is compared with NaN is no neighbor.
std::uint8_t DepthSurface::Tile::joined(size_t row, size_t column, size_t other_row, size_t other_column) const {
  return std::abs(depth[row][column] - depth[other_row][other_column]) <=
         std::min(step[row][column], step[other_row][other_column]);
}

std::uint64_t DepthSurface::Tile::triangles() const {
  std::array<std::array<std::uint8_t, kColumns>, kRows + 1> across;
  std::array<std::array<std::uint8_t, kColumns + 1>, kRows> down;
  for (size_t row = 0; row <= kRows; ++row) {
    for (size_t column = 0; column < kColumns; ++column) across[row][column] = joined(row, column, row, column + 1);
  }
  for (size_t row = 0; row < kRows; ++row) {
    for (size_t column = 0; column <= kColumns; ++column) down[row][column] = joined(row, column, row + 1, column);
  }
  std::uint64_t bits = 0;
  for (size_t row = 0; row < kRows; ++row) {
    for (size_t column = 0; column < kColumns; ++column) {
      const std::uint64_t diagonal = joined(row, column + 1, row + 1, column);
      const std::uint64_t upper = diagonal & across[row][column] & down[row][column];
      const std::uint64_t lower = diagonal & across[row + 1][column] & down[row][column + 1];
      bits |= (upper | lower << 1U) << (2 * (row * kColumns + column));
    }
  }
  return bits;
}

}  // namespace sweep_guard_core
