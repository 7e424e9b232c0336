#include "guard/intended_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "common/floating_point.h"
#include "detection/placed_core.h"
#include "guard/moving_mesh.h"
#include "sweep_guard/geometry/separation.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {
namespace {

constexpr double kMinSine = 1e-9;  // of the angle between two edges of a triangle that has a normal

using Corners = std::array<Eigen::Vector3d, 3>;

std::optional<Eigen::Vector3d> unitNormal(const Corners& p) {
  const Eigen::Vector3d one = p[1] - p[0];
  const Eigen::Vector3d other = p[2] - p[0];
  const Eigen::Vector3d normal = one.cross(other);
  const double length = normal.norm();
  if (!(length > kMinSine * one.norm() * other.norm())) return std::nullopt;
  return normal / length;
}

double highest(const Eigen::Vector3d& direction, const Corners& p, const Eigen::Vector3d& base) {
  return std::max({direction.dot(p[0] - base), direction.dot(p[1] - base), direction.dot(p[2] - base)});
}

constexpr double kLeft = 0.01;  // [m]

Eigen::AlignedBox3d boxAroundIntended(const Workpiece& workpiece, const std::string& link,
                                      const Intentions& intentions) {
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

bool isAway(const ConvexPiece& piece, const Eigen::Isometry3d& X_MT, const Eigen::AlignedBox3d& box_M, double padding) {
  const Eigen::Vector3d base_M = box_M.center();
  const PlacedCore tool{piece.shape_T, X_MT.linear(), X_MT.translation() - base_M};
  const Eigen::AlignedBox3d box(box_M.min() - base_M, box_M.max() - base_M);
  const auto corner = [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
    return (direction.array() < 0.0).select(box.min(), box.max());
  };
  return distanceExceeds(tool, corner, kLeft + piece.shape_T.padding() + padding);
}

bool hasLeft(const std::string& link, const Workpiece& workpiece, const PoseWithFrames& pose,
             const Eigen::Isometry3d& X_WB, const Tool& body, const Intentions& intentions) {
  const Eigen::AlignedBox3d box_M = boxAroundIntended(workpiece, link, intentions);
  const auto X_WM = pose.X_WM.find(workpiece.frame);
  if (box_M.isEmpty() || X_WM == pose.X_WM.end()) return true;
  const Eigen::Isometry3d X_MT = X_WM->second.inverse() * X_WB;
  return std::all_of(body.pieces().begin(), body.pieces().end(), [&](const ConvexPiece& piece) {
    return piece.link != link || isAway(piece, X_MT, box_M, workpiece.mesh_M.padding());
  });
}

}  // namespace

IntendedTriangles::IntendedTriangles(std::vector<const Intention*> regions, const Tool& tool, const std::string& link,
                                     const std::vector<Motion>& sub_motions_M, double margin)
    : regions_(std::move(regions)), base_M_(sub_motions_M.front().X_MT_start.translation()) {
  for (Motion motion_M : sub_motions_M) {
    motion_M.mesh_translation.setZero();
    radius_ = std::max({radius_, (motion_M.X_MT_start.translation() - base_M_).norm(),
                        (motion_M.X_MT_end.translation() - base_M_).norm()});
    for (const ConvexPiece& piece : tool.pieces()) {
      if (piece.link != link) continue;
      bodies_.push_back({&piece.shape_T, motion_M, deviationBound(piece.shape_T, motion_M) + margin});
    }
  }
  radius_ += tool.boundingRadius();
}

bool IntendedTriangles::contains(std::uint32_t triangle, const MovingTriangle& triangle_M) {
  std::optional<double> depth;
  return std::any_of(regions_.begin(), regions_.end(), [&](const Intention* region) {
    if (!region->holds(triangle)) return false;
    if (isProvenWithin(region->depth, triangle_M)) return true;
    if (!depth) depth = depthBehind(triangle_M).value_or(kInfinity);
    return *depth <= region->depth;
  });
}

bool IntendedTriangles::contains(std::uint32_t triangle, const TriangleMesh& at_rest_M) {
  const auto holds = [&](const Intention* region) { return region->holds(triangle); };
  return std::any_of(regions_.begin(), regions_.end(), holds) &&
         contains(triangle, MovingMesh(at_rest_M).triangle(triangle));
}

// Of neighbors with nearly the same normal: no point of the tool is farther from the base than the radius.
bool IntendedTriangles::isProvenWithin(double depth, const MovingTriangle& triangle_M) const {
  if (last_normal_.isZero(0.0) || triangle_M.start_M != triangle_M.end_M) return false;
  const auto normal = unitNormal(triangle_M.end_M);
  return normal && surface(*normal, triangle_M) + last_reach_ + (*normal - last_normal_).norm() * radius_ <= depth;
}

std::optional<double> IntendedTriangles::depthBehind(const MovingTriangle& triangle_M) {
  double depth = -kInfinity;
  for (const Corners& corners : {triangle_M.start_M, triangle_M.end_M}) {
    const auto normal = unitNormal(corners);
    if (!normal) return std::nullopt;
    depth = std::max(depth, surface(*normal, triangle_M) + reachBehind(*normal));
  }
  return depth;
}

double IntendedTriangles::surface(const Eigen::Vector3d& normal, const MovingTriangle& triangle_M) const {
  return std::max(highest(normal, triangle_M.start_M, base_M_), highest(normal, triangle_M.end_M, base_M_));
}

double IntendedTriangles::reachBehind(const Eigen::Vector3d& normal) {
  if (normal == last_normal_) return last_reach_;
  last_normal_ = normal;
  last_reach_ = -kInfinity;
  for (const Body& body : bodies_) {
    last_reach_ = std::max(last_reach_, support(*body.shape_T, body.motion_M, -normal) + body.growth);
  }
  last_reach_ += normal.dot(base_M_);
  return last_reach_;
}

void IntendedTouches::update(const SweepReport& report, const PoseWithFrames& pose, const Eigen::Isometry3d& X_WB,
                             const Tool& body, const Intentions& intentions) {
  if (intentions.empty()) return clear();
  for (auto entry = links_.begin(); entry != links_.end();) {
    auto& [id, links] = *entry;
    const auto same = [&, &id = id](const SweptObject& object) { return object.workpiece->id == id; };
    const auto object = std::find_if(report.objects.begin(), report.objects.end(), same);
    for (auto link = links.begin(); link != links.end();) {
      const bool is_over =
          object == report.objects.end() || hasLeft(*link, *object->workpiece, pose, X_WB, body, intentions);
      link = is_over ? links.erase(link) : std::next(link);
    }
    entry = links.empty() ? links_.erase(entry) : std::next(entry);
  }
  for (const SweptObject& object : report.objects) {
    for (const TriangleContact& contact : object.result.in_contact)
      if (contact.intended) links_[object.workpiece->id].insert(body.pieces()[contact.piece].link);
  }
}

bool IntendedTouches::contains(const std::string& mesh_id, const std::string& link) const {
  const auto links = links_.find(mesh_id);
  return links != links_.end() && links->second.count(link) != 0;
}

}  // namespace sweep_guard_core
