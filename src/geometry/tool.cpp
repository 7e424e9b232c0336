#include "sweep_guard/geometry/tool.h"

#include <algorithm>
#include <cmath>

#include "sweep_guard/common/error.h"

namespace sweep_guard {
namespace {

constexpr double kTwoPi = 6.283185307179586;

TriangleMesh cylinderMesh(double radius, double length, int sides) {
  const auto n = static_cast<std::uint32_t>(sides);
  const std::uint32_t front_center = 2 * n;
  const std::uint32_t rear_center = 2 * n + 1;
  std::vector<Eigen::Vector3d> vertices;
  for (const double z : {0.0, -length}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = kTwoPi * i / n;
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  vertices.emplace_back(0.0, 0.0, 0.0);
  vertices.emplace_back(0.0, 0.0, -length);

  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    triangles.push_back({front_center, i, next});
    triangles.push_back({rear_center, n + next, n + i});
    triangles.push_back({i, n + i, next});
    triangles.push_back({next, n + i, n + next});
  }
  return TriangleMesh(vertices, std::move(triangles));
}

Moments triangleMoments(const TriangleMesh& mesh) {
  const double count = 3.0 * static_cast<double>(mesh.triangles().size());
  Moments moments{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const Triangle& triangle : mesh.triangles()) {
    for (const std::uint32_t vertex : triangle) moments.mean += mesh.vertex(vertex) / count;
  }
  for (const Triangle& triangle : mesh.triangles()) {
    for (const std::uint32_t vertex : triangle) {
      const Eigen::Vector3d p = mesh.vertex(vertex) - moments.mean;
      moments.covariance += p * p.transpose() / count;
    }
  }
  return moments;
}

Eigen::Vector3d discExtreme(double z, double radius, const Eigen::Vector3d& direction) {
  const Eigen::Vector2d radial = direction.head<2>();
  const double length = radial.norm();
  if (length == 0.0) return {0.0, 0.0, z};
  return {radius * radial.x() / length, radius * radial.y() / length, z};
}

}  // namespace

Tool Tool::cylinder(double radius, double length, int sides) {
  if (!(radius >= 0.0 && radius <= kMaxCoordinate)) throw InvalidInput("tool radius: must be finite and >= 0 m");
  if (!(length >= 0.0 && length <= kMaxCoordinate)) throw InvalidInput("tool length: must be finite and >= 0 m");
  if (radius == 0.0 && length == 0.0) throw InvalidInput("tool: radius and length are both 0; give it a size");
  if (sides < 3 || sides > 1000) throw InvalidInput("tool sides: must be 3 to 1000");
  return Tool(radius, length, cylinderMesh(radius, length, sides));
}

Tool::Tool(double radius, double length, TriangleMesh mesh_T)
    : radius_(radius), length_(length), mesh_T_(std::move(mesh_T)), moments_T_(triangleMoments(mesh_T_)) {}

double Tool::support(const Eigen::Vector3d& direction_T) const {
  return radius_ * direction_T.head<2>().norm() + length_ * std::max(0.0, -direction_T.z());
}

double Tool::reach(const Eigen::Vector3d& axis_T) const { return radius_ + length_ * axis_T.head<2>().norm(); }

double Tool::extent() const { return std::hypot(radius_, length_); }

Eigen::Vector3d Tool::frontExtreme(const Eigen::Vector3d& direction_T) const {
  return discExtreme(0.0, radius_, direction_T);
}

Eigen::Vector3d Tool::rearExtreme(const Eigen::Vector3d& direction_T) const {
  return discExtreme(-length_, radius_, direction_T);
}

double support(const Tool& tool, const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction_M) {
  return direction_M.dot(X_MT.translation()) + tool.support(X_MT.linear().transpose() * direction_M);
}

double support(const Tool& tool, const Motion& motion, const Eigen::Vector3d& direction_M) {
  return std::max(support(tool, motion.X_MT_start, direction_M), support(tool, motion.X_MT_end, direction_M));
}

}  // namespace sweep_guard
