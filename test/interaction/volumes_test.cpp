// Volumes against those that write_volumes found by CGAL's corefinement of surfaces. SWEEP_GUARD_VOLUMES names another file.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

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

constexpr int kFewestPoses = 30;  // of each pair in the committed file

// A piece and a mesh.
struct Pair {
  std::string name;
  int poses = 0;
  int partly_inside = 0;
};

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
  const std::vector<Pair>& pairs() const { return pairs_; }
  double worst() const { return worst_; }

 private:
  void readMesh(std::istream& text) {
    std::string key;
    std::string file;
    std::uint64_t hash = 0;
    text >> key >> file >> std::hex >> hash;
    file_ = file;
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
    pairs_.push_back({name + " in " + file_});
  }

  void readPose(std::istream& text) {
    const Eigen::Isometry3d X_MT = poseFrom(text);
    const double expected = hexadecimal(text);
    const double bound = std::max(expected, 1e-3 * whole_);
    const double volume = finder_->find(*mesh_, X_MT).volume;
    Pair& pair = pairs_.back();
    EXPECT_NEAR(volume, expected, 1e-6 * bound) << pair.name << ", pose " << pair.poses;
    worst_ = std::max(worst_, std::abs(volume - expected) / bound);
    ++pair.poses;
    if (expected > 0.0 && expected < 0.999 * whole_) ++pair.partly_inside;
  }

  std::string file_;
  std::optional<TriangleMesh> mesh_;
  std::optional<InterpenetrationFinder> finder_;
  double whole_ = 0.0;
  std::vector<Pair> pairs_;
  double worst_ = 0.0;
};

TEST(VolumesTest, AreThoseOfCorefinement) {
  if (!std::filesystem::exists(dataPath(kFingerMesh))) GTEST_SKIP() << missing(dataPath(kFingerMesh));
  const char* const other = std::getenv("SWEEP_GUARD_VOLUMES");
  std::ifstream file(other != nullptr ? other : std::string(SWEEP_GUARD_SOURCE_DIR) + kVolumesFile);
  Volumes volumes;
  volumes.compare(file);
  EXPECT_EQ(volumes.pairs().size(), 9U);
  for (const auto& [name, poses, partly_inside] : volumes.pairs()) {
    std::printf("%s: %d poses, %d partly inside\n", name.c_str(), poses, partly_inside);
    EXPECT_GE(poses, other != nullptr ? 1 : kFewestPoses) << name;
    if (poses < kFewestPoses) continue;
    EXPECT_GT(3 * partly_inside, poses) << name;
  }
  std::printf("worst error %.1e\n", volumes.worst());
}

}  // namespace
}  // namespace sweep_guard_core
