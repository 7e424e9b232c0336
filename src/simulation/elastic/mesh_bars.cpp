#include "simulation/elastic/mesh_bars.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "common/number_text.h"
#include "detection/inside.h"
#include "geometry/qhull.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using Eigen::MatrixX3d;
using Eigen::Vector3d;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::TriangleMesh;

namespace {

constexpr double kLeastDistance = 0.4;  // of an inner point from a vertex, in sides of the lattice's cubes
constexpr double kBarsInSpace = 6.0;    // stiffness times squared length of bars in all directions, per E V
constexpr double kBarsInSheet = 3.0;    // in all directions of a sheet, per E t A

void requirePositive(const char* name, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InvalidInput(std::string(name) + " of the elastic workpiece is " + sweep_guard_core::shortText(value) +
                     ", must be above 0");
}

void check(const ElasticMaterial& material) {
  requirePositive("Young's modulus", material.youngs_modulus);
  requirePositive("density", material.density);
  requirePositive("skin", material.skin);
  requirePositive("bedding", material.bedding);
  if (material.inner_points < 0 || material.inner_points > 100000) {
    throw InvalidInput("inner_points of the elastic workpiece must be in [0, 100000]");
  }
}

double enclosedVolume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles()) sum += mesh.offset(a).dot(mesh.offset(b).cross(mesh.offset(c))) / 6.0;
  return std::abs(sum);
}

bool nearVertex(const TriangleMesh& mesh, const Vector3d& p, double distance) {
  for (size_t i = 0; i < mesh.vertexCount(); ++i) {
    if ((mesh.vertex(i) - p).squaredNorm() < distance * distance) return true;
  }
  return false;
}

std::vector<Vector3d> pointsInside(const TriangleMesh& mesh, int count) {
  if (count == 0) return {};
  const double side = std::cbrt(2.0 * enclosedVolume(mesh) / count);
  const Eigen::AlignedBox3d box = mesh.bounds_M();
  const Eigen::Array3i cubes = (box.sizes().array() / side).cast<int>() + 1;
  std::vector<Vector3d> points;
  for (int half = 0; half < 2; ++half) {
    for (int z = 0; z < cubes.z(); ++z) {
      for (int y = 0; y < cubes.y(); ++y) {
        for (int x = 0; x < cubes.x(); ++x) {
          const Vector3d p = box.min() + side * (Vector3d(x, y, z) + Vector3d::Constant(0.25 + 0.5 * half));
          if (inside(mesh, p) && !nearVertex(mesh, p, kLeastDistance * side)) points.push_back(p);
        }
      }
    }
  }
  return points;
}

MatrixX3d nodesOf(const TriangleMesh& mesh, const std::vector<Vector3d>& inner) {
  const auto vertices = static_cast<Eigen::Index>(mesh.vertexCount());
  MatrixX3d nodes(vertices + static_cast<Eigen::Index>(inner.size()), 3);
  for (Eigen::Index i = 0; i < vertices; ++i) nodes.row(i) = mesh.vertex(static_cast<size_t>(i));
  for (size_t i = 0; i < inner.size(); ++i) nodes.row(vertices + static_cast<Eigen::Index>(i)) = inner[i];
  return nodes;
}

/// Bars that are added up.
class BarBuilder {
 public:
  BarBuilder(MatrixX3d nodes, const ElasticMaterial& material) : structure_(std::move(nodes)), material_(material) {}

  void addTriangle(const sweep_guard_core::Triangle& corners) {
    const Vector3d a = at(corners[0]);
    const double area = 0.5 * (at(corners[1]) - a).cross(at(corners[2]) - a).norm();
    add(corners, kBarsInSheet * material_.youngs_modulus * material_.skin * area, material_.skin * area);
  }

  void addTetrahedron(const std::array<std::uint32_t, 4>& corners) {
    const Vector3d a = at(corners[0]);
    const double volume = std::abs((at(corners[1]) - a).dot((at(corners[2]) - a).cross(at(corners[3]) - a))) / 6.0;
    add(corners, kBarsInSpace * material_.youngs_modulus * volume, volume);
  }

  void addBedding(const Eigen::VectorXd& areas) {
    structure_.foundation.head(areas.size()) += material_.bedding * areas;
  }

  BarStructure finish() {
    for (const auto& [nodes, stiffness] : stiffness_) structure_.bars.push_back({nodes, stiffness});
    for (Eigen::Index i = 0; i < structure_.masses.size(); ++i) {
      structure_.fixed[static_cast<size_t>(i)] = structure_.masses[i] == 0.0;
    }
    return std::move(structure_);
  }

 private:
  Vector3d at(std::uint32_t node) const { return structure_.rest.row(node); }

  // Bars of equal cross-section between all corners.
  template <typename Corners>
  void add(const Corners& corners, double stretch, double volume) {
    double lengths = 0.0;
    for (size_t i = 0; i < corners.size(); ++i) {
      structure_.masses[corners[i]] += material_.density * volume / static_cast<double>(corners.size());
      for (size_t j = 0; j < i; ++j) lengths += (at(corners[i]) - at(corners[j])).norm();
    }
    for (size_t i = 0; i < corners.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        const double length = (at(corners[i]) - at(corners[j])).norm();
        const double stiffness = stretch / (lengths * length);
        if (!(stiffness > 0.0 && std::isfinite(stiffness))) continue;
        stiffness_[{std::min(corners[i], corners[j]), std::max(corners[i], corners[j])}] += stiffness;
      }
    }
  }

  BarStructure structure_;
  const ElasticMaterial& material_;
  std::map<std::array<std::uint32_t, 2>, double> stiffness_;
};

void fill(BarBuilder& builder, const TriangleMesh& mesh, const MatrixX3d& nodes) {
  const Eigen::AlignedBox3d box = mesh.bounds_M();
  const Eigen::Matrix3Xd scaled = (nodes.transpose().colwise() - box.center()) / box.sizes().norm();
  const auto tetrahedra = sweep_guard_core::delaunayTetrahedra(scaled);
  if (tetrahedra.empty())
    throw sweep_guard_core::InvalidInput("no tetrahedra fill the elastic workpiece: take another mesh");
  for (const auto& corners : tetrahedra) {
    Vector3d middle = Vector3d::Zero();
    for (const std::uint32_t corner : corners) middle += nodes.row(corner).transpose() / 4.0;
    if (inside(mesh, middle)) builder.addTetrahedron(corners);
  }
}

}  // namespace

Eigen::VectorXd vertexAreas(const TriangleMesh& mesh) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.vertexCount()));
  for (const auto& triangle : mesh.triangles()) {
    const Vector3d a = mesh.vertex(triangle[0]);
    const double area = 0.5 * (mesh.vertex(triangle[1]) - a).cross(mesh.vertex(triangle[2]) - a).norm();
    for (const std::uint32_t vertex : triangle) areas[vertex] += area / 3.0;
  }
  return areas;
}

BarStructure barsOf(const TriangleMesh& mesh, const ElasticMaterial& material) {
  check(material);
  const bool encloses = mesh.closed() && !mesh.enclosure().closedTriangles().empty();
  const MatrixX3d nodes = nodesOf(mesh, encloses ? pointsInside(mesh, material.inner_points) : std::vector<Vector3d>());
  BarBuilder builder(nodes, material);
  for (const auto& triangle : mesh.triangles()) builder.addTriangle(triangle);
  if (encloses) {
    fill(builder, mesh, nodes);
  } else {
    builder.addBedding(vertexAreas(mesh));
  }
  return builder.finish();
}

}  // namespace sweep_guard_simulation
