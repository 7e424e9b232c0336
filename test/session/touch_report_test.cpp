#include "session/touch_report.h"

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "grid_mesh.h"
#include "refusal.h"

namespace sweep_guard_session {
namespace {

using sweep_guard::DeformableMesh;
using sweep_guard::MeshVertices;
using sweep_guard::Touches;

// A roof over a square, of 2 * 40 * 40 triangles.
DeformableMesh roof() {
  DeformableMesh mesh = gridMesh(40, 0.1, [](double x, double /*y*/) { return 0.03 - 0.6 * std::abs(x); });
  mesh.id = "operator's roof";
  mesh.revision = 3;
  return mesh;
}

Touches touchesOf(const DeformableMesh& mesh) {
  Touches touches;
  sweep_guard::ObjectTouches& object = touches.objects.emplace_back();
  object.mesh_id = mesh.id;
  object.revision = mesh.revision;
  for (std::uint32_t triangle = 0; triangle < mesh.mesh.triangles.size(); ++triangle) {
    const geometry_msgs::Point& p = mesh.mesh.vertices[mesh.mesh.triangles[triangle].vertex_indices[0]];
    const double distance = std::hypot(p.x - 0.025, p.y);
    if (distance > 0.015) continue;
    object.triangles.push_back(triangle);
    object.sweeps.push_back(1 + static_cast<std::uint32_t>(std::lround(1e5 * (0.015 - distance))));
    object.depths.push_back(static_cast<float>(0.4 * (0.015 - distance)));
  }
  return touches;
}

TouchLog touchLogOf(const DeformableMesh& mesh, const Touches& touches) {
  TouchLog log;
  log.take(boost::make_shared<const DeformableMesh>(mesh));
  log.take(boost::make_shared<const Touches>(touches));
  return log;
}

TEST(TouchReportTest, WritesALineForEachTouchedTriangle) {
  Touches touches;
  sweep_guard::ObjectTouches& object = touches.objects.emplace_back();
  object.mesh_id = "a, b";
  object.revision = 2;
  object.triangles = {4, 7};
  object.sweeps = {1, 12};
  object.depths = {0.0025F, std::nanf("")};
  EXPECT_EQ(touchesCsv(touches),
            "mesh,revision,triangle,sweeps,depth_mm\n"
            "\"a, b\",2,4,1,2.5\n"
            "\"a, b\",2,7,12,nan\n");
}

TEST(TouchReportTest, TheSurfaceIsThatOfTheNewestVerticesOfTheRevision) {
  const DeformableMesh mesh = roof();
  const Touches touches = touchesOf(mesh);
  TouchLog log = touchLogOf(mesh, touches);
  const auto surface = log.surfaceOf(touches.objects[0]);
  ASSERT_EQ(surface.vertices.size(), mesh.mesh.vertices.size());
  EXPECT_EQ(surface.triangles.size(), mesh.mesh.triangles.size());
  EXPECT_EQ(surface.vertices[0].x(), -0.05);
  MeshVertices vertices;
  vertices.id = mesh.id;
  vertices.positions.assign(3 * mesh.mesh.vertices.size(), 1.0F);
  log.take(boost::make_shared<const MeshVertices>(vertices));
  EXPECT_EQ(log.surfaceOf(touches.objects[0]).vertices[0].x(), -0.05);
  vertices.revision = mesh.revision;
  log.take(boost::make_shared<const MeshVertices>(vertices));
  EXPECT_EQ(log.surfaceOf(touches.objects[0]).vertices[0].x(), 1.0);
}

TEST(TouchReportTest, AMeshOfAnotherRevisionIsNotTheSurface) {
  DeformableMesh mesh = roof();
  const Touches touches = touchesOf(mesh);
  mesh.revision = 4;
  EXPECT_TRUE(touchLogOf(mesh, touches).surfaceOf(touches.objects[0]).triangles.empty());
}

std::string lineOf(const std::string& csv, std::size_t number) {
  std::istringstream lines(csv);
  std::string line;
  for (std::size_t i = 0; i <= number; ++i) std::getline(lines, line);
  return line;
}

TEST(TouchReportTest, WritesTheCornersOfAllTrianglesOfATouchedSurface) {
  const DeformableMesh mesh = roof();
  const std::string csv = surfacesCsv(touchLogOf(mesh, touchesOf(mesh)));
  EXPECT_EQ(lineOf(csv, 0), "mesh,triangle,x1,y1,z1,x2,y2,z2,x3,y3,z3");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 40 * 40);
  EXPECT_EQ(lineOf(csv, 1).substr(0, 30), "operator's roof,0,-0.05,-0.05,");
}

TEST(TouchReportTest, OfALargeSurfaceOnlyWhatWasTouchedIsWritten) {
  DeformableMesh mesh = gridMesh(130, 0.1, [](double /*x*/, double /*y*/) { return 0.0; });
  mesh.id = "plate";
  Touches touches;
  sweep_guard::ObjectTouches& object = touches.objects.emplace_back();
  object.mesh_id = mesh.id;
  object.triangles = {7, 33000};
  const std::string csv = surfacesCsv(touchLogOf(mesh, touches));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_TRUE(has(csv, "\nplate,7,"));
  EXPECT_TRUE(has(csv, "\nplate,33000,"));
}

// A tetrahedron whose triangles face inwards.
TEST(TouchReportTest, TheCornersOfAClosedSurfaceAreCounterclockwiseFromOutside) {
  DeformableMesh mesh;
  mesh.id = "tip";
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& [x, y, z] : corners) {
    geometry_msgs::Point& p = mesh.mesh.vertices.emplace_back();
    p.x = x, p.y = y, p.z = z;
  }
  const std::uint32_t triangles[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  for (const auto& [a, b, c] : triangles) mesh.mesh.triangles.emplace_back().vertex_indices = {a, b, c};
  Touches touches;
  touches.objects.emplace_back().mesh_id = mesh.id;
  touches.objects[0].triangles = {0};
  EXPECT_EQ(lineOf(surfacesCsv(touchLogOf(mesh, touches)), 1), "tip,0,0,0,0,0,1,0,1,0,0");
  for (auto& triangle : mesh.mesh.triangles) std::swap(triangle.vertex_indices[1], triangle.vertex_indices[2]);
  EXPECT_EQ(lineOf(surfacesCsv(touchLogOf(mesh, touches)), 1), "tip,0,0,0,0,0,1,0,1,0,0");
}

TEST(TouchReportTest, WithoutItsShapeNothingOfASurfaceIsWritten) {
  TouchLog shapeless;
  shapeless.take(boost::make_shared<const Touches>(touchesOf(roof())));
  EXPECT_EQ(surfacesCsv(shapeless), surfacesCsv(TouchLog()));
}

}  // namespace
}  // namespace sweep_guard_session
