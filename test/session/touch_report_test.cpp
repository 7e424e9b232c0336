#include "session/touch_report.h"

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

#include <cmath>
#include <filesystem>

#include "evaluation/gnuplot.h"
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

TEST(TouchReportTest, TheScalesEndAtTheLargestValues) {
  const DeformableMesh mesh = roof();
  const std::string script = touchesPlot(touchLogOf(mesh, touchesOf(mesh)), "a bag", "picture.png");
  EXPECT_TRUE(has(script, "'1' 0, '1501' 1")) << script.substr(0, 2000);
  EXPECT_TRUE(has(script, "'0' 0, '6.0' 1"));
}

// gnuplot refuses a script that is wrong.
TEST(TouchReportTest, IsDrawnWithAndWithoutTouchesAndShape) {
  const std::string path = testing::TempDir() + "touch_report_test.png";
  const DeformableMesh mesh = roof();
  TouchLog shapeless;
  shapeless.take(boost::make_shared<const Touches>(touchesOf(mesh)));
  const std::pair<TouchLog, std::uintmax_t> cases[] = {
      {touchLogOf(mesh, touchesOf(mesh)), 50000}, {shapeless, 3000}, {TouchLog(), 3000}};
  for (const auto& [log, least_size] : cases) {
    std::filesystem::remove(path);
    sweep_guard_evaluation::runGnuplot(touchesPlot(log, "operator's.bag", path));
    EXPECT_GT(std::filesystem::file_size(path), least_size);
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace sweep_guard_session
