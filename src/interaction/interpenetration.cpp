#include "sweep_guard/interaction/interpenetration.h"

#include <algorithm>
#include <cassert>

#include "detection/culler.h"
#include "detection/float_planes.h"
#include "interaction/face_columns.h"
#include "interaction/piece_polytope.h"

namespace sweep_guard_core {
namespace {

constexpr double kRounding = 1e-12;  // of volume and extent of a piece: less is the rounding of prisms that cancel

using Corners = std::array<Eigen::Vector3d, 3>;

Clips slantingSides(const PiecePolytope& piece, const FaceColumns& columns) {
  Clips sides_C;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Vector3d diagonal = Eigen::Vector3d(x, y, 0.0).normalized();
      sides_C.emplace_back(diagonal, piece.support(columns.R_CT().transpose() * diagonal));
    }
  }
  return sides_C;
}

}  // namespace

double Interpenetration::depth(double least_area) const {
  assert(least_area > 0.0);
  return reach * std::min(1.0, area_T.norm() / least_area);
}

// The frame C is that of the columns.
class InterpenetrationFinder::Implementation {
 public:
  explicit Implementation(const ConvexShape& shape_T)
      : piece_(shape_T), columns_(piece_, piece_.axis()), sides_C_(slantingSides(piece_, columns_)) {}

  Interpenetration find(const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT);
  double pieceVolume() const { return piece_.volume(); }

 private:
  void place(const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT);
  template <typename Function>
  void forEachTriangleUpTo(double top, const Function& function);
  SweptVolume volumeUpTo(double top) const;
  void sumOfEnclosed();
  void sumOfOpen();
  void addBehind(const Eigen::Vector3d& normal);
  void report(Interpenetration& found) const;

  PiecePolytope piece_;
  FaceColumns columns_;
  Clips sides_C_;  // with those of the box, eight around z
  Culler culler_;
  // Of the running call:
  const TriangleMesh* mesh_M_ = nullptr;
  Eigen::Isometry3d X_MC_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_CO_ = Eigen::Isometry3d::Identity();  // O: at the mesh's origin(), with the axes of M
  PrismAccumulator prisms_;
  SurfaceSums sums_;
};

Interpenetration InterpenetrationFinder::Implementation::find(const TriangleMesh& mesh_M,
                                                              const Eigen::Isometry3d& X_MT) {
  Interpenetration found;
  found.enclosed = mesh_M.closed() && !mesh_M.enclosure().closedTriangles().empty();
  if (piece_.volume() == 0.0) return found;
  place(mesh_M, X_MT);
  prisms_.begin();
  if (found.enclosed) {
    sumOfEnclosed();
  } else {
    sumOfOpen();
  }
  report(found);
  return found;
}

void InterpenetrationFinder::Implementation::place(const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT) {
  mesh_M_ = &mesh_M;
  X_MC_.linear() = X_MT.linear() * columns_.R_CT().transpose();
  X_MC_.translation() = X_MT * piece_.center_T();
  X_CO_.linear() = X_MC_.linear().transpose();
  X_CO_.translation() = X_CO_.linear() * (mesh_M.origin() - X_MC_.translation());
}

// Calls a function with the corners in C, counter-clockwise seen from outside, of each triangle that may reach into the
// piece swept up to a height.
template <typename Function>
void InterpenetrationFinder::Implementation::forEachTriangleUpTo(double top, const Function& function) {
  const auto& triangles = mesh_M_->triangles();
  const auto& all_remaining = culler_.cull(*mesh_M_, floatPlanes(*mesh_M_, volumeUpTo(top)));
  for (const RemainingTriangle& remaining : all_remaining) __builtin_prefetch(&triangles[remaining.triangle]);
  for (const RemainingTriangle& remaining : all_remaining) {
    const Enclosure::Role role = mesh_M_->enclosure().role(remaining.triangle);
    if (role == Enclosure::Role::kLeftOut) continue;
    auto [a, b, c] = triangles[remaining.triangle];
    if (role == Enclosure::Role::kReversed) std::swap(b, c);
    function(Corners{X_CO_ * mesh_M_->offset(a), X_CO_ * mesh_M_->offset(b), X_CO_ * mesh_M_->offset(c)});
  }
}

