#include "sweep_guard/geometry/tool.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

// Returns the moments of a union of sets with equal weights.
Moments united(const std::vector<Moments>& sets) {
  const double share = 1.0 / static_cast<double>(sets.size());
  Moments all{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const Moments& set : sets) all.mean += share * set.mean;
  for (const Moments& set : sets) {
    const Eigen::Vector3d apart = set.mean - all.mean;
    all.covariance += share * (set.covariance + apart * apart.transpose());
  }
  return all;
}

void extendAlongAxes(const ConvexShape& shape, Eigen::AlignedBox3d& bounds) {
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    bounds.min()[i] = std::min(bounds.min()[i], -shape.support(-axis));
    bounds.max()[i] = std::max(bounds.max()[i], shape.support(axis));
  }
}

}  // namespace

Tool::Tool(std::vector<ConvexPiece> pieces) : pieces_(std::move(pieces)) {
  if (pieces_.empty()) throw InvalidInput("the tool has no convex piece: give it at least one");
  for (const ConvexPiece& piece : pieces_) {
    extendAlongAxes(piece.shape_T, bounds_);
    bounding_radius_ = std::max(bounding_radius_, piece.shape_T.boundingRadius());
  }
  std::vector<size_t> all(pieces_.size());
  std::iota(all.begin(), all.end(), 0U);
  grow(std::move(all));
}

Tool::Tool(const ConvexShape& shape_T) : Tool(std::vector<ConvexPiece>{{"", shape_T}}) {}

Tool Tool::cylinder(double radius, double length, int sides) {
  return Tool(ConvexShape::cylinder(radius, length, sides));
}

// Halves the pieces at the median along the longest side of the box around them.
size_t Tool::grow(std::vector<size_t> pieces) {
  const size_t node = tree_.size();
  if (pieces.size() == 1) {
    tree_.push_back({pieces_[pieces[0]].shape_T, boundsWithFaces(pieces), pieces[0], {}});
    return node;
  }
  tree_.push_back({boxAround(pieces), boundsWithFaces(pieces), std::nullopt, {}});
  const Eigen::Vector3d longest = tree_[node].shape_T.axis_T();
  const auto along = [&](size_t piece) { return longest.dot(pieces_[piece].shape_T.moments_T().mean); };
  const auto middle = pieces.begin() + static_cast<std::ptrdiff_t>(pieces.size() / 2);
  std::nth_element(pieces.begin(), middle, pieces.end(), [&](size_t a, size_t b) { return along(a) < along(b); });
  const size_t first = grow({pieces.begin(), middle});
  const size_t second = grow({middle, pieces.end()});
  tree_[node].below = {first, second};
  return node;
}

Eigen::AlignedBox3d Tool::boundsWithFaces(const std::vector<size_t>& pieces) const {
  Eigen::AlignedBox3d bounds;
  for (const size_t piece : pieces) {
    const ConvexShape& shape = pieces_[piece].shape_T;
    extendAlongAxes(shape, bounds);
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d direction = (i < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(i % 3);
      bounds.extend(shape.frontSupport(direction));
      bounds.extend(shape.rearSupport(direction));
    }
  }
  return bounds;
}

ConvexShape Tool::boxAround(const std::vector<size_t>& pieces) const {
  std::vector<Moments> moments;
  moments.reserve(pieces.size());
  for (const size_t piece : pieces) moments.push_back(pieces_[piece].shape_T.moments_T());
  Eigen::Isometry3d X_TB = Eigen::Isometry3d::Identity();
  X_TB.linear() = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(united(moments).covariance).eigenvectors();
  if (X_TB.linear().determinant() < 0.0) X_TB.linear().col(0) *= -1.0;
  Eigen::AlignedBox3d box;
  for (const size_t piece : pieces) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = X_TB.linear().col(i);
      box.min()[i] = std::min(box.min()[i], -pieces_[piece].shape_T.support(-axis));
      box.max()[i] = std::max(box.max()[i], pieces_[piece].shape_T.support(axis));
    }
  }
  X_TB.translation() = X_TB.linear() * box.center();
  // Grown by a bound on the rounding: a dozen roundings of 2^-53, with a margin.
  const double rounding = 0x1p-48 * bounding_radius_;
  return ConvexShape::box(0.5 * box.sizes() + Eigen::Vector3d::Constant(rounding)).placed(X_TB);
}

}  // namespace sweep_guard_core
