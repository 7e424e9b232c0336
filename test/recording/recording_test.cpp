#include "recording/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <locale>

#include "data_path.h"
#include "refusal.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_recording {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::StampedPose;

class MotionFileTest : public testing::Test {
 protected:
  MotionFileTest()
      : path_(testing::TempDir() + "motion_file_test_" +
              testing::UnitTest::GetInstance()->current_test_info()->name()) {}
  ~MotionFileTest() override { std::filesystem::remove(path_); }

  std::vector<StampedPose> read(const std::string& text) const {
    std::ofstream(path_) << text;
    return readMotionFile(path_);
  }

  std::string refusal(const std::string& text) const {
    return ::refusal([&] { read(text); });
  }

  std::string path_;
};

std::int64_t nanoseconds(const StampedPose& pose) { return pose.stamp.time_since_epoch().count(); }

TEST_F(MotionFileTest, ReadsPosesAndSkipsCommentsAndEmptyLines) {
  const auto poses = read("# stamp tx ty tz qx qy qz qw\n\n0 1 2 3 0 0 0 1\r\n\t0.5 -1e-1 0 0  0 0 1 0");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].X_WT.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(nanoseconds(poses[1]), 500000000);
  EXPECT_EQ(poses[1].X_WT.translation(), Eigen::Vector3d(-0.1, 0, 0));
  EXPECT_TRUE(poses[1].X_WT.linear().isApprox(Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix()));
}

// A double has no nanoseconds left at 1.3e9 s.
TEST_F(MotionFileTest, KeepsTheNanosecondsOfAnAbsoluteStamp) {
  EXPECT_EQ(nanoseconds(read("1311868164.363181123 0 0 0 0 0 0 1").front()), 1311868164363181123);
}

TEST_F(MotionFileTest, NormalizesQuaternions) {
  const auto poses = read("0 0 0 0 0 0 3 4\n");
  const Eigen::Matrix3d& rotation = poses.front().X_WT.linear();
  EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-14));
  EXPECT_NEAR(rotation(0, 0), 0.28, 1e-14);
}

TEST_F(MotionFileTest, KeepsPosesOfEqualStamps) { EXPECT_EQ(read("1 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n").size(), 2U); }

TEST_F(MotionFileTest, NamesFileAndLineOfWhatItRefuses) {
  EXPECT_EQ(refusal("# c\n1 0 0 0 0 0 0 1\n0.9 0 0 0 0 0 0 1\n").find(path_ + ":3: stamp is earlier"), 0U);
}

TEST_F(MotionFileTest, RefusesWhatIsNotEightFiniteNumbers) {
  for (const std::string line :
       {"0 0 0 0 0 0 1", "0 0 0 0 0 0 0 1 0", "0 nan 0 0 0 0 0 1", "0 0 inf 0 0 0 0 1", "0 1,5 0 0 0 0 0 1",
        "0 1x 0 0 0 0 0 1", "0 1e999 0 0 0 0 0 1", "1e12 0 0 0 0 0 0 1"}) {
    EXPECT_EQ(refusal(line).find(path_ + ":1: "), 0U) << line;
  }
}

TEST_F(MotionFileTest, ShowsNothingOfABinaryFileThatATerminalWouldObey) {
  const std::string message = refusal("\033[2J\x80" + std::string(100000, 'x') + " 0\n");
  EXPECT_TRUE(has(message, ":1: '?[2J?xxx"));
  EXPECT_LT(message.size(), path_.size() + 150U);
}

TEST_F(MotionFileTest, RefusesAZeroQuaternion) { EXPECT_TRUE(has(refusal("0 0 0 0 0 0 0 0"), "quaternion")); }

TEST_F(MotionFileTest, RefusesAFileWithoutPoses) {
  EXPECT_TRUE(has(refusal("# nothing\n"), "no pose"));
  EXPECT_THROW(readMotionFile(path_ + "_missing"), InvalidInput);
  EXPECT_THROW(readMotionFile(testing::TempDir()), InvalidInput);
  EXPECT_THROW(readMotionFile("/dev/zero"), InvalidInput);
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST_F(MotionFileTest, ReadsDecimalPointsInALocaleOfCommas) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const double x = read("0 1.5 0 0 0 0 0 1").front().X_WT.translation().x();
  std::locale::global(before);
  EXPECT_EQ(x, 1.5);
}

TEST(MotionFileDataTest, ReadsEveryRecording) {
  const std::filesystem::path data = dataPath("motion");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << missing(data);
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data)) {
    if (entry.path().extension() != ".txt") continue;
    ++count;
    EXPECT_GT(readMotionFile(entry.path()).size(), 900U) << entry.path();
  }
  EXPECT_GE(count, 5);
}

}  // namespace
}  // namespace sweep_guard_recording
