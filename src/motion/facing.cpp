#include "motion/facing.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "common/heartbeat.h"
#include "geometry/penetration.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kLongest = 1.0;  // [s]; a surface that was not heard of for longer rests

// A snapshot without a stamp is from before time went back.
double driftOf(const Workpiece& workpiece, const PoseWithFrames& pose) {
  const auto drift = pose.drifts.find(workpiece.frame);
  const TriangleMesh& mesh_M = workpiece.mesh_M;
  return drift == pose.drifts.end() ? 0.0 : drift->second.displacement(mesh_M.origin().norm() + mesh_M.radius());
}

double ageOf(const Workpiece& workpiece, const PoseWithFrames& pose) {
  const bool stamped = workpiece.stamp != Time();
  const double age = toSeconds(stamped ? pose.stamp - workpiece.stamp : pose.received - workpiece.received);
  return age > kLongest ? 0.0 : std::max(0.0, age);
}

// A frame that is followed has a velocity of its own; one whose static transform was replaced has not moved.
void updateMotion(const PoseWithFrames& pose, const std::shared_ptr<const Workpiece>& workpiece,
                  const Eigen::Isometry3d& X_WM, SurfaceMotion& motion) {
  const auto drift = pose.drifts.find(workpiece->frame);
  if (drift == pose.drifts.end()) return motion.update(workpiece, X_WM, pose.stamp);
  motion.update(workpiece, X_WM, pose.stamp, drift->second.velocity_W);
}

}  // namespace

// Triangles that are meant to be touched are not where the boxes of the mesh say.
double FacingBody::distance() const {
  if (contact.intendsAny()) return 0.0;
  PieceCover whole;
  whole.begin(tool->whole(), surface->workpiece->mesh_M, X_MT);
  return whole.distance(CenteredBox(surface->boxes.of(surface->workpiece->mesh_M.order())));
}

PieceCover::Corners Facing::corners(std::uint32_t triangle) const {
  PieceCover::Corners corners = cover.corners(mesh().triangles()[triangle]);
  const double depth = intendedDepth(triangle);
  if (depth == 0.0) return corners;
  const Eigen::Vector3d inwards = (corners[2] - corners[0]).cross(corners[1] - corners[0]).stableNormalized();
  for (Eigen::Vector3d& corner : corners) corner += depth * inwards;
  return corners;
}

std::uint32_t Facing::triangleAt(const Cluster& cluster, std::uint64_t bits) const {
  const auto& triangle_at = mesh().order().triangle_at;
  const std::uint32_t place = cluster.first + static_cast<std::uint32_t>(__builtin_ctzll(bits));
  return triangle_at.empty() ? place : triangle_at[place];
}

SeparatedTriangle Facing::separate(std::uint32_t triangle) {
  beat();
  const ConvexShape& shape_T = cover.shape_T();
  const PieceCover::Corners corners_T = cover.corners_T(corners(triangle));
  const PointHull hull(corners_T);
  const Separation apart = separation(shape_T, hull, /*accuracy=*/0.0, guess_T);
  guess_T = apart.gap > 0.0 ? apart.normal : contactNormal_T(triangle, corners_T);
  const Eigen::Vector3d top_T = hull.supportPoint(guess_T);
  return {triangle, guess_T, -shape_T.support(-guess_T) - guess_T.dot(top_T), top_T};
}

Eigen::Vector3d Facing::contactNormal_T(std::uint32_t triangle, const PieceCover::Corners& corners_T) const {
  if (const auto* contacts = surface->contacts) {
    const auto before = [](const TriangleContact& contact, std::uint32_t index) { return contact.triangle < index; };
    const auto contact = std::lower_bound(contacts->begin(), contacts->end(), triangle, before);
    const bool met = contact != contacts->end() && contact->triangle == triangle && body->has(contact->piece);
    if (met) return cover.normal_T(contact->impact.normal_M);
  }
  const PointHull hull(corners_T);
  const auto& [a, b, c] = corners_T;
  Eigen::Vector3d normal = (b - a).cross(c - a).stableNormalized();
  if (!(normal.norm() > 0.5)) normal = cover.shape_T().proposeNormal(corners_T);
  const double depth = depthAlong(normal, cover.shape_T(), hull);
  return depth <= depthAlong(-normal, cover.shape_T(), hull) ? normal : Eigen::Vector3d(-normal);
}

void Facing::forgetNearest() {
  nearest = std::numeric_limits<double>::infinity();
  cover.setNearest(std::nullopt);
}

