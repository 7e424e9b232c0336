#include "sweep_guard/geometry/chord.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sweep_guard {
namespace {

// How far a tool point is from one pose to another at most. Two rotations by an angle apart differ by 2 sin(angle / 2)
// as an operator, and by sqrt(2) times that in the Frobenius norm.
double apart(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double tool_extent) {
  return (a.translation() - b.translation()).norm() + tool_extent * M_SQRT1_2 * (a.linear() - b.linear()).norm();
}

}  // namespace

// From one waypoint to the next both the way and the chord are straight but for their arcs: no point is farther off
// than at one of the two, arcs apart. The last arc is that of the chord itself.
Motion chord(const Waypoints& way, size_t first, size_t last, double tool_extent) {
  assert(first < last && last < way.size());
  Motion chord_M{way[first].X_MT, way[last].X_MT};
  const double turn = chord_M.angle();
  const double time = toSeconds(way[last].time - way[first].time);
  const auto along = [&](size_t i) {
    if (time > 0.0) return toSeconds(way[i].time - way[first].time) / time;
    return static_cast<double>(i - first) / static_cast<double>(last - first);
  };
  double off = 0.0;
  double arc = 0.0;
  for (size_t i = first + 1; i <= last; ++i) {
    if (i < last) off = std::max(off, apart(chord_M.at(along(i)), way[i].X_MT, tool_extent));
    arc = std::max(arc, way[i].arc + chordError(tool_extent, (along(i) - along(i - 1)) * turn));
  }
  chord_M.bulge = off + arc + chordError(tool_extent, turn);
  return chord_M;
}

size_t lastOfChord(const Waypoints& way, size_t first, size_t last, double tool_extent, const ChordLimits& limits) {
  const auto fits = [&](size_t end) {
    const Motion chord_M = chord(way, first, end, tool_extent);
    return chord_M.bulge <= limits.max_bulge && chord_M.angle() <= limits.max_rotation;
  };
  size_t end = first + 1;
  size_t step = 1;
  for (; end < last && fits(std::min(end + step, last)); step *= 2) end = std::min(end + step, last);
  for (step /= 2; step > 0; step /= 2) {
    if (end + step < last && fits(end + step)) end += step;
  }
  return end;
}

}  // namespace sweep_guard
