#include "interaction/face_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/floating_point.h"

namespace sweep_guard_core {
namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kUpright = 1e-9;       // vertical part of the unit normal of a face that has no outline
constexpr double kSameOutline = 1e-11;  // of the size of the polytope

Eigen::Matrix3d axesAlong(const Eigen::Vector3d& up) {
  Eigen::Matrix3d R_CT;
  R_CT.row(0) = up.unitOrthogonal();
  R_CT.row(2) = up;
  R_CT.row(1) = up.cross(R_CT.row(0).transpose());
  return R_CT;
}

double distanceFromSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double share = along.dot(p - a) / std::max(along.squaredNorm(), std::numeric_limits<double>::min());
  return (p - a - std::clamp(share, 0.0, 1.0) * along).norm();
}

// Leaves out corners between their neighbors.
std::vector<Eigen::Vector2d> outlineOf(const Polygon& face, double tolerance) {
  std::vector<Eigen::Vector2d> outline;
  for (const Eigen::Vector3d& corner : face) outline.emplace_back(corner.head<2>());
  for (size_t i = 0; i < outline.size();) {
    const size_t count = outline.size();
    const Eigen::Vector2d& before = outline[(i + count - 1) % count];
    const Eigen::Vector2d& after = outline[(i + 1) % count];
    if (distanceFromSegment(outline[i], before, after) <= tolerance) {
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  return outline;
}

}  // namespace

void PrismAccumulator::begin() {
  batch_.count = 0;
  sums_ = simd::PrismSums();
}

void PrismAccumulator::addBatch() {
  simd::kernels().addPrisms(batch_, sums_);
  batch_.count = 0;
}

SurfaceSums PrismAccumulator::sums() {
  addBatch();
  SurfaceSums sums;
  sums.volume = sums_.volume;
  sums.volume_moment = Eigen::Map<const Eigen::Vector3d>(sums_.volume_moment.data());
  sums.area = Eigen::Map<const Eigen::Vector3d>(sums_.area.data());
  sums.area_moment = Eigen::Map<const RowMajor>(sums_.area_moment[0].data());
  return sums;
}

FaceColumns::FaceColumns(const PiecePolytope& piece, const Eigen::Vector3d& up) : R_CT_(axesAlong(up)) {
  for (const Polygon& face : piece.faces()) {
    for (const Eigen::Vector3d& corner : face) bounds_.extend(R_CT_ * corner);
  }
  for (const Polygon& face : piece.faces()) addFace(face);
}

void FaceColumns::addFace(Polygon face) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (Eigen::Vector3d& corner : face) corner = R_CT_ * corner;
  for (size_t i = 2; i < face.size(); ++i) normal += (face[i - 1] - face[0]).cross(face[i] - face[0]);
  normal.normalize();
  if (!(std::abs(normal.z()) > kUpright)) return;
  const double tolerance = kSameOutline * bounds_.diagonal().norm();
  std::vector<Eigen::Vector2d> outline = outlineOf(face, tolerance);
  if (normal.z() < 0.0) std::reverse(outline.begin(), outline.end());
  if (outline.size() < 3) return;
  const auto same = [&](const Column& column) { return column.outline.hasCorners(outline, tolerance); };
  auto column = std::find_if(columns_.begin(), columns_.end(), same);
  if (column == columns_.end()) column = columns_.insert(column, {Outline(outline), {}});
  Floor floor{-normal.x() / normal.z(),
              -normal.y() / normal.z(),
              normal.dot(face[0]) / normal.z(),
              /*looks_down=*/normal.z() < 0.0,
              kInfinity,
              -kInfinity};
  for (const Eigen::Vector3d& corner : face) {
    floor.lowest = std::min(floor.lowest, corner.z());
    floor.highest = std::max(floor.highest, corner.z());
  }
  column->floors.push_back(floor);
}

void FaceColumns::add(const std::array<Eigen::Vector3d, 3>& triangle, PrismAccumulator& prisms) {
  const Eigen::Vector3d lower = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
  const Eigen::Vector3d upper = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
  const Eigen::AlignedBox2d shadow(lower.head<2>(), upper.head<2>());
  const auto below = [&](const Floor& floor) { return upper.z() <= floor.lowest; };
  for (const Column& column : columns_) {
    if (!column.outline.bounds().intersects(shadow)) continue;
    if (std::all_of(column.floors.begin(), column.floors.end(), below)) continue;
    if (!column.outline.cut(triangle, inside_)) continue;
    for (const Floor& floor : column.floors) {
      if (below(floor)) continue;
      addFan(floor, lower.z() >= floor.highest ? inside_.corners() : partAbove(floor), prisms);
    }
  }
}

const Polygon& FaceColumns::partAbove(const Floor& floor) {
  above_.begin(inside_.corners());
  above_.cut([&](const Eigen::Vector3d& p) { return -floor.height(p); });
  return above_.corners();
}

// Prisms above a face that looks up are turned, so that they count negative.
void FaceColumns::addFan(const Floor& floor, const Polygon& above, PrismAccumulator& prisms) {
  for (size_t i = 2; i < above.size(); ++i) {
    const Eigen::Vector3d& a = above[0];
    const Eigen::Vector3d& b = floor.looks_down ? above[i - 1] : above[i];
    const Eigen::Vector3d& c = floor.looks_down ? above[i] : above[i - 1];
    prisms.add({&a, &b, &c}, {floor.height(a), floor.height(b), floor.height(c)});
  }
}

}  // namespace sweep_guard_core
