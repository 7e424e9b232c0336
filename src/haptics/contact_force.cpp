#include "sweep_guard/haptics/contact_force.h"

#include <algorithm>
#include <optional>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kPlanes = 64;   // before buffers grow
constexpr size_t kBalls = 4096;  // of a piece

void push(ToolForce& force, const Eigen::Vector3d& push_W, const Eigen::Vector3d& at_W) {
  force.force_W += push_W;
  force.torque_W += at_W.cross(push_W);
}

}  // namespace

ContactForceFinder::ContactForceFinder() {
  facing_.reserve(kBalls);
  nearest_.reserve(kPlanes);
  touching_.reserve(kPlanes);
  half_spaces_.reserve(kPlanes);
}

ToolForce ContactForceFinder::find(const PlaneSet& planes, const ToolBalls& tool, const PiecePoses& poses,
                                   const Twist& twist_W, const ContactLaw& law) {
  collectNearestBalls(planes, tool, poses);
  ToolForce force = contact(twist_W, law);
  if (law.cue_damping > 0.0) addCue(twist_W, law, force);
  return force;
}

void ContactForceFinder::collectNearestBalls(const PlaneSet& planes, const ToolBalls& tool, const PiecePoses& poses) {
  nearest_.clear();
  for (const SeparatingPlane& plane : planes.planes) {
    const std::vector<ToolBall>& balls_P = tool.pieces[plane.piece];
    facing_.clear();
    const Eigen::Isometry3d& X_WP = poses.of(plane.piece);
    addFacingBalls(plane, balls_P, X_WP, facing_);
    const auto nearer = [](const FacingBall& a, const FacingBall& b) { return a.gap < b.gap; };
    const auto nearest = std::min_element(facing_.begin(), facing_.end(), nearer);
    const double radius = balls_P[static_cast<size_t>(nearest - facing_.begin())].radius;
    nearest->center_W += X_WP.translation() - poses.X_WT.translation() - radius * plane.normal_W;
    nearest_.push_back(*nearest);
  }
}

ToolForce ContactForceFinder::contact(const Twist& twist_W, const ContactLaw& law) {
  touching_.clear();
  half_spaces_.clear();
  for (size_t i = 0; i < nearest_.size(); ++i) {
    const double depth = law.distance - nearest_[i].gap;
    if (!(depth > 0.0)) continue;
    touching_.push_back(i);
    half_spaces_.push_back(
        {{-nearest_[i].normal_W.x(), -nearest_[i].normal_W.y(), -nearest_[i].normal_W.z(), 0.0}, -depth});
  }
  const std::optional<NearestPoint> freed = nearestPoint(Eigen::Vector4d::Zero(), half_spaces_);
  if (!freed || !(freed->point.norm() > 0.0)) return {};

  ToolForce force;
  force.depth = freed->point.norm();
  double deepening = 0.0;
  for (size_t i = 0; i < freed->active.size(); ++i) {
    const FacingBall& ball = nearest_[touching_[freed->active[i]]];
    deepening += freed->multipliers[i] / force.depth * closingSpeed(ball, twist_W);
    push(force, freed->multipliers[i] * ball.normal_W, ball.center_W);
  }
  const double scale = std::max(0.0, law.stiffness + law.damping * deepening / force.depth);
  force.force_W *= scale;
  force.torque_W *= scale;
  return force;
}

void ContactForceFinder::addCue(const Twist& twist_W, const ContactLaw& law, ToolForce& force) const {
  double strongest = 0.0;
  const FacingBall* met = nullptr;
  for (const FacingBall& ball : nearest_) {
    const double gap = ball.gap - law.distance;
    const double speed = closingSpeed(ball, twist_W);
    if (gap <= 0.0 || speed * law.cue_time <= gap) continue;
    const double strength = law.cue_damping * (speed - gap / law.cue_time);
    if (strength <= strongest) continue;
    strongest = strength;
    met = &ball;
  }
  if (met != nullptr) push(force, strongest * met->normal_W, met->center_W);
}

void requireUsable(const ContactLaw& law) {
  if (!(law.stiffness >= 0.0)) throw InvalidInput("stiffness: must be >= 0 N/m");
  if (!(law.damping >= 0.0) || !(law.cue_damping >= 0.0)) throw InvalidInput("damping: must be >= 0 N s/m");
  if (!(law.distance >= 0.0)) throw InvalidInput("distance from a plane: must be >= 0 m");
  if (!(law.cue_time > 0.0)) throw InvalidInput("time of the cue: must be > 0 s");
}

}  // namespace sweep_guard_core
