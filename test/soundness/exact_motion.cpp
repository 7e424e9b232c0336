#include "soundness/exact_motion.h"

#include <cmath>

namespace sweep_guard_core::soundness {
namespace {

using Quaternion = Eigen::Quaternion<Real>;

Quaternion quaternionOf(const Eigen::Isometry3d& pose) {
  return Quaternion(Matrix3r(pose.linear().cast<Real>())).normalized();
}

}  // namespace

ExactMotion::Path::Path(const Motion& motion)
    : from(motion.X_MT_start.translation().cast<Real>()),
      to(motion.X_MT_end.translation().cast<Real>()),
      start(quaternionOf(motion.X_MT_start)),
      end(quaternionOf(motion.X_MT_end)) {
  if (start.dot(end) < 0) end.coeffs() *= -1;
  constexpr Real kHalfATurn = 1e-12L;  // below this, rounding decides which way is shorter
  if (start.dot(end) > kHalfATurn) return;
  const Quaternion middle = quaternionOf(motion.at(0.5));
  const Real one_way = std::abs((start.coeffs() + end.coeffs()).dot(middle.coeffs()));
  const Real other_way = std::abs((start.coeffs() - end.coeffs()).dot(middle.coeffs()));
  if (other_way > one_way) end.coeffs() *= -1;
}

Matrix3r ExactMotion::Path::rotation(Real fraction) const {
  const Real half_angle =
      2 * std::atan2((end.coeffs() - start.coeffs()).norm(), (end.coeffs() + start.coeffs()).norm());
  constexpr Real kSmall = 1e-9L;  // chord and arc differ by 1e-27
  const bool small = half_angle < kSmall;
  const Real a = small ? 1 - fraction : std::sin((1 - fraction) * half_angle);
  const Real b = small ? fraction : std::sin(fraction * half_angle);
  const Quaternion q(Eigen::Matrix<Real, 4, 1>(a * start.coeffs() + b * end.coeffs()));
  return q.normalized().toRotationMatrix();
}

ExactMotion::ExactMotion(const Motion& motion) : tool_(motion) {}

ExactMotion::ExactMotion(const RelativeMotion& motion) : tool_(motion.tool_W), frame_(motion.frame_W) {}

Vector3r ExactMotion::at(Real fraction, const Vector3r& p_T) const {
  Vector3r p_W = tool_.origin(fraction) + tool_.rotation(fraction) * p_T;
  if (!frame_) return p_W;
  return frame_->rotation(fraction).transpose() * (p_W - frame_->origin(fraction));
}

Vector3r ExactMotion::inTool(Real fraction, const Vector3r& p_M) const {
  const Vector3r p_W = frame_ ? Vector3r(frame_->origin(fraction) + frame_->rotation(fraction) * p_M) : p_M;
  return tool_.rotation(fraction).transpose() * (p_W - tool_.origin(fraction));
}

Vector3r ExactMotion::directionInTool(Real fraction, const Vector3r& direction_M) const {
  const Vector3r direction_W = frame_ ? Vector3r(frame_->rotation(fraction) * direction_M) : direction_M;
  return tool_.rotation(fraction).transpose() * direction_W;
}

}  // namespace sweep_guard_core::soundness
