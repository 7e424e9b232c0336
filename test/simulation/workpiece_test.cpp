#include "simulation/workpiece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "data_path.h"
#include "refusal.h"
#include "ros/tool/mesh_wire.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {
namespace {

using sweep_guard_core::InvalidInput;

constexpr const char* kTetrahedron = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

Eigen::Map<const Eigen::Matrix3Xf> toMatrix(const std::vector<float>& positions) {
  return {positions.data(), 3, static_cast<Eigen::Index>(positions.size() / 3)};
}

Workpiece::Options resting() {
  Workpiece::Options options;
  options.amplitude = 0.0;
  return options;
}

class WorkpieceFileTest : public testing::Test {
 protected:
  WorkpieceFileTest() : path_(testing::TempDir() + "workpiece test #1 %41.obj") {}
  ~WorkpieceFileTest() override { std::filesystem::remove(path_); }

  Workpiece load(const std::string& text, const Workpiece::Options& options = {}) const {
    std::ofstream(path_) << text;
    return Workpiece::fromFile(path_, options);
  }

  std::string path_;
};

TEST(WorkpieceTest, HullHasTheTrianglesAskedFor) {
  for (const int count : {6, 400, 1600, 100000}) {
    EXPECT_EQ(Workpiece::hull(count, {}).triangles().size(), static_cast<size_t>(count));
  }
}

TEST(WorkpieceTest, HullOfAnyCountIsWithinOnePercent) {
  for (int count = 500; count < 5000; count += 7) {
    EXPECT_NEAR(static_cast<double>(Workpiece::hull(count, {}).triangles().size()), count, 0.01 * count);
  }
}

TEST(WorkpieceTest, HullIsClosedAndWoundOutwards) {
  const Workpiece hull = Workpiece::hull(400, {});
  const std::vector<float> positions = hull.positions(0.0);
  const auto points = toMatrix(positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  float volume = 0.0F;
  for (const auto& [a, b, c] : hull.triangles()) {
    volume += points.col(a).dot(points.col(b).cross(points.col(c))) / 6.0F;
    for (const auto& edge : {std::make_pair(a, b), std::make_pair(b, c), std::make_pair(c, a)}) ++edges[edge];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
  }
  EXPECT_GT(volume, 0.05F);
}

TEST(WorkpieceTest, HullHasTheRequestedSizeAndIsCentered) {
  const std::vector<float> positions = Workpiece::hull(1600, resting()).positions(0.0);
  const auto points = toMatrix(positions);
  const Eigen::Vector3f sizes = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  EXPECT_TRUE(sizes.isApprox(Eigen::Vector3f(0.6F, 0.6F, 0.44F), 0.05F)) << sizes.transpose();
  EXPECT_NEAR(sizes.maxCoeff(), 0.6F, 1e-5F);
  EXPECT_LT((points.rowwise().maxCoeff() + points.rowwise().minCoeff()).norm(), 1e-5F);
}

TEST(WorkpieceTest, EveryVertexMovesInEveryFrameButNeverFarFromItsRest) {
  const Workpiece hull = Workpiece::hull(1600, {});
  const std::vector<float> rest = Workpiece::hull(1600, resting()).positions(0.0);
  std::vector<float> before = hull.positions(0.0);
  for (int frame = 1; frame < 300; ++frame) {
    const std::vector<float> now = hull.positions(frame / 60.0);
    EXPECT_GT((toMatrix(now) - toMatrix(before)).colwise().norm().minCoeff(), 1e-7F) << frame;
    EXPECT_LT((toMatrix(now) - toMatrix(rest)).colwise().norm().maxCoeff(), 0.006F + 1e-6F) << frame;
    before = now;
  }
}

TEST(WorkpieceTest, RefusesNumbersOutOfRange) {
  EXPECT_THROW(Workpiece::hull(5, {}), InvalidInput);
  EXPECT_THROW(Workpiece::hull(1600, {/*size=*/0.0}), InvalidInput);
  EXPECT_THROW(Workpiece::hull(1600, {/*size=*/NAN}), InvalidInput);
  EXPECT_THROW(Workpiece::hull(1600, {/*size=*/0.6, /*amplitude=*/-0.1}), InvalidInput);
  EXPECT_THROW(Workpiece::hull(1600, {/*size=*/0.6, /*amplitude=*/0.01, /*period=*/0.0}), InvalidInput);
}

TEST_F(WorkpieceFileTest, ScalesAndCentersAFile) {
  const Workpiece workpiece = load(kTetrahedron, resting());
  const std::vector<float> positions = workpiece.positions(0.0);
  EXPECT_EQ(workpiece.triangles().size(), 4U);
  EXPECT_TRUE(toMatrix(positions).rowwise().maxCoeff().isApprox(Eigen::Vector3f(0.15F, 0.15F, 0.3F), 1e-5F));
  EXPECT_TRUE(toMatrix(positions).rowwise().minCoeff().isApprox(Eigen::Vector3f(-0.15F, -0.15F, -0.3F), 1e-5F));
}

TEST_F(WorkpieceFileTest, ReadsWhatASymbolicLinkLeadsTo) {
  const std::string link = testing::TempDir() + "workpiece_link.obj";
  std::ofstream(path_) << kTetrahedron;
  std::filesystem::remove(link);
  std::filesystem::create_symlink(path_, link);
  EXPECT_EQ(Workpiece::fromFile(link, {}).triangles().size(), 4U);
  std::filesystem::remove(link);
}

TEST_F(WorkpieceFileTest, SwaysEveryVertexInEveryFrameAndNotAsAWhole) {
  const Workpiece workpiece = load(kTetrahedron);
  std::vector<float> before = workpiece.positions(0.0);
  const std::vector<float> first = before;
  for (int frame = 1; frame < 120; ++frame) {
    const std::vector<float> now = workpiece.positions(frame / 60.0);
    EXPECT_GT((toMatrix(now) - toMatrix(before)).colwise().norm().minCoeff(), 1e-5F) << frame;
    before = now;
  }
  const std::vector<float> later = workpiece.positions(0.5);
  const Eigen::Matrix3Xf moved = toMatrix(later) - toMatrix(first);
  EXPECT_GT((moved.colwise() - moved.col(0)).colwise().norm().maxCoeff(), 1e-3F);
}

TEST_F(WorkpieceFileTest, RefusesAFileWithoutUsableTriangles) {
  for (const std::string text : {"", "v 0 0 0\n", "nonsense", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"}) {
    EXPECT_THROW(load(text), InvalidInput) << text;
  }
  EXPECT_THROW(load("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), InvalidInput);
  EXPECT_THROW(Workpiece::fromFile(path_ + "_missing", {}), InvalidInput);
  EXPECT_THROW(Workpiece::fromFile("/dev", {}), InvalidInput);
}

TEST_F(WorkpieceFileTest, RefusesOtherFormats) {
  std::ofstream(path_ + ".ply") << kTetrahedron;
  EXPECT_THROW(Workpiece::fromFile(path_ + ".ply", {}), InvalidInput);
  std::filesystem::remove(path_ + ".ply");
  EXPECT_THROW(Workpiece::fromFile("/", {}), InvalidInput);
}

TEST_F(WorkpieceFileTest, RefusesAFileLargerThanItsLimit) {
  std::ofstream(path_) << kTetrahedron;
  std::filesystem::resize_file(path_, sweep_guard_ros::kMaxMeshFile + 1);
  EXPECT_THROW(Workpiece::fromFile(path_, {}), InvalidInput);
}

TEST(WorkpieceDataTest, LoadsEveryMesh) {
  const std::filesystem::path meshes = dataPath("mesh");
  if (!std::filesystem::exists(meshes)) GTEST_SKIP() << missing(meshes);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(meshes)) {
    const std::string extension = entry.path().extension();
    if (extension != ".obj" && extension != ".stl" && extension != ".dae") continue;
    const Workpiece workpiece = Workpiece::fromFile(entry.path(), {});
    EXPECT_GT(workpiece.triangles().size(), 200U) << entry.path();
    for (const auto& triangle : workpiece.triangles()) {
      for (const std::uint32_t index : triangle) ASSERT_LT(index, workpiece.vertexCount()) << entry.path();
    }
  }
}

TEST(WorkpieceDataTest, LoadsOrRefusesEveryHostileFile) {
  const std::filesystem::path hostile = dataPath("hostile");
  if (!std::filesystem::exists(hostile)) GTEST_SKIP() << missing(hostile);
  for (const auto& entry : std::filesystem::directory_iterator(hostile)) {
    try {
      const std::vector<float> positions = Workpiece::fromFile(entry.path(), {}).positions(1.0);
      EXPECT_TRUE(toMatrix(positions).allFinite()) << entry.path();
    } catch (const InvalidInput& error) {
      EXPECT_TRUE(has(error.what(), entry.path()));
    }
  }
}

}  // namespace
}  // namespace sweep_guard_simulation
