#include "sweep_guard/motion/nearest_point.h"

#include <algorithm>
#include <limits>

namespace sweep_guard_core {
namespace {

using Real = long double;  // planes that are nearly parallel cost digits
using Vector = Eigen::Matrix<Real, 4, 1>;
using Square = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;
using Values = Eigen::Matrix<Real, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1>;

constexpr Real kTolerance = 1e-13L;     // distance from a half-space that counts as inside
constexpr Real kPointRounding = 1e-6L;  // of such a distance, where normals are nearly dependent
constexpr Real kParallel = 1e-8L;       // sine of the angle below which normals count as dependent
constexpr Real kNowhere = std::numeric_limits<Real>::infinity();
constexpr int kMaxSteps = 200;

// The active half-spaces, with a QR factorization of their normals: N = Q R.
class ActiveSet {
 public:
  explicit ActiveSet(const std::vector<HalfSpace4>& half_spaces) : half_spaces_(half_spaces) {}

  Eigen::Index size() const { return static_cast<Eigen::Index>(indices.size()); }

  // Returns the part of a vector that is orthogonal to all active normals: orthogonalizes twice, to keep its digits.
  Vector orthogonalPart(const Vector& vector) const {
    Vector rest = vector;
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index i = 0; i < size(); ++i) rest -= Q_.col(i).dot(rest) * Q_.col(i);
    }
    return rest;
  }

  // Returns the coefficients of the active normals that come nearest to a vector.
  Values coefficients(const Vector& vector) const {
    const Values projected = Q_.leftCols(size()).transpose() * vector;
    return triangle().triangularView<Eigen::Upper>().solve(projected);
  }

  void add(size_t index) {
    const Vector vector = half_spaces_[index].normal.cast<Real>();
    const Vector rest = orthogonalPart(vector);
    const Eigen::Index last = size();
    R_.col(last).head(last) = Q_.leftCols(last).transpose() * vector;
    R_(last, last) = rest.norm();
    Q_.col(last) = rest.normalized();
    indices.push_back(index);
  }

  void remove(Eigen::Index place) {
    const auto before = indices;
    indices.clear();
    for (size_t i = 0; i < before.size(); ++i) {
      if (i != static_cast<size_t>(place)) add(before[i]);
    }
  }

  // Returns the point nearest to a target where all planes of the active half-spaces meet.
  Vector pointNearestTo(const Vector& target) const {
    Values beyond(size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      const HalfSpace4& half_space = half_spaces_[indices[static_cast<size_t>(i)]];
      beyond[i] = half_space.normal.cast<Real>().dot(target) - half_space.offset;
    }
    const Values steps = triangle().triangularView<Eigen::Upper>().transpose().solve(beyond);
    return target - Q_.leftCols(size()) * steps;
  }

  boost::container::static_vector<size_t, 4> indices;

 private:
  Square triangle() const { return R_.topLeftCorner(size(), size()); }

  const std::vector<HalfSpace4>& half_spaces_;
  Eigen::Matrix<Real, 4, 4> Q_ = Eigen::Matrix<Real, 4, 4>::Zero();
  Eigen::Matrix<Real, 4, 4> R_ = Eigen::Matrix<Real, 4, 4>::Zero();
};

class DualSearch {
 public:
  DualSearch(const Eigen::Vector4d& target, const std::vector<HalfSpace4>& half_spaces)
      : target_(target.cast<Real>()), half_spaces_(half_spaces), point_(target_), active_(half_spaces) {}

  std::optional<NearestPoint> run() {
    for (int step = 0; step < kMaxSteps; ++step) {
      if (step == kMaxSteps / 2) tolerance_ = kPointRounding;  // nearly parallel half-spaces take turns
      const std::optional<size_t> violated = mostViolated();
      if (!point_.allFinite()) return {};
      if (!violated) return result();
      if (satisfy(*violated)) continue;
      tolerance_ = std::max(tolerance_, violation(*violated));  // there is a common point, so only rounding is left
      if (tolerance_ > kPointRounding) return {};
    }
    return {};
  }

