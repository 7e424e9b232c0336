#include "sweep_guard/interaction/interaction_finder.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard_core {
namespace {

constexpr Duration kLongest = std::chrono::milliseconds(100);  // between two poses

Eigen::Isometry3d bodyInTool(const PoseWithFrames& pose, size_t body) {
  if (pose.state.positions.empty()) return Eigen::Isometry3d::Identity();  // without rounding
  return pose.X_WT.inverse() * pose.bodies[body].X_WB;
}

Interpenetration inTool(const Eigen::Isometry3d& X_TB, Interpenetration found) {
  found.centroid_T = X_TB * found.centroid_T;
  found.area_T = X_TB.linear() * found.area_T;
  return found;
}

}  // namespace

ForceLaw InteractionOptions::lawOf(const std::string& id) const {
  ForceLaw of_workpiece = law;
  const auto own = stiffness_of.find(id);
  if (own != stiffness_of.end()) of_workpiece.stiffness = own->second;
  return of_workpiece;
}

Wrench& Wrench::operator+=(const Wrench& other) {
  force_T += other.force_T;
  torque_T += other.torque_T;
  return *this;
}

Wrench interactionForce(const Interpenetration& found, const Eigen::Vector3d& velocity_T, const ForceLaw& law) {
  assert(law.least_area > 0.0);
  const Eigen::Vector3d direction_T = found.area_T / std::max(found.area_T.norm(), law.least_area);
  const double closing = -velocity_T.dot(direction_T);
  const double damped = std::max(0.0, 1.0 + law.damping * closing);
  Wrench wrench;
  wrench.force_T = law.stiffness * found.volume * damped * direction_T;
  wrench.torque_T = found.centroid_T.cross(wrench.force_T);
  return wrench;
}

InterpenetrationFinders interpenetrationFinders(const std::vector<Tool>& bodies) {
  InterpenetrationFinders finders;
  for (const Tool& body : bodies) {
    finders.emplace_back();
    for (const ConvexPiece& piece : body.pieces()) finders.back().emplace_back(piece.shape_T);
  }
  return finders;
}

void InteractionFinder::ToolMotion::moveTo(const PoseWithFrames& pose, const std::string& frame,
                                           const Eigen::Isometry3d& X_WM, size_t bodies) {
  std::swap(before_, now_);
  now_.X_MB.clear();
  for (size_t i = 0; i < bodies; ++i) now_.X_MB.push_back(X_WM.inverse() * pose.bodies[i].X_WB);
  now_.frame = frame;
  now_.stamp = pose.stamp;
  const Duration since = now_.stamp - before_.stamp;
  known_ = before_.X_MB.size() == bodies && before_.frame == frame && since > Duration::zero() && since <= kLongest;
}

Eigen::Vector3d InteractionFinder::ToolMotion::velocity_B(size_t body, const Eigen::Vector3d& p_B) const {
  if (!known_) return Eigen::Vector3d::Zero();
  const Eigen::Isometry3d& X_MB = now_.X_MB[body];
  const double seconds = toSeconds(now_.stamp - before_.stamp);
  return X_MB.linear().transpose() * (X_MB * p_B - before_.X_MB[body] * p_B) / seconds;
}

void InteractionFinder::find(const PoseWithFrames& pose, const Workpieces& workpieces,
                             const InteractionOptions& options, Interaction& interaction) {
  assert(bodies_.size() == pose.bodies.size());
  interaction.objects.clear();
  interaction.unplaced.clear();
  interaction.total = Wrench();
  eraseRemoved(workpieces, motions_);
  for (const auto& workpiece : workpieces) {
    if (workpiece->of_camera) continue;
    const auto X_WM = pose.X_WM.find(workpiece->frame);
    if (X_WM == pose.X_WM.end()) {
      motions_.erase(workpiece->id);
      interaction.unplaced.push_back(workpiece);
      continue;
    }
    ToolMotion& motion = motions_[workpiece->id];
    motion.moveTo(pose, workpiece->frame, X_WM->second, bodies_.size());
    const ObjectInteraction found = interact(workpiece, pose, motion, options);
    if (found.volume == 0.0 && found.area_T.isZero(0.0)) continue;
    interaction.total += found.wrench;
    interaction.objects.push_back(found);
  }
}

ObjectInteraction InteractionFinder::interact(const std::shared_ptr<const Workpiece>& workpiece,
                                              const PoseWithFrames& pose, const ToolMotion& motion,
                                              const InteractionOptions& options) {
  const ForceLaw law = options.lawOf(workpiece->id);
  ObjectInteraction sum;
  sum.workpiece = workpiece;
  Eigen::Vector3d moment_T = Eigen::Vector3d::Zero();
  for (size_t body = 0; body < bodies_.size(); ++body) {
    const Eigen::Isometry3d X_TB = bodyInTool(pose, body);
    for (InterpenetrationFinder& piece : bodies_[body]) {
      const Interpenetration found_B = piece.find(workpiece->mesh_M, motion.X_MB(body));
      const Interpenetration found = inTool(X_TB, found_B);
      sum.enclosed = found.enclosed;
      sum.volume += found.volume;
      moment_T += found.volume * found.centroid_T;
      sum.area_T += found.area_T;
      sum.depth = std::max(sum.depth, found.depth(law.least_area));
      sum.wrench += interactionForce(found, X_TB.linear() * motion.velocity_B(body, found_B.centroid_T), law);
    }
  }
  sum.counted_twice = sum.enclosed && workpiece->mesh_M.enclosure().partsOverlap();
  if (sum.volume > 0.0) sum.centroid_T = moment_T / sum.volume;
  return sum;
}

}  // namespace sweep_guard_core
