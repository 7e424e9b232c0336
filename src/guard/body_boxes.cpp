#include "guard/body_boxes.h"

#include <array>
#include <cmath>

namespace sweep_guard_core {

// Multiples of the powers of x are spread evenly in four dimensions, where x^5 + x^4 = 1.
double evenlySpread(size_t i, size_t dimension) {
  constexpr std::array<double, 4> kPowers = {0.8566748838545029, 0.7338918566271259, 0.6287067210378086,
                                             0.5385972572236101};
  const double value = static_cast<double>(i) * kPowers.at(dimension);
  return value - std::floor(value);
}

BodyBoxes::BodyBoxes(const Tool& body, size_t points) {
  for (const ConvexPiece& piece : body.pieces()) boxes_.push_back(boxAround(piece.shape_T));
  for (size_t i = 0; i < points; ++i) {
    const Box& box = boxes_[i * boxes_.size() / points];
    const Eigen::Vector3d share(evenlySpread(i, 0), evenlySpread(i, 1), evenlySpread(i, 2));
    const Eigen::Vector3d p_N = box.half_extents.cwiseProduct(2.0 * share - Eigen::Vector3d::Ones());
    points_B_.push_back(box.X_NB.inverse() * p_N);
  }
}

// Along the piece's own axes.
BodyBoxes::Box BodyBoxes::boxAround(const ConvexShape& shape_B) {
  Box box{Eigen::Isometry3d::Identity(), {}};
  Eigen::Isometry3d X_BN = Eigen::Isometry3d::Identity();
  X_BN.linear() = shape_B.axes_T();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along_B = X_BN.linear().col(axis);
    const double above = shape_B.support(along_B);
    const double below = shape_B.support(-along_B);
    X_BN.translation() += 0.5 * (above - below) * along_B;
    box.half_extents[axis] = 0.5 * (above + below);
  }
  box.X_NB = X_BN.inverse();
  return box;
}

bool BodyBoxes::isNear(const Eigen::Vector3d& p_B) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
    return ((box.X_NB * p_B).cwiseAbs() - box.half_extents).maxCoeff() <= kNear;
  });
}

}  // namespace sweep_guard_core
