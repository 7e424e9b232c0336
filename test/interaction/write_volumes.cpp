// Writes the volumes of volumes_test, found by CGAL's corefinement of surfaces: write_volumes [POSES] >volumes.txt
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "scenes.h"
#include "volume_cases.h"

namespace sweep_guard_core {
namespace {

namespace Processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

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

// The origin of the piece near a random point of the surface.
Eigen::Isometry3d randomPose(const TriangleMesh& mesh, double scatter, Random& random) {
  const auto& triangle = mesh.triangles()[static_cast<size_t>(random.below(static_cast<int>(mesh.triangles().size())))];
  return random.pose(mesh.vertex(triangle[0]) + scatter * random.uniform(0.0, 1.0) * random.direction());
}

void print(double number, char end) { std::printf("%a%c", number, end); }

// Returns how many poses CGAL could not decide.
int writePoses(const TriangleMesh& mesh, const Surface& surface, const std::string& name, int poses) {
  const double size = mesh.bounds_M().diagonal().norm();
  const VolumePiece piece = pieceNamed(name, size);
  std::printf("piece %s ", name.c_str());
  print(Processing::volume(hullOf(piece.corners_T, Eigen::Isometry3d::Identity())), '\n');
  Random random(/*seed=*/1);
  int undecided = 0;
  for (int i = 0; i < poses; ++i) {
    const Eigen::Isometry3d X_MT = randomPose(mesh, 0.1 * size, random);
    const auto volume = commonVolume(surface, hullOf(piece.corners_T, X_MT));
    if (!volume) ++undecided;
    if (!volume) continue;
    for (int j = 0; j < 12; ++j) print(X_MT(j / 4, j % 4), ' ');
    print(*volume, '\n');
  }
  return undecided;
}

void writeVolumes(const std::string& file, int poses) {
  const auto read = sweep_guard_ros::readMesh(dataPath(file));
  const TriangleMesh mesh(read.vertices, read.triangles);
  const Surface surface = surfaceOf(mesh);
  std::printf("mesh %s %llx\n", file.c_str(), static_cast<unsigned long long>(hashOf(mesh)));
  for (const char* const name : {"cylinder", "finger", "box"}) {
    const int undecided = writePoses(mesh, surface, name, poses);
    if (undecided > poses / 100) throw std::runtime_error(std::to_string(undecided) + " poses are undecided");
  }
}

}  // namespace
}  // namespace sweep_guard_core

int main(int argc, char** argv) {
  try {
    const int poses = argc > 1 ? std::atoi(argv[1]) : 30;
    for (const char* const file : {"mesh/sofa_torus.obj", "mesh/sofa_liver.obj", "mesh/sofa_cylinder.obj"}) {
      sweep_guard_core::writeVolumes(file, poses);
    }
  } catch (const std::exception& error) {
    std::cerr << "write_volumes: " << error.what() << '\n';
    return 1;
  }
}
