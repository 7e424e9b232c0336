#include "motion/facings.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr double kLongest = 1.0;  // [s]; a surface that was not heard of for longer rests

// A snapshot without a stamp is from before time went back.
double ageOf(const Workpiece& workpiece, const PoseWithFrames& pose) {
  const bool stamped = workpiece.stamp != Time();
  const double age = toSeconds(stamped ? pose.stamp - workpiece.stamp : pose.received - workpiece.received);
  return age > kLongest ? 0.0 : std::max(0.0, age);
}

}  // namespace

void Facings::begin(const ProximityRequest& request, Workpieces& unplaced) {
  rounding_ = 0.0;
  surface_count_ = 0;
  count_ = 0;
  surfaces_.resize(std::max(surfaces_.size(), request.workpieces.size()));  // facings point into it
  forgetRemoved(request.workpieces);
  for (const auto& workpiece : request.workpieces) {
    const auto X_WM = request.pose.X_WM.find(workpiece->frame);
    if (X_WM == request.pose.X_WM.end()) {
      unplaced.push_back(workpiece);
    } else {
      place(request, workpiece, X_WM->second);
    }
  }
}

void Facings::forgetRemoved(const Workpieces& workpieces) {
  for (auto motion = motions_.begin(); motion != motions_.end();) {
    const auto same = [&](const auto& workpiece) { return workpiece->id == motion->first; };
    const bool there = std::any_of(workpieces.begin(), workpieces.end(), same);
    motion = there ? std::next(motion) : motions_.erase(motion);
  }
}

void Facings::place(const ProximityRequest& request, const std::shared_ptr<const Workpiece>& workpiece,
                    const Eigen::Isometry3d& X_WM) {
  SurfaceMotion& motion = motions_[workpiece->id];
  motion.update(workpiece, X_WM, request.pose.stamp);
  const AllowedPieces allowed(request.tool, request.allowed, workpiece->id);
  if (allowed.all()) return;
  PlacedSurface& surface = surfaces_[surface_count_++];
  surface.workpiece = workpiece;
  surface.motion = &motion;
  surface.intended = request.intentions == nullptr ? IntendedContact()
                                                   : IntendedContact(request.tool, *request.intentions, *workpiece);
  surface.contacts = nullptr;
  if (request.swept != nullptr) {
    for (const SweptObject& object : request.swept->objects) {
      if (object.workpiece == workpiece) surface.contacts = &object.result.in_contact;
    }
  }
  surface.age = motion.deforms() ? ageOf(*workpiece, request.pose) : 0.0;
  surface.boxes.assign(workpiece->mesh_M.blocks());
  rounding_ = std::max(rounding_, workpiece->mesh_M.rounding());
  face(request, surface, allowed, X_WM);
}

void Facings::face(const ProximityRequest& request, const PlacedSurface& surface, const AllowedPieces& allowed,
                   const Eigen::Isometry3d& X_WM) {
  const TriangleMesh& mesh_M = surface.workpiece->mesh_M;
  Eigen::Isometry3d X_MT = X_WM.inverse() * request.pose.X_WT;
  X_MT.translation() -= mesh_M.origin();
  const auto& pieces = request.tool.pieces();
  for (size_t piece = 0; piece < pieces.size(); ++piece) {
    if (allowed.contains(piece)) continue;
    if (count_ == facings_.size()) facings_.emplace_back();
    Facing& facing = facings_[count_++];
    facing.piece = piece;
    facing.surface = &surface;
    facing.guess_T = Eigen::Vector3d::Zero();
    facing.forgetNearest();
    facing.cover.begin(pieces[piece].shape_T, mesh_M, X_MT);
  }
}

double Facings::longestWay() const {
  double way = 0.0;
  for (size_t i = 0; i < surface_count_; ++i) way = std::max(way, surfaces_[i].age * fastest(surfaces_[i]));
  return way;
}

double Facings::fastest(const PlacedSurface& surface) {
  return surface.motion->fastest(CenteredBox(surface.boxes.of(WholeMesh())));
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
