#include "interaction/face_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_core {
namespace {

constexpr double kUpright = 1e-9;       // vertical part of the unit normal of a face that has no outline
constexpr double kSameOutline = 1e-11;  // of the size of the polytope
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Matrix3d axesAlong(const Eigen::Vector3d& up) {
  Eigen::Matrix3d R_CT;
  R_CT.row(0) = up.unitOrthogonal();
  R_CT.row(2) = up;
  R_CT.row(1) = up.cross(R_CT.row(0).transpose());
  return R_CT;
}

std::vector<Eigen::Vector2d> outlineOf(const Polygon& face, double tolerance) {
  std::vector<Eigen::Vector2d> outline;
  for (const Eigen::Vector3d& corner : face) {
    const Eigen::Vector2d p = corner.head<2>();
    const bool again = !outline.empty() && ((p - outline.back()).norm() <= tolerance);
    if (!again) outline.push_back(p);
  }
  while (outline.size() > 1 && (outline.front() - outline.back()).norm() <= tolerance) outline.pop_back();
  return outline;
}

}  // namespace

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
  const std::vector<Eigen::Vector2d> outline = outlineOf(face, tolerance);
  if (outline.size() < 3) return;
  const auto same = [&](const Column& column) { return column.hasOutline(outline, tolerance); };
  auto column = std::find_if(columns_.begin(), columns_.end(), same);
  if (column == columns_.end()) column = columns_.insert(column, Column(outline));
  Floor floor{-normal.x() / normal.z(),
              -normal.y() / normal.z(),
              normal.dot(face[0]) / normal.z(),
              normal.z() < 0.0 ? 1.0 : -1.0,
              kInfinity,
              -kInfinity};
  for (const Eigen::Vector3d& corner : face) {
    floor.lowest = std::min(floor.lowest, corner.z());
    floor.highest = std::max(floor.highest, corner.z());
  }
  column->floors.push_back(floor);
}

FaceColumns::Column::Column(const std::vector<Eigen::Vector2d>& outline)
    : center(Eigen::Vector2d::Zero()), squared_inradius(kInfinity) {
  for (const Eigen::Vector2d& p : outline) {
    bounds.extend(p);
    center += p / static_cast<double>(outline.size());
  }
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& from = outline[i];
    const Eigen::Vector2d along = (outline[(i + 1) % outline.size()] - from).normalized();
    Eigen::Vector2d out(along.y(), -along.x());
    if (out.dot(center - from) > 0.0) out = -out;
    walls.x.push_back(out.x());
    walls.y.push_back(out.y());
    walls.d.push_back(out.dot(from));
    squared_inradius = std::min(squared_inradius, std::pow(out.dot(from - center), 2));
  }
}

bool FaceColumns::Column::hasOutline(const std::vector<Eigen::Vector2d>& outline, double tolerance) const {
  if (outline.size() != walls.d.size()) return false;
  for (size_t i = 0; i < outline.size(); ++i) {
    const auto lies_in = [&](const Eigen::Vector2d& p) {
      return std::abs(walls.x[i] * p.x() + walls.y[i] * p.y() - walls.d[i]) <= tolerance;
    };
    if (std::count_if(outline.begin(), outline.end(), lies_in) != 2) return false;
  }
  return true;
}

void FaceColumns::add(const Polygon& corners, SurfaceSums& sums) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : corners) box.extend(corner);
  const Eigen::AlignedBox2d shadow(box.min().head<2>(), box.max().head<2>());
  for (const Column& column : columns_) {
    const auto below = [&](const Floor& floor) { return box.max().z() <= floor.lowest; };
    if (!column.bounds.intersects(shadow) || std::all_of(column.floors.begin(), column.floors.end(), below)) continue;
    const Polygon* const inside = partInside(column, corners);
    if (inside == nullptr) continue;
    for (const Floor& floor : column.floors) {
      if (below(floor)) continue;
      const bool whole = box.min().z() >= floor.highest;
      addPrisms(floor, whole ? *inside : partAbove(floor, *inside), sums);
    }
  }
}

