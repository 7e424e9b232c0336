#include "sweep_guard/interaction/interaction_finder.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr double kLongest = 0.1;  // between two poses [s]

ForceLaw lawOf(const Workpiece& workpiece, const InteractionOptions& options) {
  ForceLaw law = options.law;
  const auto own = options.stiffness_of.find(workpiece.id);
  if (own != options.stiffness_of.end()) law.stiffness = own->second;
  return law;
}

}  // namespace

std::vector<InterpenetrationFinder> interpenetrationFinders(const Tool& tool) {
  std::vector<InterpenetrationFinder> finders;
  for (const ConvexPiece& piece : tool.pieces()) finders.emplace_back(piece.shape_T);
  return finders;
}

/// The tool at two poses relative to a workpiece.
class InteractionFinder::ToolMotion {
 public:
  ToolMotion(const Eigen::Isometry3d& X_MT, const Eigen::Isometry3d& before, double seconds)
      : X_MT_(X_MT), before_(before), seconds_(seconds) {}

  const Eigen::Isometry3d& X_MT() const { return X_MT_; }
  Eigen::Vector3d velocity_T(const Eigen::Vector3d& p_T) const {
    return X_MT_.linear().transpose() * (X_MT_ * p_T - before_ * p_T) / seconds_;
  }

 private:
  Eigen::Isometry3d X_MT_;
  Eigen::Isometry3d before_;
  double seconds_;
};

void InteractionFinder::find(const InteractionRequest& request, Interaction& interaction) {
  interaction.objects.clear();
  interaction.unplaced.clear();
  interaction.total = Wrench();
  forgetRemoved(request.workpieces);
  for (const auto& workpiece : request.workpieces) {
    const auto X_WM = request.pose.X_WM.find(workpiece->frame);
    if (X_WM == request.pose.X_WM.end()) {
      earlier_.erase(workpiece->id);
      interaction.unplaced.push_back(workpiece);
      continue;
    }
    const PlacedTool now{X_WM->second.inverse() * request.pose.X_WT, workpiece->frame, request.pose.stamp};
    const ObjectInteraction found = interact(workpiece, motionOf(*workpiece, now), request.options);
    if (found.volume == 0.0 && found.area_T.isZero(0.0)) continue;
    interaction.total += found.wrench;
    interaction.objects.push_back(found);
  }
}

void InteractionFinder::forgetRemoved(const Workpieces& workpieces) {
  for (auto earlier = earlier_.begin(); earlier != earlier_.end();) {
    const auto same = [&](const auto& workpiece) { return workpiece->id == earlier->first; };
    const bool there = std::any_of(workpieces.begin(), workpieces.end(), same);
    earlier = there ? std::next(earlier) : earlier_.erase(earlier);
  }
}

InteractionFinder::ToolMotion InteractionFinder::motionOf(const Workpiece& workpiece, const PlacedTool& now) {
  const auto [earlier, first] = earlier_.emplace(workpiece.id, now);
  const PlacedTool before = earlier->second;
  earlier->second = now;
  const double seconds = toSeconds(now.stamp - before.stamp);
  if (first || before.frame != now.frame || !(seconds > 0.0 && seconds <= kLongest)) {
    return {now.X_MT, now.X_MT, kLongest};
  }
  return {now.X_MT, before.X_MT, seconds};
}

ObjectInteraction InteractionFinder::interact(const std::shared_ptr<const Workpiece>& workpiece,
                                              const ToolMotion& motion, const InteractionOptions& options) {
  const ForceLaw law = lawOf(*workpiece, options);
  ObjectInteraction sum;
  sum.workpiece = workpiece;
  Eigen::Vector3d moment_T = Eigen::Vector3d::Zero();
  for (InterpenetrationFinder& piece : pieces_) {
    const Interpenetration found = piece.find(workpiece->mesh_M, motion.X_MT());
    sum.enclosed = found.enclosed;
    sum.volume += found.volume;
    moment_T += found.volume * found.centroid_T;
    sum.area_T += found.area_T;
    sum.depth = std::max(sum.depth, found.depth(law.least_area));
    sum.wrench += interactionForce(found, motion.velocity_T(found.centroid_T), law);
  }
  if (sum.volume > 0.0) sum.centroid_T = moment_T / sum.volume;
  return sum;
}

}  // namespace sweep_guard_core