SweptVolume InterpenetrationFinder::Implementation::volumeUpTo(double top) const {
  Eigen::AlignedBox3d box = columns_.bounds();
  box.max().z() = std::max(box.max().z(), top);
  SweptVolume volume;
  volume.box.X_MB = X_MC_ * Eigen::Translation3d(box.center());
  volume.box.half_extents = 0.5 * box.sizes();
  for (const HalfSpace& side_C : sides_C_) volume.clips_B.push_back(side_C.grown(-side_C.normal().dot(box.center())));
  return volume;
}

void InterpenetrationFinder::Implementation::sumOfEnclosed() {
  const double top = X_CO_.translation().z() + mesh_M_->radius();
  forEachTriangleUpTo(top, [&](const Corners& corners) { columns_.add(corners, prisms_); });
  sums_ = prisms_.sums();
}

// Their area does not depend on the direction of the columns.
void InterpenetrationFinder::Implementation::sumOfOpen() {
  const double top = columns_.bounds().max().z();
  forEachTriangleUpTo(top, [&](const Corners& corners) { columns_.add(corners, prisms_); });
  sums_ = prisms_.sums();
  sums_.volume = 0.0;
  sums_.volume_moment.setZero();
  if (!sums_.area.isZero(0.0)) addBehind(sums_.area.normalized());
}

void InterpenetrationFinder::Implementation::addBehind(const Eigen::Vector3d& normal) {
  const Eigen::Matrix3d& R_CT = columns_.R_CT();
  FaceColumns columns_N(piece_, R_CT.transpose() * normal);
  const Eigen::Matrix3d R_NC = columns_N.R_CT() * R_CT.transpose();
  prisms_.begin();
  forEachTriangleUpTo(columns_.bounds().max().z(), [&](const Corners& corners) {
    Polygon inside(corners.begin(), corners.end());
    for (const HalfSpace& face : piece_.halfSpaces())
      inside = clip(inside, HalfSpace(R_CT * face.normal(), face.offset()));
    for (Eigen::Vector3d& corner : inside) corner = R_NC * corner;
    for (size_t i = 2; i < inside.size(); ++i) columns_N.add({inside[0], inside[i - 1], inside[i]}, prisms_);
  });
  const SurfaceSums sums_N = prisms_.sums();
  sums_.volume = sums_N.volume;
  sums_.volume_moment = R_NC.transpose() * sums_N.volume_moment;
}

void InterpenetrationFinder::Implementation::report(Interpenetration& found) const {
  const Eigen::Matrix3d R_TC = columns_.R_CT().transpose();
  const Eigen::AlignedBox3d& bounds = columns_.bounds();
  if (sums_.volume > kRounding * piece_.volume()) {
    found.volume = sums_.volume;
    const Eigen::Vector3d centroid = sums_.volume_moment / sums_.volume;
    found.centroid_T = piece_.center_T() + R_TC * centroid.cwiseMax(bounds.min()).cwiseMin(bounds.max());
  }
  const double area = sums_.area.norm();
  if (!(area > kRounding * bounds.sizes().squaredNorm())) return;
  found.area_T = R_TC * sums_.area;
  const Eigen::Vector3d normal = sums_.area / area;
  const double behind = piece_.support(-R_TC * normal);
  const double size = behind + piece_.support(R_TC * normal);
  const double height = normal.dot(sums_.area_moment * normal) / area;
  found.reach = std::clamp(height + behind, 0.0, size);
}

InterpenetrationFinder::InterpenetrationFinder(const ConvexShape& shape_T)
    : implementation_(std::make_unique<Implementation>(shape_T)) {}
InterpenetrationFinder::~InterpenetrationFinder() = default;
InterpenetrationFinder::InterpenetrationFinder(InterpenetrationFinder&& other) noexcept = default;
InterpenetrationFinder& InterpenetrationFinder::operator=(InterpenetrationFinder&& other) noexcept = default;

Interpenetration InterpenetrationFinder::find(const TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT) {
  return implementation_->find(mesh_M, X_MT);
}

double InterpenetrationFinder::pieceVolume() const { return implementation_->pieceVolume(); }

}  // namespace sweep_guard_core
