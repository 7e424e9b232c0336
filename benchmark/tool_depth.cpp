// Prints what cutting real tools into convex pieces saves and costs, by the depth of the cuts.
//   tool_depth [DATA]    the folder with mesh/ and urdf/; default: SWEEP_GUARD_DATA
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/rotation_between.h"
#include "common/run_program.h"
#include "microseconds.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/convex_hull.h"
#include "sweep_guard/geometry/decomposition.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_core {
namespace {

constexpr int kMotions = 100;
constexpr int kRepetitions = 3;
constexpr int kMaxTries = 3000;
constexpr double kDegree = 0.017453292519943295;

using Surface = sweep_guard_ros::MeshSurface;

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

Surface readSurface(const std::string& path, double unit) {
  Surface surface = sweep_guard_ros::readMesh(path);
  for (Eigen::Vector3d& p : surface.vertices) p *= unit;
  return surface;
}

Eigen::AlignedBox3d boxOf(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.vertices) box.extend(p);
  return box;
}

TriangleMesh centered(Surface surface) {
  const Eigen::Vector3d center = boxOf(surface).center();
  for (Eigen::Vector3d& p : surface.vertices) p -= center;
  return TriangleMesh(surface.vertices, surface.triangles);
}

void add(Surface& all, const Surface& more, const Eigen::Isometry3d& pose) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const Eigen::Vector3d& p : more.vertices) all.vertices.push_back(pose * p);
  for (const auto& [a, b, c] : more.triangles) all.triangles.push_back({first + a, first + b, first + c});
}

// The Franka hand, its fingers 8 cm apart.
Surface gripper(const std::string& meshes) {
  Surface all = readSurface(meshes + "/collision/hand.stl", 1.0);
  const Surface finger = readSurface(meshes + "/visual/finger.dae", 1.0);
  for (const double turn : {0.0, 180.0 * kDegree}) {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
    add(all, finger, Eigen::Translation3d(0.0, 0.0, 0.0584) * pose * Eigen::Translation3d(0.0, 0.04, 0.0));
  }
  return all;
}

std::vector<NamedMesh> tools(const std::string& data) {
  const std::string mesh = data + "/mesh/";
  const std::string franka = data + "/urdf/franka_description/meshes";
  const std::string instruments = data + "/urdf/dvrk_model/meshes/instruments/";
  std::vector<NamedMesh> all;
  all.push_back({"Franka gripper, open", centered(gripper(franka))});
  all.push_back({"Franka finger", centered(readSurface(franka + "/visual/finger.dae", 1.0))});
  all.push_back({"Costar drill", centered(readSurface(data + "/urdf/costar_simulation/urdf/drill/drill.stl", 1.0))});
  all.push_back({"pliers", centered(readSurface(mesh + "sofa_pliers_binary.stl", 0.01))});
  all.push_back({"dental instrument", centered(readSurface(mesh + "sofa_dental_instrument_light.obj", 0.01))});
  all.push_back({"stylus", centered(readSurface(mesh + "sofa_stylus.obj", 0.1))});
  all.push_back(
      {"dVRK shaft, housing", centered(readSurface(instruments + "housing/Classic/housing_Classic.dae", 1.0))});
  all.push_back({"dVRK tip", centered(readSurface(instruments + "tip/006/Classic/tip_006.dae", 1.0))});
  return all;
}

NamedMesh workpieceOf(const std::string& name, const std::string& path, double size) {
  const double unit = boxOf(readSurface(path, 1.0)).sizes().maxCoeff();
  return {name, centered(readSurface(path, size / unit))};
}

Tool toolOf(const TriangleMesh& mesh_T, const DecompositionOptions& options) {
  std::vector<ConvexPiece> pieces;
  for (const ConvexShape& shape_T : convexPieces(mesh_T, options)) pieces.push_back({"", shape_T});
  return Tool(std::move(pieces));
}

struct SurfacePoint {
  Eigen::Vector3d p;
  Eigen::Vector3d normal;
};

