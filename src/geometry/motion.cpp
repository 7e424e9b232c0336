#include "sweep_guard/geometry/motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sweep_guard_core {
namespace {

Eigen::AngleAxisd relativeRotation(const Motion& motion) {
  const Eigen::Quaterniond start(motion.X_MT_start.linear());
  const Eigen::Quaterniond end(motion.X_MT_end.linear());
  return Eigen::AngleAxisd(start.conjugate() * end);
}

// Bounds the distance of a tool point between two poses. The difference of two rotations that are an angle apart has
// the operator norm 2 sin(angle / 2), and sqrt(2) times that as Frobenius norm.
double distanceBound(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double tool_radius) {
  return (a.translation() - b.translation()).norm() + tool_radius * M_SQRT1_2 * (a.linear() - b.linear()).norm();
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

size_t subMotionCount(double angle, double max_rotation) {
  assert(max_rotation > 0.0);
  return std::max<size_t>(1, static_cast<size_t>(std::ceil(angle / max_rotation)));
}

std::vector<Motion> split(const Motion& motion, double max_rotation, std::vector<Motion> buffer) {
  const size_t count = subMotionCount(motion.angle(), max_rotation);
  buffer.clear();
  Eigen::Isometry3d start = motion.X_MT_start;
  for (size_t i = 1; i < count; ++i) {
    const Eigen::Isometry3d end = motion.at(static_cast<double>(i) / static_cast<double>(count));
    buffer.push_back({start, end});
    start = end;
  }
  buffer.push_back({start, motion.X_MT_end});
  return buffer;
}

std::vector<Motion> split(const RelativeMotion& motion, double max_rotation, double tool_radius,
                          std::vector<Motion> buffer) {
  const double frame_angle = motion.frame_W.angle();
  const size_t count = subMotionCount(motion.tool_W.angle() + frame_angle, max_rotation);
  const auto divisor = static_cast<double>(count);
  const double deviation = motion.tool_W.deviation_bound;
  const bool arcs_alone = frame_angle == 0.0 && deviation == 0.0;
  const double deviation_bound = arcs_alone ? 0.0 : chordError(motion, tool_radius) / (divisor * divisor) + deviation;

  const auto pose_M = [&](double fraction) {
    return motion.frame_W.at(fraction).inverse() * motion.tool_W.at(fraction);
  };
  buffer.clear();
  for (size_t i = 0; i < count; ++i) {
    buffer.push_back(
        {pose_M(static_cast<double>(i) / divisor), pose_M(static_cast<double>(i + 1) / divisor), deviation_bound});
  }
  return buffer;
}

// A tool point in M is x = R_MW (d + R_WT p): |x''| <= turn^2 |d| + 2 turn |d'| + (turn + tool's turn)^2 |p|, and the
// chord of a curve errs by an eighth of that.
double chordError(const RelativeTurn& turn, double tool_radius) {
  const double both = turn.tool + turn.frame;
  if (turn.frame == 0.0) return both * both * tool_radius / 8.0;
  const double farthest = std::max(turn.start_W.norm(), turn.end_W.norm());
  const double moves = (turn.end_W - turn.start_W).norm();
  return (turn.frame * turn.frame * farthest + 2.0 * turn.frame * moves + both * both * tool_radius) / 8.0;
}

double chordError(const RelativeMotion& motion, double tool_radius) {
  const Eigen::Vector3d start_W = motion.tool_W.X_MT_start.translation() - motion.frame_W.X_MT_start.translation();
  const Eigen::Vector3d end_W = motion.tool_W.X_MT_end.translation() - motion.frame_W.X_MT_end.translation();
  return chordError(RelativeTurn{motion.tool_W.angle(), motion.frame_W.angle(), start_W, end_W}, tool_radius);
}

double chordError(double radius, double angle) { return radius * angle * angle / 8.0; }

// The Frobenius norm is sqrt(8) sin(angle / 2), and a sine up to half of pi is no less than 2 / pi times the angle.
double angleBound(const Eigen::Matrix3d& R_start, const Eigen::Matrix3d& R_end) {
  return M_PI / std::sqrt(8.0) * (R_end - R_start).norm();
}

// Between two points, path and merged motion are straight except for their arcs: without arcs, the deviation is largest
// at one of the two points. The last arc is that of the merged motion.
Motion mergedMotion(const Path& path, size_t first, size_t last, double tool_radius) {
  assert(first < last && last < path.size());
  Motion merged_M{path[first].X_MT, path[last].X_MT};
  const double turn = merged_M.angle();
  const double time = toSeconds(path[last].time - path[first].time);
  const auto along = [&](size_t i) {
    if (time > 0.0) return toSeconds(path[i].time - path[first].time) / time;
    return static_cast<double>(i - first) / static_cast<double>(last - first);
  };
  double deviation = 0.0;
  double arc = 0.0;
  for (size_t i = first + 1; i <= last; ++i) {
    if (i < last) deviation = std::max(deviation, distanceBound(merged_M.at(along(i)), path[i].X_MT, tool_radius));
    arc = std::max(arc, path[i].deviation_bound + chordError(tool_radius, (along(i) - along(i - 1)) * turn));
  }
  merged_M.deviation_bound = deviation + arc + chordError(tool_radius, turn);
  return merged_M;
}

size_t endOfMergedMotion(const Path& path, size_t first, size_t last, double tool_radius, double max_deviation,
                         double max_rotation) {
  const auto fits = [&](size_t end) {
    const Motion merged_M = mergedMotion(path, first, end, tool_radius);
    return merged_M.deviation_bound <= max_deviation && merged_M.angle() <= max_rotation;
  };
  size_t end = first + 1;
  size_t step = 1;
  for (; end < last && fits(std::min(end + step, last)); step *= 2) end = std::min(end + step, last);
  for (step /= 2; step > 0; step /= 2) {
    if (end + step < last && fits(end + step)) end += step;
  }
  return end;
}

}  // namespace sweep_guard_core
