// Volumes against CGAL's corefinement of surfaces. SWEEP_GUARD_CASES=1e4 makes the number of poses as large as that.
#include <gtest/gtest.h>

#ifndef SWEEP_GUARD_HAS_CGAL

TEST(VolumeTest, IsThatOfCorefinement) { GTEST_SKIP() << "CGAL was not found"; }

#else

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "data_path.h"
#include "scenes.h"
#include "sweep_guard/interaction/interpenetration.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_core {
namespace {

namespace fs = std::filesystem;
namespace Processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

constexpr int kSides = 32;

Point pointOf(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Surface surfaceOf(const TriangleMesh& mesh) {
  std::vector<Point> points;
  std::vector<std::array<size_t, 3> > triangles;
  for (const auto& [a, b, c] : mesh.triangles()) {
    for (const std::uint32_t vertex : {a, b, c}) points.push_back(pointOf(mesh.vertex(vertex)));
    triangles.push_back({points.size() - 3, points.size() - 2, points.size() - 1});
  }
  Processing::merge_duplicate_points_in_polygon_soup(points, triangles);
  Surface surface;
  Processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
  if (!CGAL::is_closed(surface)) throw std::runtime_error("the mesh is not closed");
  Processing::orient_to_bound_a_volume(surface);
  return surface;
}

Surface hullOf(const std::vector<Eigen::Vector3d>& corners, const Eigen::Isometry3d& X) {
  std::vector<Point> points;
  for (const Eigen::Vector3d& corner : corners) points.push_back(pointOf(X * corner));
  Surface hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return hull;
}

// Returns empty if CGAL cannot represent the common part as a manifold.
std::optional<double> commonVolume(Surface a, Surface b) {
  Surface common;
  const auto parameters = CGAL::parameters::throw_on_self_intersection(true);
  if (!Processing::corefine_and_compute_intersection(a, b, common, parameters)) return {};
  return common.is_empty() ? 0.0 : Kernel::FT(Processing::volume(common));
}

/// A convex piece and, independently, the corners of what stands for it.
struct Piece {
  ConvexShape shape_T;
  std::vector<Eigen::Vector3d> corners_T;
};

Piece cylinderPiece(double radius, double length) {
  const double angle = 2.0 * M_PI / kSides;
  const double same_area = radius * std::sqrt(M_PI / (0.5 * kSides * std::sin(angle)));
  std::vector<Eigen::Vector3d> corners_T;
  for (int i = 0; i < kSides; ++i) {
    for (const double z : {0.0, -length}) {
      corners_T.emplace_back(same_area * std::cos(i * angle), same_area * std::sin(i * angle), z);
    }
  }
  return {ConvexShape::cylinder(radius, length, kSides), corners_T};
}

Piece boxPiece(const Eigen::Vector3d& half) {
  std::vector<Eigen::Vector3d> corners_T;
  for (int i = 0; i < 8; ++i) {
    corners_T.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                           (i & 4) != 0 ? half.z() : -half.z());
  }
  return {ConvexShape::box(half), corners_T};
}

// Of a unit of length of 1 / scale m.
Piece fingerPiece(double scale) {
  const auto finger = sweep_guard_ros::readMesh(dataPath("urdf/franka_description/meshes/visual/finger.dae"));
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : finger.vertices) points.push_back(scale * p);
  const ConvexShape shape_T = ConvexShape::hull(points);
  std::vector<Eigen::Vector3d> corners_T;
  for (size_t i = 0; i < shape_T.mesh_T().vertexCount(); ++i) corners_T.push_back(shape_T.mesh_T().vertex(i));
  return {shape_T, corners_T};
}

class VolumeTest : public testing::TestWithParam<std::tuple<const char*, const char*> > {};

Piece pieceNamed(const std::string& name, double size) {
  if (name == "cylinder") return cylinderPiece(0.04 * size, 0.5 * size);
  if (name == "box") return boxPiece(size * Eigen::Vector3d(0.05, 0.1, 0.15));
  return fingerPiece(4.0 * size);
}

// The origin of the piece near a random point of the surface.
Eigen::Isometry3d randomPose(const TriangleMesh& mesh, double scatter, Random& random) {
  const auto& triangle = mesh.triangles()[static_cast<size_t>(random.below(static_cast<int>(mesh.triangles().size())))];
  return random.pose(mesh.vertex(triangle[0]) + scatter * random.uniform(0.0, 1.0) * random.direction());
}

TEST_P(VolumeTest, IsThatOfCorefinement) {
  const auto& [file, name] = GetParam();
  if (!fs::exists(dataPath(file))) GTEST_SKIP() << dataPath(file) << " is missing; set SWEEP_GUARD_DATA";
  const auto read = sweep_guard_ros::readMesh(dataPath(file));
  const TriangleMesh mesh(read.vertices, read.triangles);
  ASSERT_NE(mesh.winding(), 0);
  const Surface surface = surfaceOf(mesh);
  const double size = mesh.bounds_M().diagonal().norm();
  const Piece piece = pieceNamed(name, size);
  InterpenetrationFinder finder(piece.shape_T);
  const double whole = Processing::volume(hullOf(piece.corners_T, Eigen::Isometry3d::Identity()));
  EXPECT_NEAR(finder.pieceVolume(), whole, 1e-6 * whole);

  const char* const cases = std::getenv("SWEEP_GUARD_CASES");
  const int poses = cases == nullptr ? 30 : static_cast<int>(std::stod(cases) / 9.0) + 1;
  Random random(/*seed=*/1);
  int partly = 0;
  int undecided = 0;
  double worst = 0.0;
  for (int i = 0; i < poses; ++i) {
    const Eigen::Isometry3d X_MT = randomPose(mesh, 0.1 * size, random);
    const auto expected = commonVolume(surface, hullOf(piece.corners_T, X_MT));
    if (!expected) ++undecided;
    if (!expected) continue;
    const double volume = finder.find(mesh, X_MT).volume;
    const double bound = std::max(*expected, 1e-3 * whole);
    EXPECT_NEAR(volume, *expected, 1e-6 * bound) << "pose " << i;
    worst = std::max(worst, std::abs(volume - *expected) / bound);
    if (*expected > 0.0 && *expected < 0.999 * whole) ++partly;
  }
  EXPECT_GT(partly, poses / 3);
  EXPECT_LE(undecided, poses / 100);
  RecordProperty("undecided", undecided);
  std::printf("%s in %s: %d poses, %d partly inside, %d undecided; worst error %.1e\n", name, file, poses, partly,
              undecided, worst);
}

INSTANTIATE_TEST_SUITE_P(MeshesAndPieces, VolumeTest,
                         testing::Combine(testing::Values("mesh/sofa_torus.obj", "mesh/sofa_liver.obj",
                                                          "mesh/sofa_cylinder.obj"),
                                          testing::Values("cylinder", "finger", "box")));

}  // namespace
}  // namespace sweep_guard_core

#endif
