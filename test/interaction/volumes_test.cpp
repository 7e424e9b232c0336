// Volumes against those that write_volumes found by CGAL's corefinement of surfaces. SWEEP_GUARD_VOLUMES names another file.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "sweep_guard/interaction/interpenetration.h"
#include "volume_cases.h"

namespace sweep_guard_core {
namespace {

double hexadecimal(std::istream& text) {
  std::string word;
  text >> word;
  return std::strtod(word.c_str(), nullptr);
}

Eigen::Isometry3d poseFrom(std::istream& text) {
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) X_MT(row, column) = hexadecimal(text);
  }
  return X_MT;
}

// Reads the file line by line and compares as it goes.
class Volumes {
 public:
  void compare(std::istream& file) {
    for (std::string line; std::getline(file, line);) {
      std::istringstream text(line);
      if (text.peek() == 'm') {
        readMesh(text);
      } else if (text.peek() == 'p') {
        readPiece(text);
      } else {
        readPose(text);
      }
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  int poses() const { return poses_; }
  int partlyInside() const { return partly_; }
  double worst() const { return worst_; }

 private:
  void readMesh(std::istream& text) {
    std::string key;
    std::string file;
    std::uint64_t hash = 0;
    text >> key >> file >> std::hex >> hash;
    const auto read = sweep_guard_ros::readMesh(dataPath(file));
    mesh_.emplace(read.vertices, read.triangles);
    ASSERT_TRUE(mesh_->closed());
    ASSERT_EQ(hashOf(*mesh_), hash) << file << " is another mesh by now: run write_volumes";
  }

  void readPiece(std::istream& text) {
    std::string key;
    std::string name;
    text >> key >> name;
    whole_ = hexadecimal(text);
    finder_.emplace(pieceNamed(name, mesh_->bounds_M().diagonal().norm()).shape_T);
    EXPECT_NEAR(finder_->pieceVolume(), whole_, 1e-6 * whole_) << name;
  }

  void readPose(std::istream& text) {
    const Eigen::Isometry3d X_MT = poseFrom(text);
    const double expected = hexadecimal(text);
    const double bound = std::max(expected, 1e-3 * whole_);
    const double volume = finder_->find(*mesh_, X_MT).volume;
    EXPECT_NEAR(volume, expected, 1e-6 * bound) << "pose " << poses_;
    worst_ = std::max(worst_, std::abs(volume - expected) / bound);
    ++poses_;
    if (expected > 0.0 && expected < 0.999 * whole_) ++partly_;
  }

  std::optional<TriangleMesh> mesh_;
  std::optional<InterpenetrationFinder> finder_;
  double whole_ = 0.0;
  int poses_ = 0;
  int partly_ = 0;
  double worst_ = 0.0;
};

TEST(VolumesTest, AreThoseOfCorefinement) {
  if (!std::filesystem::exists(dataPath(kFingerMesh)))
    GTEST_SKIP() << "set SWEEP_GUARD_DATA: " << dataPath(kFingerMesh) << " is missing";
  const char* const other = std::getenv("SWEEP_GUARD_VOLUMES");
  std::ifstream file(other != nullptr ? other : std::string(SWEEP_GUARD_SOURCE_DIR) + kVolumesFile);
  Volumes volumes;
  volumes.compare(file);
  EXPECT_GE(volumes.poses(), 9 * 29);
  EXPECT_GT(volumes.partlyInside(), volumes.poses() / 3);
  std::printf("%d poses, %d partly inside; worst error %.1e\n", volumes.poses(), volumes.partlyInside(),
              volumes.worst());
}

}  // namespace
}  // namespace sweep_guard_core