// Returns null if nothing is inside of all walls.
const Polygon* FaceColumns::partInside(const Column& column, const Polygon& corners) {
  const auto near = [&](const Eigen::Vector3d& p) {
    return (p.head<2>() - column.center).squaredNorm() <= column.squared_inradius;
  };
  if (std::all_of(corners.begin(), corners.end(), near)) return &corners;
  findExtremes(column.walls, corners);
  kept_ = corners;
  const double* const least = least_.data();
  const double* const most = most_.data();
  const size_t count = most_.size();
  for (size_t i = 0; i < count; ++i) {
    if (!(most[i] > 0.0)) continue;
    if (least[i] > 0.0) return nullptr;
    out_.resize(kept_.size());
    std::transform(kept_.begin(), kept_.end(), out_.begin(),
                   [&](const Eigen::Vector3d& p) { return column.walls.beyond(i, p); });
    if (!cut()) return nullptr;
  }
  inside_.swap(kept_);
  return &inside_;
}

void FaceColumns::findExtremes(const Walls& walls, const Polygon& corners) {
  const size_t count = walls.d.size();
  least_.assign(count, kInfinity);
  most_.assign(count, -kInfinity);
  for (const Eigen::Vector3d& corner : corners) {
    const double* const x = walls.x.data();
    const double* const y = walls.y.data();
    const double* const d = walls.d.data();
    double* const least = least_.data();
    double* const most = most_.data();
    for (size_t i = 0; i < count; ++i) {
      const double out = x[i] * corner.x() + y[i] * corner.y() - d[i];
      least[i] = std::min(least[i], out);
      most[i] = std::max(most[i], out);
    }
  }
}

const Polygon& FaceColumns::partAbove(const Floor& floor, const Polygon& inside) {
  kept_ = inside;
  out_.resize(kept_.size());
  std::transform(kept_.begin(), kept_.end(), out_.begin(), [&](const Eigen::Vector3d& p) { return -floor.below(p); });
  if (!cut()) kept_.clear();
  return kept_;
}

void FaceColumns::addPrisms(const Floor& floor, const Polygon& above, SurfaceSums& sums) {
  for (size_t i = 2; i < above.size(); ++i) addPrism(floor, above[0], above[i - 1], above[i], sums);
}

// Between a triangle and the floor. Both are linear, so products of two positions or heights have exact integrals.
void FaceColumns::addPrism(const Floor& floor, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c, SurfaceSums& sums) {
  const Eigen::Vector3d area = 0.5 * floor.sign * (b - a).cross(c - a);
  sums.area += area;
  sums.area_moment += (a + b + c) / 3.0 * area.transpose();
  double heights = 0.0;
  Eigen::Vector3d middles = Eigen::Vector3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d* const corner : {&a, &b, &c}) {
    const double height = floor.below(*corner);
    const Eigen::Vector3d middle(corner->x(), corner->y(), corner->z() - 0.5 * height);
    heights += height;
    middles += middle;
    products += height * middle;
  }
  sums.volume += area.z() * heights / 3.0;
  sums.volume_moment += area.z() / 12.0 * (heights * middles + products);
}

// Keeps what is not out_, boundary included (Sutherland and Hodgman 1974). Returns whether more than that is kept.
bool FaceColumns::cut() {
  const auto beyond = [](double out) { return out > 0.0; };
  if (std::none_of(out_.begin(), out_.end(), beyond)) return true;
  if (std::none_of(out_.begin(), out_.end(), [](double out) { return out < 0.0; })) return false;
  whole_.swap(kept_);
  kept_.clear();
  for (size_t i = 0; i < whole_.size(); ++i) {
    const size_t before = i == 0 ? whole_.size() - 1 : i - 1;
    if (beyond(out_[i]) != beyond(out_[before])) {
      kept_.push_back(whole_[before] + out_[before] / (out_[before] - out_[i]) * (whole_[i] - whole_[before]));
    }
    if (!beyond(out_[i])) kept_.push_back(whole_[i]);
  }
  return kept_.size() >= 3;
}

}  // namespace sweep_guard_core
