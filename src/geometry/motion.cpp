#include "sweep_guard/geometry/motion.h"

#include <cassert>
#include <cmath>

namespace sweep_guard {
namespace {

Eigen::AngleAxisd relativeRotation(const Motion& motion) {
  const Eigen::Quaterniond start(motion.X_MT_start.linear());
  const Eigen::Quaterniond end(motion.X_MT_end.linear());
  return Eigen::AngleAxisd(start.conjugate() * end);
}

}  // namespace

double Motion::angle() const { return relativeRotation(*this).angle(); }

Eigen::Vector3d Motion::axis_T() const { return relativeRotation(*this).axis(); }

Eigen::Isometry3d Motion::at(double fraction) const {
  const Eigen::Quaterniond start(X_MT_start.linear());
  const Eigen::Quaterniond end(X_MT_end.linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = start.slerp(fraction, end).normalized().toRotationMatrix();
  pose.translation() = (1.0 - fraction) * X_MT_start.translation() + fraction * X_MT_end.translation();
  return pose;
}

std::vector<Motion> split(const Motion& motion, double max_rotation) {
  assert(max_rotation > 0.0);
  const int parts = std::max(1, static_cast<int>(std::ceil(motion.angle() / max_rotation)));
  std::vector<Motion> motions;
  Eigen::Isometry3d start = motion.X_MT_start;
  for (int i = 1; i < parts; ++i) {
    const Eigen::Isometry3d end = motion.at(static_cast<double>(i) / parts);
    motions.push_back({start, end});
    start = end;
  }
  motions.push_back({start, motion.X_MT_end});
  return motions;
}

double chordError(double radius, double angle) { return radius * angle * angle / 8.0; }

}  // namespace sweep_guard