void Facings::begin(const ProximityRequest& request, Workpieces& unplaced) {
  assert(request.bodies.size() == request.pose.bodies.size());
  margin_ = padding_ = 0.0;
  surface_count_ = 0;
  body_count_ = 0;
  count_ = 0;
  surfaces_.resize(std::max(surfaces_.size(), request.workpieces.size()));  // bodies point into it, facings into both
  bodies_.resize(std::max(bodies_.size(), request.workpieces.size() * request.bodies.size()));
  eraseRemoved(request.workpieces, motions_);
  for (const auto& workpiece : request.workpieces) {
    const auto X_WM = request.pose.X_WM.find(workpiece->frame);
    if (X_WM == request.pose.X_WM.end()) {
      unplaced.push_back(workpiece);
    } else {
      place(request, workpiece, X_WM->second);
    }
  }
}

void Facings::place(const ProximityRequest& request, const std::shared_ptr<const Workpiece>& workpiece,
                    const Eigen::Isometry3d& X_WM) {
  SurfaceMotion& motion = motions_[workpiece->id];
  updateMotion(request.pose, workpiece, X_WM, motion);
  if (!placeBodies(request, *workpiece, X_WM)) return;
  PlacedSurface& surface = surfaces_[surface_count_++];
  surface.workpiece = workpiece;
  surface.motion = &motion;
  surface.contacts = nullptr;
  if (request.swept != nullptr) {
    for (const SweptObject& object : request.swept->objects) {
      if (object.workpiece == workpiece) surface.contacts = &object.result.in_contact;
    }
  }
  surface.age = motion.deforms() ? ageOf(*workpiece, request.pose) : 0.0;
  surface.boxes.assign(workpiece->mesh_M.blocks());
  surface.drift = driftOf(*workpiece, request.pose);
  margin_ = std::max(margin_, workpiece->mesh_M.margin() + surface.drift);
  padding_ = std::max(padding_, workpiece->mesh_M.padding());
}

// Returns false if each body may touch the workpiece with every piece.
bool Facings::placeBodies(const ProximityRequest& request, const Workpiece& workpiece, const Eigen::Isometry3d& X_WM) {
  const size_t before = body_count_;
  size_t first_piece = 0;
  for (size_t i = 0; i < request.bodies.size(); ++i) {
    const Tool& tool = *request.bodies[i];
    ContactPolicy contact(tool, workpiece, request.allowed, request.intentions);
    if (!contact.allowsAll()) {
      const Eigen::Isometry3d& X_WT = request.pose.bodies[i].X_WB;
      FacingBody& body = bodies_[body_count_++];
      body = {&surfaces_[surface_count_], &tool, first_piece, std::move(contact), X_WT, X_WM.inverse() * X_WT};
      body.X_MT.translation() -= workpiece.mesh_M.origin();
    }
    first_piece += tool.pieces().size();
  }
  return body_count_ > before;
}

void Facings::face(size_t body) {
  const FacingBody& faced = bodies_[body];
  const auto& pieces = faced.tool->pieces();
  for (size_t piece = 0; piece < pieces.size(); ++piece) {
    if (faced.contact.allows(piece)) continue;
    if (count_ == facings_.size()) facings_.emplace_back();
    Facing& facing = facings_[count_++];
    facing.body = &faced;
    facing.surface = faced.surface;
    facing.piece = piece;
    facing.guess_T = Eigen::Vector3d::Zero();
    facing.forgetNearest();
    facing.cover.begin(pieces[piece].shape_T, facing.mesh(), faced.X_MT);
  }
}

double Facings::maxDisplacement() const {
  double displacement = 0.0;
  for (size_t i = 0; i < surface_count_; ++i)
    displacement = std::max(displacement, surfaces_[i].age * fastest(surfaces_[i]));
  return displacement;
}

double Facings::fastest(const PlacedSurface& surface) {
  return surface.motion->fastest(CenteredBox(surface.boxes.of(surface.workpiece->mesh_M.order())));
}

double Facings::fastest() const {
  double fastest = 0.0;
  for (size_t i = 0; i < surface_count_; ++i) fastest = std::max(fastest, Facings::fastest(surfaces_[i]));
  return fastest;
}

void Facings::end() {
  for (size_t i = 0; i < surface_count_; ++i) surfaces_[i].workpiece.reset();
}

}  // namespace sweep_guard_core
