#include "guard/intended_touches.h"

#include <algorithm>

#include "detection/placed_core.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kLeft = 0.01;  // [m]

struct Box {
  Eigen::AlignedBox3d box;

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    return (direction.array() < 0.0).select(box.min(), box.max());
  }
};

Eigen::AlignedBox3d boxAround(const Workpiece& workpiece, const std::string& link, const Intentions& intentions) {
  Eigen::AlignedBox3d box;
  for (const Intention& intention : intentions) {
    if (!intention.concerns(workpiece) || !intention.allows(link)) continue;
    for (const std::uint32_t triangle : intention.triangles) {
      for (const std::uint32_t corner : (*intention.mesh_triangles)[triangle])
        box.extend(workpiece.mesh_M.vertex(corner));
    }
  }
  return box;
}

bool isAway(const ConvexPiece& piece, const Eigen::Isometry3d& X_MT, const Eigen::AlignedBox3d& box_M) {
  const Eigen::Vector3d base_M = box_M.center();
  const PlacedCore tool{piece.shape_T, X_MT.linear(), X_MT.translation() - base_M};
  return distanceExceeds(tool, Box{{box_M.min() - base_M, box_M.max() - base_M}}, kLeft + piece.shape_T.padding());
}

bool hasLeft(const std::string& link, const Workpiece& workpiece, const PoseWithFrames& pose,
             const Eigen::Isometry3d& X_WB, const Tool& body, const Intentions& intentions) {
  const Eigen::AlignedBox3d box_M = boxAround(workpiece, link, intentions);
  const auto X_WM = pose.X_WM.find(workpiece.frame);
  if (box_M.isEmpty() || X_WM == pose.X_WM.end()) return true;
  const Eigen::Isometry3d X_MT = X_WM->second.inverse() * X_WB;
  return std::all_of(body.pieces().begin(), body.pieces().end(),
                     [&](const ConvexPiece& piece) { return piece.link != link || isAway(piece, X_MT, box_M); });
}

}  // namespace

void IntendedTouches::update(const SweepReport& report, const PoseWithFrames& pose, const Eigen::Isometry3d& X_WB,
                             const Tool& body, const Intentions& intentions) {
  if (intentions.empty()) return clear();
  const auto is_over = [&](const Touch& touch) {
    const auto same = [&](const SweptObject& object) { return object.workpiece->id == touch.mesh_id; };
    const auto object = std::find_if(report.objects.begin(), report.objects.end(), same);
    return object == report.objects.end() || hasLeft(touch.link, *object->workpiece, pose, X_WB, body, intentions);
  };
  touches_.erase(std::remove_if(touches_.begin(), touches_.end(), is_over), touches_.end());
  for (const SweptObject& object : report.objects) {
    for (const TriangleContact& contact : object.result.in_contact) {
      const Touch touch{object.workpiece->id, body.pieces()[contact.piece].link};
      const bool is_new = contact.intended && std::find(touches_.begin(), touches_.end(), touch) == touches_.end();
      if (is_new) touches_.push_back(touch);
    }
  }
}

bool IntendedTouches::contains(const std::string& mesh_id, const std::string& link) const {
  return std::any_of(touches_.begin(), touches_.end(),
                     [&](const Touch& touch) { return touch.mesh_id == mesh_id && touch.link == link; });
}

}  // namespace sweep_guard_core
