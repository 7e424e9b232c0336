// Prints how much larger the tested volumes are than the volume that the tool sweeps, for motions of a hand.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "scenes.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/geometry/convex_hull.h"
#include "sweep_guard/geometry/half_space.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {
namespace {

constexpr int kMotions = 1000;
constexpr int kPoints = 4000;  // for each motion
constexpr int kSides = 64;
constexpr double kPi = 3.141592653589793;
constexpr double kRadius = 0.005;    // [m]
constexpr double kLength = 0.1;      // [m]
constexpr double kTolerance = 1e-8;  // [m]

double distanceToDrill(const Eigen::Vector3d& p_T) {
  const double beside = std::max(0.0, p_T.head<2>().norm() - kRadius);
  const double beyond = std::max({0.0, p_T.z(), -kLength - p_T.z()});
  return std::hypot(beside, beyond);
}

// Whether the drill reaches a point at any time. No time is left out: in one step the drill moves no farther than it
// was away from the point.
bool reaches(const Motion& motion, const Eigen::Vector3d& p_M) {
  const Eigen::Vector3d step = motion.X_MT_end.translation() - motion.X_MT_start.translation();
  const double farthest = (p_M - motion.X_MT_start.translation()).norm() + step.norm();
  const double speed = step.norm() + motion.angle() * farthest;
  double t = 0.0;
  while (t <= 1.0) {
    const double distance = distanceToDrill(motion.at(t).inverse() * p_M);
    if (distance < kTolerance) return true;
    t += distance / speed;
  }
  return false;
}

struct Estimate {
  double volume;          // [m^3]
  double standard_error;  // [m^3]
};

// Estimates the volume that the drill sweeps; all of it lies inside `bounds`.
Estimate sweptVolumeIn(const SweptVolume& bounds, const Motion& motion, Random& random) {
  const Clips clips_B = bounds.clips_B;
  int hits = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d p_B = random.inBox(bounds.box.half_extents);
    const bool cut_off = std::any_of(clips_B.begin(), clips_B.end(),
                                     [&](const HalfSpace& clip_B) { return clip_B.signedDistance(p_B) > 0.0; });
    if (!cut_off && reaches(motion, bounds.box.X_MB * p_B)) ++hits;
  }
  const double box = 8.0 * bounds.box.half_extents.prod();
  const double share = static_cast<double>(hits) / kPoints;
  return {box * share, box * std::sqrt(share * (1.0 - share) / kPoints)};
}

double volumeOf(const SweptVolume& volume) {
  return polytopeVolume(polytopeFaces(volume.halfSpaces_B(), volume.box.half_extents.norm()));
}

// The corners of a prism with 64 sides whose cross section is as large as the drill's.
std::vector<Eigen::Vector3d> cornersOfDrill() {
  const double angle = 2.0 * kPi / kSides;
  const double radius = kRadius * std::sqrt(angle / std::sin(angle));
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < kSides; ++i) {
    for (const double z : {0.0, -kLength}) {
      corners.emplace_back(radius * std::cos(angle * i), radius * std::sin(angle * i), z);
    }
  }
  return corners;
}

ConvexHull hullOfBothPoses(const Motion& motion) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p_T : cornersOfDrill()) {
    points.push_back(motion.X_MT_start * p_T);
    points.push_back(motion.X_MT_end * p_T);
  }
  return convexHull(points);
}

// The volume of a grown convex body by Steiner's formula: from its volume, surface and mean width.
double volumeOfGrown(const ConvexHull& hull, double distance, Random& random) {
  constexpr int kDirections = 100;
  double mean_width = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const Eigen::Vector3d direction = random.direction();
    double lower = 0.0;
    double upper = 0.0;
    for (const Eigen::Vector3d& corner : hull.corners) {
      lower = std::min(lower, direction.dot(corner - hull.corners[0]));
      upper = std::max(upper, direction.dot(corner - hull.corners[0]));
    }
    mean_width += (upper - lower) / kDirections;
  }
  return volume(hull) + surface(hull) * distance + 2.0 * kPi * mean_width * std::pow(distance, 2) +
         4.0 / 3.0 * kPi * std::pow(distance, 3);
}

struct Row {
  std::string name;
  std::vector<double> ratios = {};
  double sum = 0.0;

  void add(double volume, double truth) {
    ratios.push_back(volume / truth);
    sum += volume;
  }
  void print() const {
    std::printf("%-30s %6.3f %6.3f %6.3f", name.c_str(), quantile(ratios, 0.1), quantile(ratios, 0.5),
                quantile(ratios, 0.9));
  }
};

int main() {
  const ConvexShape tool = ConvexShape::cylinder(kRadius, kLength);
  Random motions(/*seed=*/1);
  Random points(/*seed=*/2);
  std::vector<Row> rows = {{"obb"}, {"obb_planes"}, {"hull"}, {"hull of both poses, not grown"}};
  Row planes_to_box{"obb_planes / obb"};
  double truth = 0.0;
  double variance = 0.0;
  std::vector<double> relative_errors;
  for (int i = 0; i < kMotions; ++i) {
    const Motion motion = handMotion(motions);
    const SweptVolume box = sweptVolume(tool, motion, VolumeKind::kObb);
    const SweptVolume planes = sweptVolume(tool, motion, VolumeKind::kObbPlanes);
    const ConvexHull hull = hullOfBothPoses(motion);
    const Estimate swept = sweptVolumeIn(planes, motion, points);
    truth += swept.volume;
    variance += std::pow(swept.standard_error, 2);
    relative_errors.push_back(swept.standard_error / swept.volume);
    rows[0].add(volumeOf(box), swept.volume);
    rows[1].add(volumeOf(planes), swept.volume);
    rows[2].add(volumeOfGrown(hull, planes.margin, points), swept.volume);
    rows[3].add(volume(hull), swept.volume);
    planes_to_box.add(volumeOf(planes), volumeOf(box));
  }
  std::printf(
      "Tested volume / volume swept by a drill of %.0f x %.0f mm, arcs included. %d motions of 1 to 20 mm and\n",
      2e3 * kRadius, 1e3 * kLength, kMotions);
  std::printf("0 to 10 degrees. The swept volume is estimated from %d points per motion; its standard error is\n",
              kPoints);
  std::printf("%.1f %% of one (median), %.2f %% of the sum.\n\n", 1e2 * quantile(relative_errors, 0.5),
              1e2 * std::sqrt(variance) / truth);
  std::printf("%-30s %6s %6s %6s %8s\n", "", "p10", "median", "p90", "of sums");
  for (const Row& row : rows) {
    row.print();
    std::printf(" %8.3f\n", row.sum / truth);
  }
  planes_to_box.print();
  std::printf("\n");
  return 0;
}

}  // namespace
}  // namespace sweep_guard_core

int main() { return sweep_guard_core::main(); }
