#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>

#include "common/xyz.h"
#include "geometry/shape_surface.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/geometry/convex_hull.h"
#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {
namespace {

constexpr double kMinFaceArea = 1e-6;  // least area of a face, in parallelograms of its longest edge squared

bool usableLength(double length) { return length >= 0.0 && length <= kMaxCoordinate; }

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

// The normal of a needle has few exact digits.
LinearFunctions faceFunctions(const ConvexHull& hull) {
  LinearFunctions faces;
  if (!hull.solid) return faces;
  for (const auto& [a, b, c] : hull.triangles) {
    const Eigen::Vector3d ab = hull.corners[b] - hull.corners[a];
    const Eigen::Vector3d ac = hull.corners[c] - hull.corners[a];
    const Eigen::Vector3d normal = ab.cross(ac);
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    if (normal.norm() < kMinFaceArea * longest) return {};
    const Eigen::Vector3d outwards = normal.normalized();
    double reach = outwards.dot(hull.corners[a]);
    for (const Eigen::Vector3d& corner : hull.corners) reach = std::max(reach, outwards.dot(corner));
    faces.add(outwards, -reach);
  }
  return faces;
}

}  // namespace

void LinearFunctions::add(const Eigen::Vector3d& gradient, double constant) {
  const size_t padded = (size_ + simd::kFunctions) / simd::kFunctions * simd::kFunctions;
  const auto append = [&](std::vector<double>& values, double value) {
    values.resize(size_);
    values.resize(padded, value);
  };
  append(x_, gradient.x());
  append(y_, gradient.y());
  append(z_, gradient.z());
  append(constant_, constant);
  ++size_;
}

ConvexShape::Points::Points(const std::vector<Eigen::Vector3d>& points) : corners(points) {
  for (const Eigen::Vector3d& corner : corners) reach.add(corner, 0.0);
}

ConvexShape::ConvexShape(Body body_S, const std::vector<Eigen::Vector3d>& vertices_S, std::vector<Triangle> triangles)
    : body_S_(std::move(body_S)),
      mesh_T_(vertices_S, std::move(triangles)),
      moments_T_(triangleMoments(mesh_T_)),
      faces_(faces()),
      bounding_radius_(boundingRadiusOfBody()) {}

ConvexShape ConvexShape::cylinder(double radius, double length, int sides) {
  if (!usableLength(radius)) throw InvalidInput("cylinder radius: must be finite and >= 0 m");
  if (!usableLength(length)) throw InvalidInput("cylinder length: must be finite and >= 0 m");
  if (radius == 0.0 && length == 0.0) throw InvalidInput("cylinder: radius and length are both 0; give it a size");
  if (sides < 3 || sides > 1000) throw InvalidInput("cylinder sides: must be 3 to 1000");
  const TriangleSurface surface = cylinderSurface(radius, length, sides);
  return {Cylinder{radius, length}, surface.vertices, surface.triangles};
}

ConvexShape ConvexShape::sphere(double radius) {
  if (!usableLength(radius) || radius == 0.0) throw InvalidInput("sphere radius: must be finite and > 0 m");
  const TriangleSurface surface = sphereSurface(radius);
  ConvexShape sphere(Points({Eigen::Vector3d::Zero()}), surface.vertices, surface.triangles);
  return sphere.padded(radius);
}

ConvexShape ConvexShape::box(const Eigen::Vector3d& half_extents) {
  for (const double half : xyz(half_extents)) {
    if (!usableLength(half)) throw InvalidInput("box size: must be finite and >= 0 m");
  }
  if (half_extents.isZero(0.0)) throw InvalidInput("box size: all three are 0; give it a size");
  const TriangleSurface surface = boxSurface(half_extents);
  return {half_extents, surface.vertices, surface.triangles};
}

ConvexShape ConvexShape::hull(const std::vector<Eigen::Vector3d>& points_T) {
  const ConvexHull hull = convexHull(points_T);
  Points body(hull.corners);
  body.faces = faceFunctions(hull);
  return ConvexShape(std::move(body), hull.corners, hull.triangles).padded(hull.hull_tolerance);
}

ConvexShape ConvexShape::placed(const Eigen::Isometry3d& X_NT) const {
  ConvexShape placed = *this;
  placed.R_TS_ = X_NT.linear() * R_TS_;
  placed.p_TS_ = X_NT * p_TS_;
  std::vector<Eigen::Vector3d> vertices;
  for (size_t i = 0; i < mesh_T_.vertexCount(); ++i) vertices.push_back(X_NT * mesh_T_.vertex(i));
  placed.mesh_T_ = TriangleMesh(vertices, mesh_T_.triangles());
  placed.moments_T_ = triangleMoments(placed.mesh_T_);
  placed.faces_ = placed.faces();
  placed.bounding_radius_ = placed.boundingRadiusOfBody();
  return placed;
}

ConvexShape ConvexShape::padded(double distance) const {
  assert(distance >= 0.0);
  ConvexShape padded = *this;
  padded.padding_ += distance;
  return padded;
}

ConvexShape::Faces ConvexShape::faces() const {
  if (const Cylinder* const cylinder = asCylinder()) {
    return {R_TS_, p_TS_, Eigen::Vector2d::Constant(cylinder->radius), 0.0, -cylinder->length, /*round=*/true};
  }
  if (asBox() != nullptr) return facesOfBox(R_TS_);
  return facesOfBox(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments_T_.covariance).eigenvectors());
}

ConvexShape::Faces ConvexShape::facesOfBox(const Eigen::Matrix3d& axes_T) const {
  Eigen::Vector3d half;
  Eigen::Vector3d center;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = axes_T.col(i);
    const double upper = support(axis) - padding_;
    const double lower = padding_ - support(-axis);
    half[i] = std::max(0.0, 0.5 * (upper - lower));
    center[i] = 0.5 * (upper + lower);
  }
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return half[i] < half[j]; });
  Faces faces;
  for (int i = 0; i < 3; ++i) faces.R_TF.col(i) = axes_T.col(order[static_cast<size_t>(i)]);
  faces.p_T = axes_T * center;
  faces.half_sides = {half[order[0]], half[order[1]]};
  faces.front = half[order[2]];
  faces.rear = -half[order[2]];
  return faces;
}

}  // namespace sweep_guard_core