 private:
  Real violation(size_t index) const {
    return half_spaces_[index].normal.cast<Real>().dot(point_) - half_spaces_[index].offset;
  }

  std::optional<size_t> mostViolated() const {
    std::optional<size_t> most;
    Real largest = tolerance_;
    for (size_t i = 0; i < half_spaces_.size(); ++i) {
      const Real beyond = violation(i);
      if (beyond <= largest) continue;
      most = i;
      largest = beyond;
    }
    return most;
  }

  // Raises the multiplier of a half-space until its plane is reached. Multipliers that fall to 0 meanwhile leave.
  bool satisfy(size_t added) {
    Real multiplier = 0;
    for (;;) {
      const Vector normal = half_spaces_[added].normal.cast<Real>();
      const Vector direction = active_.orthogonalPart(normal);
      const Values falling = active_.coefficients(normal);
      const auto [blocking, to_block] = firstToFall(falling);
      const Real slope = direction.squaredNorm();
      const Real to_plane = slope > kParallel * kParallel ? violation(added) / slope : kNowhere;
      const Real length = std::min(to_block, to_plane);
      if (length == kNowhere) {
        cancel(added, multiplier, falling);
        return false;
      }
      multiplier += length;
      for (Eigen::Index i = 0; i < active_.size(); ++i) multipliers_[static_cast<size_t>(i)] -= length * falling[i];
      if (to_plane <= to_block) return reach(added, multiplier);
      if (to_plane < kNowhere) point_ -= length * direction;
      active_.remove(blocking);
      multipliers_.erase(multipliers_.begin() + blocking);
    }
  }

  struct Fall {
    Eigen::Index place;
    Real length;
  };
  Fall firstToFall(const Values& falling) const {
    Fall first{0, kNowhere};
    for (Eigen::Index i = 0; i < falling.size(); ++i) {
      if (falling[i] <= 0) continue;
      const Real length = std::max(Real{0}, multipliers_[static_cast<size_t>(i)]) / falling[i];
      if (length < first.length) first = {i, length};
    }
    return first;
  }

  bool reach(size_t added, Real multiplier) {
    active_.add(added);
    multipliers_.push_back(multiplier);
    point_ = active_.pointNearestTo(target_);
    return true;
  }

  // The new half-space is opposite to the active ones: takes the part out of all multipliers that cancels itself.
  void cancel(size_t added, Real multiplier, const Values& falling) {
    const auto [place, length] = firstToFall(-falling);
    const Real common = std::min(multiplier, length);
    for (Eigen::Index i = 0; i < active_.size(); ++i) multipliers_[static_cast<size_t>(i)] += common * falling[i];
    if (length < multiplier) {
      active_.remove(place);
      multipliers_.erase(multipliers_.begin() + place);
      reach(added, multiplier - common);
    } else {
      point_ = active_.pointNearestTo(target_);
    }
  }

  NearestPoint result() const {
    NearestPoint nearest{point_.cast<double>(), active_.indices, {}};
    const auto multipliers = active_.coefficients(target_ - point_).eval();
    for (Eigen::Index i = 0; i < multipliers.size(); ++i) {
      nearest.multipliers.push_back(static_cast<double>(multipliers[i]));
    }
    return nearest;
  }

  const Vector target_;
  const std::vector<HalfSpace4>& half_spaces_;
  Vector point_;
  ActiveSet active_;
  boost::container::static_vector<Real, 4> multipliers_;
  Real tolerance_ = kTolerance;
};

}  // namespace

std::optional<NearestPoint> nearestPoint(const Eigen::Vector4d& target, const std::vector<HalfSpace4>& half_spaces) {
  return DualSearch(target, half_spaces).run();
}

}  // namespace sweep_guard_core
