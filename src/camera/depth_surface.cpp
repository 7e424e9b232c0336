#include "camera/depth_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <future>
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
  check(options.surface_speed >= 0.0 && options.remember >= 0.0 && std::isfinite(options.surface_speed),
        "surface_speed and remember of a camera are at least 0, and surface_speed is finite");
}

}  // namespace

DepthSurface::DepthSurface(const Grid& grid, const Pinhole& camera, const DepthOptions& options)
    : grid_(grid),
      camera_(camera),
      options_(options),
      tolerance_{{static_cast<float>(options.margin[0]), static_cast<float>(options.margin[1])},
                 static_cast<float>(kSteepest * std::hypot(1.0 / camera.fx, 1.0 / camera.fy))},
      stride_(size_t{grid.tileColumns()} * kColumns + 1),
      inverse_((size_t{grid.tileRows()} * kRows + 1) * stride_, 0.0F),
      depths_(inverse_.size(), kNothing),
      nearer_(depths_),
      remembered_(depths_),
      farthest_(depths_),
      nearer_before_(depths_),
      places_before_F_(3 * grid.places(), 0.0F),
      places_F_(places_before_F_),
      before_F_(places_before_F_),
      existing_(grid.tiles(), 0),
      self_(grid, camera),
      gone_(grid, tolerance_),
      free_(grid, camera, stride_, options.remember) {
  checkCamera(camera);
  checkOptions(options);
  for (size_t u = 0; u < grid.tileColumns() * kColumns; ++u)
    x_.push_back((static_cast<double>(u) - camera.cx) / camera.fx);
  for (size_t v = 0; v < grid.tileRows() * kRows; ++v) y_.push_back((static_cast<double>(v) - camera.cy) / camera.fy);
  for (size_t v = 0; v < grid.height(); ++v) {
    for (size_t u = 0; u < grid.width(); ++u)
      inverse_[v * stride_ + u] = static_cast<float>(1.0 / std::hypot(x_[u], y_[v], 1.0));
  }
  const std::vector<std::uint8_t> pairs(stride_ * kRows);
  const size_t middle = grid.tileRows() / 2 * kRows;
  halves_ = {{{0, middle, pairs}, {middle, y_.size(), pairs}}};
}

// Uses a thread for each half, because the points take most of the time from an image to its contacts.
void DepthSurface::take(const std::vector<float>& depths, const Eigen::Isometry3d& X_FC, double since,
                        const std::vector<SweptVolume>& bodies_F) {
  assert(depths.size() == size_t{grid_.width()} * grid_.height());
  const auto reach = static_cast<float>(options_.surface_speed * since);
  findRest(X_FC);
  interrupted_ = true;
  free_.begin(X_FC_, rests_, since);
  before_F_.swap(places_before_F_);
  beginSelf(bodies_F);
  constexpr auto kIfPossible = std::launch::async | std::launch::deferred;
  auto lower = std::async(kIfPossible, [&] { takeRows(depths, reach, halves_[1]); });
  takeRows(depths, reach, halves_[0]);
  lower.get();
  for (Rows& half : halves_) {  // its last triangles reach into the next half
    if (half.first < half.end) findTriangles(half.end - kRows, half.pairs);
  }
  forgetGone(reach);
  placeUnseen();
  nearer_before_.swap(nearer_);
  free_.end(self_);
  interrupted_ = false;
}

// A row of tiles goes through all steps while the processor's cache holds it. Its last triangles reach into the next one.
void DepthSurface::takeRows(const std::vector<float>& depths, float reach, Rows& rows) {
  for (size_t row = rows.first; row < rows.end; row += kRows) {
    for (size_t v = row; v < std::min<size_t>(row + kRows, grid_.height()); ++v) readRow(depths, v);
    placeTiles(row);
    hideSelf(row);
    remember(row);
    findMotion(row, reach);
    if (row > rows.first) findTriangles(row - kRows, rows.pairs);
  }
}

