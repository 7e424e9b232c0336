#include "sweep_guard/geometry/tool.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

// Of several sets of points, each counted alike.
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

}  // namespace

Tool::Tool(std::vector<ConvexPiece> parts) : pieces_(std::move(parts)) {
  if (pieces_.empty()) throw InvalidInput("the tool has no part: give it one");
  for (const ConvexPiece& part : pieces_) {
    const ConvexShape& shape = part.shape_T;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
      bounds_.min()[i] = std::min(bounds_.min()[i], -shape.support(-axis));
      bounds_.max()[i] = std::max(bounds_.max()[i], shape.support(axis));
    }
    bounding_radius_ = std::max(bounding_radius_, shape.boundingRadius());
  }
  std::vector<size_t> all(pieces_.size());
  std::iota(all.begin(), all.end(), 0U);
  grow(std::move(all));
}

Tool::Tool(const ConvexShape& shape_T) : Tool(std::vector<ConvexPiece>{{"", shape_T}}) {}

Tool Tool::cylinder(double radius, double length, int sides) {
  return Tool(ConvexShape::cylinder(radius, length, sides));
}

// Halves them at the median along the longest side of the box around them.
size_t Tool::grow(std::vector<size_t> parts) {
  const size_t node = tree_.size();
  if (parts.size() == 1) {
    tree_.push_back({pieces_[parts[0]].shape_T, parts[0], {}});
    return node;
  }
  tree_.push_back({boxAround(parts), std::nullopt, {}});
  const Eigen::Vector3d longest = tree_[node].shape_T.axis_T();
  const auto along = [&](size_t part) { return longest.dot(pieces_[part].shape_T.moments_T().mean); };
  const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
  std::nth_element(parts.begin(), middle, parts.end(), [&](size_t a, size_t b) { return along(a) < along(b); });
  const size_t first = grow({parts.begin(), middle});
  const size_t second = grow({middle, parts.end()});
  tree_[node].below = {first, second};
  return node;
}

ConvexShape Tool::boxAround(const std::vector<size_t>& parts) const {
  std::vector<Moments> moments;
  for (const size_t part : parts) moments.push_back(pieces_[part].shape_T.moments_T());
  Eigen::Isometry3d X_TB = Eigen::Isometry3d::Identity();
  X_TB.linear() = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(united(moments).covariance).eigenvectors();
  if (X_TB.linear().determinant() < 0.0) X_TB.linear().col(0) *= -1.0;
  Eigen::AlignedBox3d box;
  for (const size_t part : parts) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = X_TB.linear().col(i);
      box.min()[i] = std::min(box.min()[i], -pieces_[part].shape_T.support(-axis));
      box.max()[i] = std::max(box.max()[i], pieces_[part].shape_T.support(axis));
    }
  }
  X_TB.translation() = X_TB.linear() * box.center();
  // Grown by what rounding may cost: a dozen roundings of 2^-53, with a margin.
  const double rounding = 0x1p-48 * bounding_radius_;
  return ConvexShape::box(0.5 * box.sizes() + Eigen::Vector3d::Constant(rounding)).placed(X_TB);
}

}  // namespace sweep_guard_core