SurfacePoint randomPoint(const TriangleMesh& mesh, Random& random) {
  for (;;) {
    const auto i = static_cast<size_t>(random.below(static_cast<int>(mesh.triangles().size())));
    const auto& [a, b, c] = mesh.triangles()[i];
    const Eigen::Vector3d normal = (mesh.vertex(b) - mesh.vertex(a)).cross(mesh.vertex(c) - mesh.vertex(a));
    if (normal.norm() > 0.0) return {(mesh.vertex(a) + mesh.vertex(b) + mesh.vertex(c)) / 3.0, normal.normalized()};
  }
}

// Puts a point of the tool's surface face to face with a point of the workpiece, 0.2 to 5 mm away.
Motion restCloseTo(const TriangleMesh& tool_T, const TriangleMesh& mesh_M, Random& random) {
  const SurfacePoint on_tool = randomPoint(tool_T, random);
  const SurfacePoint on_mesh = randomPoint(mesh_M, random);
  Motion motion;
  motion.X_MT_start.linear() =
      Eigen::AngleAxisd(random.uniform(0.0, 360.0 * kDegree), on_mesh.normal).toRotationMatrix() *
      rotationBetween(on_tool.normal, -on_mesh.normal).toRotationMatrix();
  motion.X_MT_start.translation() =
      on_mesh.p + random.logUniform(0.0002, 0.005) * on_mesh.normal - motion.X_MT_start.linear() * on_tool.p;
  motion.X_MT_end = motion.X_MT_start;
  return motion;
}

bool isFree(Detector& detector, const Tool& tool, const Motion& motion, const TriangleMesh& mesh_M) {
  return std::all_of(tool.pieces().begin(), tool.pieces().end(), [&](const ConvexPiece& piece) {
    const SweptVolume swept_M = sweptVolume(piece.shape_T, motion, VolumeKind::kObbPlanes);
    return detector.detect(mesh_M, swept_M).triangles.empty();
  });
}

// Motions of 0.2 to 5 mm and up to 2 degrees, from poses where the finest pieces of the tool are free.
std::vector<Motion> freeMotions(Detector& detector, const TriangleMesh& tool_T, const TriangleMesh& mesh_M) {
  const Tool finest = toolOf(tool_T, {/*max_depth=*/9, /*step=*/0.0002, /*least_saving=*/0.0});
  Random random(/*seed=*/1);
  std::vector<Motion> motions;
  for (int i = 0; i < kMaxTries && motions.size() < kMotions; ++i) {
    Motion motion = restCloseTo(tool_T, mesh_M, random);
    if (!isFree(detector, finest, motion, mesh_M)) continue;
    motion.X_MT_end.linear() = random.turn(random.uniform(0.0, 2.0 * kDegree)) * motion.X_MT_start.linear();
    motion.X_MT_end.translation() += random.logUniform(0.0002, 0.005) * random.direction();
    motions.push_back(motion);
  }
  return motions;
}

struct Cost {
  std::vector<double> times;  // [us]
  size_t candidates = 0;
  size_t volumes = 0;
  int met = 0;
};

Cost measure(Detector& detector, const Tool& tool, const TriangleMesh& mesh_M, const std::vector<Motion>& motions) {
  Cost cost;
  for (const Motion& motion : motions) {
    std::vector<double> times;
    times.reserve(kRepetitions);
    SweepResult result;
    for (int i = 0; i < kRepetitions; ++i) {
      times.push_back(microseconds([&] {
        result = checkPath(detector, {tool, {motion.X_MT_start, motion.X_MT_end}, mesh_M}).all;
      }));
    }
    cost.times.push_back(quantile(times, 0.5));
    cost.candidates += result.triangles.size();
    cost.volumes += result.volumes_M.size();
    if (!result.triangles.empty()) ++cost.met;
  }
  return cost;
}

double volumeOfHulls(const TriangleMesh& mesh_T, const DecompositionOptions& options) {
  double sum = 0.0;
  for (const std::vector<std::uint32_t>& set : decompose(mesh_T, options)) {
    std::vector<Eigen::Vector3d> corners;
    for (const std::uint32_t i : set) {
      for (const std::uint32_t vertex : mesh_T.triangles()[i]) corners.push_back(mesh_T.vertex(vertex));
    }
    sum += volume(convexHull(corners));
  }
  return sum;
}