// Transforms that are interpolated differ in their last digits.
void DepthSurface::findRest(const Eigen::Isometry3d& X_FC) {
  const Eigen::Isometry3d moved = X_FC_.inverse() * X_FC;
  const double farthest = options_.farthest * std::sqrt(1.0 + x_.front() * x_.front() + x_.back() * x_.back() +
                                                        y_.front() * y_.front() + y_.back() * y_.back());
  const double turned = (moved.linear() - Eigen::Matrix3d::Identity()).norm() * farthest;
  rests_ = !interrupted_ && moved.translation().norm() + turned <= kStill;
  if (rests_) return;
  X_FC_ = X_FC;
  forget();
}

// Where the camera goes, its pixels show something else.
void DepthSurface::forget() {
  std::fill(remembered_.begin(), remembered_.end(), kNothing);
  std::fill(farthest_.begin(), farthest_.end(), kNothing);
  std::fill(nearer_before_.begin(), nearer_before_.end(), kNothing);
}

// Members are copied, here and in findPairs(): what is stored could change them, and the loop would not be vectorized.
void DepthSurface::readRow(const std::vector<float>& depths, size_t row) {
  const auto nearest = static_cast<float>(options_.nearest);
  const auto farthest = static_cast<float>(options_.farthest);
  const DepthTolerance tolerance = tolerance_;
  const size_t from = row * grid_.width();
  const size_t to = row * stride_;
  for (size_t i = 0; i < grid_.width(); ++i) {
    const bool is_seen = depths[from + i] >= nearest && depths[from + i] <= farthest;
    const float depth = is_seen ? depths[from + i] : kNothing;
    depths_[to + i] = depth;
    nearer_[to + i] = std::max(depth - tolerance.errorAt(depth) * inverse_[to + i], 0.0F);
  }
  float* const free = free_.row(row);
  for (size_t i = 0; i < grid_.width(); ++i) {
    const float depth = depths[from + i];
    const float nearer = depth - tolerance.errorAt(depth) * inverse_[to + i];
    free[i] = depth >= nearest ? std::min(nearer, farthest) : kNothing;
  }
  for (size_t i = 0; i < grid_.width(); ++i)
    remembered_[to + i] = depths[from + i] > farthest ? kNothing : remembered_[to + i];
}

void DepthSurface::beginSelf(const std::vector<SweptVolume>& bodies_F) {
  bodies_F_.clear();
  for (const SweptVolume& body_F : bodies_F) {
    const double depth = (X_FC_.inverse() * body_F.box.X_MB.translation()).z() + body_F.box.half_extents.norm();
    bodies_F_.push_back(body_F.grown(options_.margin[0] + options_.margin[1] * depth * depth));
  }
  self_.begin(X_FC_, bodies_F_);
}

// Pixels that the robot hides become what they showed before.
void DepthSurface::hideSelf(size_t row) {
  const size_t first = row / kRows * grid_.tileColumns();
  self_.find({places_F_, depths_, stride_}, row / kRows);
  for (size_t tile = first; tile < first + grid_.tileColumns(); ++tile) {
    if (self_.tiles()[tile] != 0) hide(tile);
  }
}

// What only one image shows may be a fault of it, as a pixel between an edge and what is behind: it is not remembered in place of
// something else. Members are copied as in readRow().
void DepthSurface::remember(size_t row) {
  const DepthTolerance tolerance = tolerance_;
  const size_t end = (row + kRows) * stride_;
  for (size_t i = row * stride_; i < end; ++i) {
    const float allowed = 2.0F * tolerance.errorAt(depths_[i]);
    const float kept = std::isnan(remembered_[i]) ? depths_[i] : remembered_[i];
    remembered_[i] = std::abs(nearer_[i] - nearer_before_[i]) <= allowed ? depths_[i] : kept;
  }
  for (size_t i = row * stride_; i < end; ++i) {
    const float farthest = std::isnan(farthest_[i]) ? remembered_[i] : farthest_[i];
    farthest_[i] = remembered_[i] > farthest ? remembered_[i] : farthest;
  }
}

