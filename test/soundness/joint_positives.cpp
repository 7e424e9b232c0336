#include "soundness/joint_positives.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinematics/random_robot.h"
#include "soundness/exact_motion.h"

namespace sweep_guard_core::soundness {
namespace {

constexpr int kTriangles = 400;
constexpr size_t kMaxParts = 64;
constexpr double kInset = 1e-9;  // of the size of robot and tool: more than their poses are rounded by

// A robot that moves from one state to the other, straight in the space of its joints.
struct JointMotion {
  const KinematicTree& tree;
  size_t link;
  const RobotState& from;
  const RobotState& to;

  Vector3r at(Real fraction, const Vector3r& p_B) const {
    Vector3r p = p_B;
    for (size_t i = link; i != TreeLink::kRoot; i = tree.links()[i].parent) p = inParent(tree.links()[i], fraction, p);
    return ExactMotion(Motion{from.X_WR, to.X_WR}).at(fraction, p);
  }

  Vector3r inParent(const TreeLink& link_L, Real fraction, const Vector3r& p_L) const {
    Vector3r p_J = p_L;
    const Vector3r axis = link_L.axis_J.cast<Real>();
    if (link_L.type == JointType::kRevolute) p_J = Eigen::AngleAxis<Real>(position(link_L, fraction), axis) * p_L;
    if (link_L.type == JointType::kPrismatic) p_J += position(link_L, fraction) * axis;
    const Matrix3r R_PJ = link_L.X_PJ.linear().cast<Real>();
    return R_PJ * p_J + link_L.X_PJ.translation().cast<Real>();
  }

  Real position(const TreeLink& link_L, Real fraction) const {
    const Real start = from.positions[link_L.variable];
    const Real end = to.positions[link_L.variable];
    return link_L.multiplier * (start + fraction * (end - start)) + link_L.offset;
  }
};

Vector3r randomLinkPoint(Random& random, const Body& body, Real inset) {
  const Vector3r p = support(body, random.direction().cast<Real>(), inset);
  const Vector3r q = support(body, random.direction().cast<Real>(), inset);
  return random.chance(0.7) ? p : Vector3r(p + static_cast<Real>(random.uniform(0.0, 1.0)) * (q - p));
}

std::array<Eigen::Vector3d, 3> triangleThrough(Random& random, const Vector3r& p, double size) {
  const double u = random.uniform(0.0, 1.0);
  const double v = random.uniform(0.0, 1.0) * (1.0 - u);
  const Eigen::Vector3d first_edge = size * random.direction();
  const Eigen::Vector3d second_edge = size * random.direction();
  const Eigen::Vector3d first = p.cast<double>() - u * first_edge - v * second_edge;
  return {first, first + first_edge, first + second_edge};
}

Bodies randomPiece(Random& random) {
  Bodies bodies;
  do {
    bodies = randomBodies(random, random.logUniform(0.01, 0.2));
  } while (!hasInset(bodies.front(), kInset));
  return {bodies.front()};
}

}  // namespace

SweepCase jointPositives(std::uint64_t seed) {
  Random random(seed);
  SweepCase sweep;
  sweep.tool = randomPiece(random);
  const KinematicTree tree = randomRobot(random, 2 + static_cast<size_t>(random.below(6)), /*branches=*/false);
  const RobotState from = randomState(random, tree, 3.0);
  const RobotState to = randomStateNear(random, from, random.logUniform(1e-4, 1.0));
  const std::vector<RobotBody> bodies{{tree.links().size() - 1, toolOf(sweep.tool).boundingRadius()}};

  const RobotMotion motion(tree, bodies, from, to);
  const size_t parts = motion.partsFor(random.logUniform(1e-4, 0.1), kMaxParts);
  const auto part = static_cast<double>(random.below(static_cast<int>(parts)));
  const auto poseAt = [&](double fraction) {
    std::vector<Eigen::Isometry3d> X_WB;
    bodyPoses(tree, bodies, motion.at(fraction), X_WB);
    return X_WB.front();
  };
  const auto count = static_cast<double>(parts);
  sweep.motion = {poseAt(part / count), poseAt((part + 1.0) / count), motion.deviationBound(0, parts)};

  const JointMotion exact{tree, bodies.front().link, from, to};
  const double size = extentOf(sweep.tool) * random.logUniform(1e-3, 1.0);
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    const double fraction = random.chance(0.3) ? 0.5 : random.uniform(0.0, 1.0);
    const Vector3r p_B = randomLinkPoint(random, sweep.tool.front(), kInset);
    const Vector3r p_W =
        exact.at((static_cast<Real>(part) + static_cast<Real>(fraction)) / static_cast<Real>(count), p_B);
    const auto corners = triangleThrough(random, p_W, size);
    sweep.triangles.corners_M.insert(sweep.triangles.corners_M.end(), corners.begin(), corners.end());
    sweep.contacts.push_back({i, fraction, fraction});
  }
  return sweep;
}

}  // namespace sweep_guard_core::soundness