void printRow(const std::string& name, const NamedMesh& tool_T, const DecompositionOptions& options, Detector& detector,
              const std::vector<NamedMesh>& workpieces, const std::vector<std::vector<Motion>>& motions) {
  std::optional<Tool> tool;
  const double load = 1e-6 * microseconds([&] { tool = toolOf(tool_T.mesh, options); });
  std::printf("%-8s %6zu %9.3f %6.2f", name.c_str(), tool->pieces().size(), 1e6 * volumeOfHulls(tool_T.mesh, options),
              load);
  for (size_t i = 0; i < workpieces.size(); ++i) {
    const Cost cost = measure(detector, *tool, workpieces[i].mesh, motions[i]);
    const auto perMotion = [&](auto sum) { return static_cast<double>(sum) / static_cast<double>(motions[i].size()); };
    std::printf("   %5.1f %8.1f %6.1f %6.1f %6.1f", 100.0 * perMotion(cost.met), perMotion(cost.candidates),
                perMotion(cost.volumes), quantile(cost.times, 0.5), quantile(cost.times, 0.9));
  }
  std::printf("\n");
}

void study(const NamedMesh& tool_T, const std::vector<NamedMesh>& workpieces, Detector& detector) {
  std::vector<std::vector<Motion>> motions;
  motions.reserve(workpieces.size());
  for (const NamedMesh& workpiece : workpieces) motions.push_back(freeMotions(detector, tool_T.mesh, workpiece.mesh));
  std::printf("\n%s, %zu triangles, %.0f mm; %zu and %zu motions\n", tool_T.name.c_str(),
              tool_T.mesh.triangles().size(), 2e3 * tool_T.mesh.radius(), motions[0].size(), motions[1].size());
  if (motions[0].empty() || motions[1].empty()) return;
  DecompositionOptions options;
  options.least_saving = 0.0;
  for (int depth = 0; depth <= 6; ++depth) {
    options.max_depth = depth;
    printRow(std::to_string(depth), tool_T, options, detector, workpieces, motions);
  }
  for (const double least_saving : {0.001, 0.003, 0.01}) {
    options.least_saving = least_saving;
    printRow("6, " + std::to_string(least_saving).substr(0, 5), tool_T, options, detector, workpieces, motions);
  }
}

std::string dataFolder(const std::vector<std::string>& arguments) {
  const char* const variable = std::getenv("SWEEP_GUARD_DATA");
  if (arguments.size() == 1) return arguments[0];
  if (arguments.empty() && variable != nullptr) return variable;
  throw InvalidInput("usage: tool_depth DATA, the folder with mesh/ and urdf/, or set SWEEP_GUARD_DATA");
}

int run(const std::vector<std::string>& arguments) {
  const std::string data = dataFolder(arguments);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  std::vector<NamedMesh> workpieces;
  workpieces.push_back(workpieceOf("torus", data + "/mesh/sofa_torus.obj", 0.2));
  workpieces.push_back(workpieceOf("raptor", data + "/mesh/sofa_raptor_8kp.obj", 0.3));
  const std::unique_ptr<Detector> detector = makeDetector("select");
  std::printf(
      "Tools cut into convex pieces, close to a torus of 1600 triangles and 200 mm (left) and a raptor of 17632\n");
  std::printf(
      "triangles and 300 mm (right). Motions of 0.2 to 5 mm and up to 2 degrees, from poses without contact.\n");
  std::printf("A depth alone: all cuts that gain anything; with a second number: least_saving.\n\n");
  std::printf("%-8s %6s %9s %6s   %5s %8s %6s %6s %6s   (twice)\n", "depth", "pieces", "hulls", "load", "met", "met",
              "volumes", "time", "p90");
  std::printf("%-8s %6s %9s %6s   %5s %8s %6s %6s %6s\n", "", "", "[cm^3]", "[s]", "[%]", "triang.", "", "[us]",
              "[us]");
  for (const NamedMesh& tool_T : tools(data)) study(tool_T, workpieces, *detector);
  return 0;
}

}  // namespace
}  // namespace sweep_guard_core

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram(
      "tool_depth",
      [&] {
        return sweep_guard_core::run({argv + 1, argv + argc});
      },
      /*failed=*/1);
}