void DepthSurface::hide(size_t tile) {
  for (std::uint32_t left = self_.tiles()[tile]; left != 0; left &= left - 1) {
    const auto bit = static_cast<std::uint32_t>(__builtin_ctz(left));
    const auto [u, v] = grid_.pixel(tile, bit);
    const size_t pixel = v * stride_ + u;
    free_.keep(static_cast<std::uint32_t>(tile) * Grid::kTilePixels + bit, pixel);
    const float free_to = depths_[pixel] - 2.0F * tolerance_.errorAt(depths_[pixel]);  // the robot is seen there
    if (remembered_[pixel] < free_to) remembered_[pixel] = farthest_[pixel];
    setDepth(pixel, remembered_[pixel] < free_to ? kNothing : remembered_[pixel]);
  }
  const size_t row = tile / grid_.tileColumns() * kRows;
  const size_t column = tile % grid_.tileColumns() * kColumns;
  for (size_t i = 0; i < kRows; ++i) {
    const size_t place = tile * Grid::kTilePixels + i * kColumns;
    placeRow(column, row + i, &places_F_[3 * (beginsHalf(place) ? place : place - 1)], &places_F_[3 * place]);
  }
}

void DepthSurface::setDepth(size_t pixel, float depth) {
  depths_[pixel] = depth;
  nearer_[pixel] = std::max(depth - tolerance_.errorAt(depth) * inverse_[pixel], 0.0F);
}

// Behind it is what was seen there before, or nothing that is known.
void DepthSurface::forgetGone(float reach) {
  const std::vector<size_t>& gone = gone_.find(self_, {nearer_before_, nearer_, remembered_, stride_});
  for (const size_t pixel : gone) {
    const bool known = farthest_[pixel] > remembered_[pixel] + 2.0F * tolerance_.errorAt(remembered_[pixel]);
    remembered_[pixel] = known ? farthest_[pixel] : kNothing;
    setDepth(pixel, remembered_[pixel]);
  }
  for (size_t row = 0; row < y_.size() && !gone.empty(); row += kRows) {
    placeTiles(row);
    findMotion(row, reach);
    findTriangles(row, halves_[0].pairs);
  }
}

// As a rule all go on: what does not is exchanged.
void DepthSurface::findMotion(size_t row, float reach) {
  const size_t first = placeOf(row);
  size_t place = first;
  for (size_t u = 0; u < x_.size(); u += kColumns) {
    for (size_t v = row; v < row + kRows; ++v, place += kColumns) endMotions(reach, v * stride_ + u, place);
  }
  std::copy_n(&places_F_[3 * first], 3 * (place - first), &places_before_F_[3 * first]);
}

// Of the pixels in a row of a tile.
void DepthSurface::endMotions(float reach, size_t pixel, size_t place) {
  std::array<bool, kColumns> goes_on;
  bool all = true;
  for (size_t i = 0; i < kColumns; ++i) {
    goes_on[i] = std::abs(nearer_[pixel + i] - nearer_before_[pixel + i]) <= reach * inverse_[pixel + i];
    all = all && goes_on[i];
  }
  for (size_t i = 0; i < kColumns && !all; ++i) {
    if (!goes_on[i]) std::copy_n(&places_F_[3 * (place + i)], 3, &before_F_[3 * (place + i)]);
  }
}

void DepthSurface::placeTiles(size_t row) {
  const Eigen::Vector3f p_FC = X_FC_.translation().cast<float>();
  size_t place = placeOf(row);
  const float* before_F = beginsHalf(place) ? p_FC.data() : &places_F_[3 * (place - 1)];
  for (size_t u = 0; u < x_.size(); u += kColumns) {
    for (size_t v = row; v < row + kRows; ++v, place += kColumns) {
      placeRow(u, v, before_F, &places_F_[3 * place]);
      before_F = &places_F_[3 * (place + kColumns - 1)];
    }
  }
}

