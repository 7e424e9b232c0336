#include "geometry/closed_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/crossing.h"
#include "geometry/crossing_parts.h"
#include "sweep_guard/geometry/enclosure.h"

namespace sweep_guard_core {
namespace {

constexpr std::uint32_t kMaxShells = 1000;  // closed parts among which cavities and overlaps are looked for
constexpr double kMaxTests = 2e6;           // triangles looked at from the corners of one cavity
constexpr size_t kCornersOfMost = 7;        // by which a part lies in another that it does not cross

}  // namespace

ClosedParts::ClosedParts(const WeldedSurface& surface, const SurfaceParts& parts, const std::vector<Shell>& shells)
    : surface_(surface),
      parts_(parts),
      shells_(shells),
      cavities_(shells.size()),
      least_(4.0 * Enclosure::kWeld * surface.diagonal()) {
  for (std::uint32_t i = 0; i < shells.size(); ++i) {
    if (shells[i].closed) closed_.push_back(i);
  }
  overlap_ = closed_.size() > kMaxShells;
  if (closed_.size() > kMaxShells || !anyBoxesMeet()) return;
  collectTriangles();
  const bool may_be_cavities = areSentInBothDirections();
  for (const std::uint32_t inner : closed_) cavities_[inner] = may_be_cavities && isReversedAgainstOutermost(inner);
  overlap_ = anyCrossOrLieInOthers();
}

bool ClosedParts::anyBoxesMeet() const {
  for (size_t i = 1; i < closed_.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      if (shells_[closed_[i]].box.intersects(shells_[closed_[k]].box)) return true;
    }
  }
  return false;
}

// Of parts that do not cross, one lies in solids and cavities by turns.
bool ClosedParts::anyCrossOrLieInOthers() const {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> parts;
  for (const std::uint32_t part : closed_) {
    const bool turn = shells_[part].isInsideOut() != cavities_[part];
    for (const Triangle& triangle : triangles_[part]) triangles.push_back(turnedIf(turn, triangle));
    parts.resize(triangles.size(), part);
  }
  if (partsCross(triangles, parts, surface_, least_).value_or(true)) return true;
  return std::any_of(closed_.begin(), closed_.end(),
                     [&](std::uint32_t inner) { return turnsAround(inner) != (cavities_[inner] ? 1 : 0); });
}

int ClosedParts::turnsAround(std::uint32_t inner) const {
  int turns = 0;
  for (const std::uint32_t outer : closed_) {
    if (outer != inner && enclosesMost(outer, inner)) turns += cavities_[outer] ? -1 : 1;
  }
  return turns;
}

bool ClosedParts::areSentInBothDirections() const {
  const auto is_sent = [&](bool inside_out) {
    return std::any_of(closed_.begin(), closed_.end(), [&](std::uint32_t i) {
      return shells_[i].isSentInOneDirection() && shells_[i].isSentInsideOut() == inside_out;
    });
  };
  return is_sent(true) && is_sent(false);
}

void ClosedParts::collectTriangles() {
  triangles_.resize(shells_.size());
  for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i) {
    if (surface_.left_out[i] || !shells_[parts_.of(i)].closed) continue;
    triangles_[parts_.of(i)].push_back(turnedIf(parts_.turned(i), surface_.triangles[i]));
  }
}

// The outermost part around it was sent in the other direction.
bool ClosedParts::isReversedAgainstOutermost(std::uint32_t inner) const {
  if (!shells_[inner].isSentInOneDirection()) return false;
  std::optional<std::uint32_t> outermost;
  for (const std::uint32_t outer : closed_) {
    const bool larger = !outermost || shells_[outer].box.volume() > shells_[*outermost].box.volume();
    if (larger && encloses(outer, inner)) outermost = outer;
  }
  return outermost && shells_[*outermost].isSentInOneDirection() &&
         shells_[*outermost].isSentInsideOut() != shells_[inner].isSentInsideOut();
}

// Tests corners of the inner part: all, unless there are too many.
bool ClosedParts::encloses(std::uint32_t outer, std::uint32_t inner) const {
  const Eigen::AlignedBox3d& box = shells_[inner].box;
  const Eigen::Vector3d gap = Eigen::Vector3d::Constant(least_);
  if (!shells_[outer].box.contains(Eigen::AlignedBox3d(box.min() - gap, box.max() + gap))) return false;
  const double tests = 3.0 * static_cast<double>(triangles_[inner].size() * triangles_[outer].size());
  const auto stride = static_cast<size_t>(std::ceil(tests / kMaxTests));
  for (size_t i = 0; i < 3 * triangles_[inner].size(); i += stride) {
    if (!enclosesPoint(outer, cornerOf(inner, i))) return false;
  }
  return true;
}

// Of parts that do not cross: where they touch, any corner may be outside.
bool ClosedParts::enclosesMost(std::uint32_t outer, std::uint32_t inner) const {
  const Eigen::Vector3d gap = Eigen::Vector3d::Constant(least_);
  const Eigen::AlignedBox3d& box = shells_[outer].box;
  if (!Eigen::AlignedBox3d(box.min() - gap, box.max() + gap).contains(shells_[inner].box)) return false;
  const size_t stride = std::max<size_t>(1, 3 * triangles_[inner].size() / kCornersOfMost);
  int more = 0;
  for (size_t i = 0; i < 3 * triangles_[inner].size(); i += stride)
    more += enclosesPoint(outer, cornerOf(inner, i)) ? 1 : -1;
  return more > 0;
}

Eigen::Vector3d ClosedParts::cornerOf(std::uint32_t part, size_t i) const {
  return surface_.at(triangles_[part][i / 3][i % 3]);
}

bool ClosedParts::enclosesPoint(std::uint32_t outer, const Eigen::Vector3d& p) const {
  const auto corner = [&](std::uint32_t vertex) -> Eigen::Vector3d { return surface_.at(vertex) - p; };
  const Triangle* const first = triangles_[outer].data();
  return crossings(corner, first, first + triangles_[outer].size()) != 0;
}

}  // namespace sweep_guard_core