// Those of a half before the first that is seen.
void DepthSurface::placeUnseen() {
  const size_t middle = placeOf(halves_[1].first);
  if (middle > 0) copyPlace(middle - 1, middle, firstSeen(middle));
  const size_t first = firstSeen(0);
  if (first < grid_.places()) copyPlace(first, 0, first);
}

// Puts the places from `begin` to `end` where `from` is.
void DepthSurface::copyPlace(size_t from, size_t begin, size_t end) {
  for (std::vector<float>* const places_F : {&places_F_, &before_F_, &places_before_F_}) {
    for (size_t i = begin; i < end; ++i) std::copy_n(&(*places_F)[3 * from], 3, &(*places_F)[3 * i]);
  }
}

size_t DepthSurface::firstSeen(size_t place) const {
  while (place < grid_.places() && !isSeen(place)) ++place;
  return place;
}

bool DepthSurface::isSeen(size_t place) const {
  const auto [u, v] = grid_.pixel(place / Grid::kTilePixels, place % Grid::kTilePixels);
  return !std::isnan(nearer_[v * stride_ + u]);
}

// All at once, which is vectorized, then those that are seen.
void DepthSurface::placeRow(size_t column, size_t row, const float* before_F, float* places_F) const {
  const Eigen::Vector3d ahead = y_[row] * X_FC_.linear().col(1) + X_FC_.linear().col(2);
  const float* const nearer = &nearer_[row * stride_ + column];
  std::array<std::array<float, kColumns>, 3> seen_F;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const std::array<double, 3> line_F = {X_FC_(a, 0), ahead[a], X_FC_(a, 3)};
    for (size_t i = 0; i < kColumns; ++i)
      seen_F[axis][i] = static_cast<float>((line_F[0] * x_[column + i] + line_F[1]) * double{nearer[i]} + line_F[2]);
  }
  Eigen::Vector3f p_F = Eigen::Map<const Eigen::Vector3f>(before_F);
  for (size_t i = 0; i < kColumns; ++i) {
    if (!std::isnan(nearer[i])) p_F = {seen_F[0][i], seen_F[1][i], seen_F[2][i]};
    Eigen::Map<Eigen::Vector3f>(places_F + 3 * i) = p_F;
  }
}

void DepthSurface::findTriangles(size_t row, std::vector<std::uint8_t>& pairs) {
  for (size_t i = 0; i < kRows; ++i) findPairs((row + i) * stride_, &pairs[i * stride_]);
  size_t tile = row / kRows * grid_.tileColumns();
  for (size_t u = 0; u < x_.size(); u += kColumns) existing_[tile++] = trianglesAt(u, pairs);
}

// What is compared with NaN is no neighbor.
void DepthSurface::findPairs(size_t first, std::uint8_t* pairs) const {
  const auto joined = [depth = &depths_[first], tolerance = tolerance_](size_t a, size_t b) -> unsigned {
    return tolerance.joined(depth[a], depth[b]);
  };
  const size_t stride = stride_;
  const size_t count = x_.size();
  for (size_t i = 0; i < count; ++i) {
    const size_t below = i + stride;
    const unsigned diagonal = joined(i + 1, below);
    const unsigned upper = diagonal & joined(i, i + 1) & joined(i, below);
    const unsigned lower = diagonal & joined(below, below + 1) & joined(i + 1, below + 1);
    pairs[i] = static_cast<std::uint8_t>(upper | lower << 1U);
  }
}

std::uint64_t DepthSurface::trianglesAt(size_t column, const std::vector<std::uint8_t>& pairs) const {
  std::uint64_t bits = 0;
  for (size_t row = 0; row < kRows; ++row) {
    for (size_t i = 0; i < kColumns; ++i)
      bits |= std::uint64_t{pairs[row * stride_ + column + i]} << (2 * (row * kColumns + i));
  }
  return bits;
}

}  // namespace sweep_guard_core
