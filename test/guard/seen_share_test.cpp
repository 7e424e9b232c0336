#include "guard/seen_share.h"

#include <gtest/gtest.h>

#include <limits>

#include "guard/times.h"
#include "scenes.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core {
namespace {

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 48;

// Looks down on a floor that is 1 m away, half a meter to each side.
Workpiece lookingDown(float free_to = 1.0F) {
  auto space = std::make_shared<FreeSpace>();
  space->X_CF = Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  space->X_CF.pretranslate(Eigen::Vector3d(0.0, 0.0, 1.0));
  space->camera = {64.0, 64.0, 31.5, 23.5};
  space->width = kWidth;
  space->height = kHeight;
  space->stride = kWidth;
  space->depths.assign(size_t{kWidth} * kHeight, free_to);
  Workpiece camera{"camera", 0, {}, {}, "world", TriangleMesh(Grid(kWidth, kHeight))};
  camera.of_camera = true;
  camera.free_space = space;
  return camera;
}

class SeenShareTest : public testing::Test {
 protected:
  // Of a ball of 10 mm that moves straight on in ten steps.
  double shareBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const std::vector<Workpiece>& cameras) {
    const Tool ball(ConvexShape::sphere(0.01));
    Workpieces workpieces;
    for (const Workpiece& camera : cameras) workpieces.push_back(std::make_shared<const Workpiece>(camera));
    PoseWithFrames pose{atSecond(1.0), {}, placedAt(from), {{"world", Eigen::Isometry3d::Identity()}}};
    PredictedPath path;
    for (int i = 1; i <= 10; ++i)
      path.push_back({i * std::chrono::milliseconds(100), placedAt(from + 0.1 * i * (to - from))});
    EXPECT_TRUE(seen_.begin(workpieces, pose));
    seen_.add(ball, pointsWithin(ball), pose.X_WT, path);
    return seen_.share();
  }

  SeenShare seen_;
};

TEST_F(SeenShareTest, APathBeforeWhatIsSeenIsSeen) {
  EXPECT_EQ(shareBetween({-0.2, 0.0, 0.3}, {0.2, 0.0, 0.02}, {lookingDown()}), 1.0);
}

TEST_F(SeenShareTest, APathBehindASurfaceIsNot) {
  EXPECT_EQ(shareBetween({-0.2, 0.0, -0.1}, {0.2, 0.0, -0.1}, {lookingDown()}), 0.0);
}

TEST_F(SeenShareTest, APathOutOfThePictureIsNot) {
  EXPECT_EQ(shareBetween({0.8, 0.0, 0.1}, {0.9, 0.0, 0.1}, {lookingDown()}), 0.0);
}

TEST_F(SeenShareTest, TheStepThatIsSeenLeastCounts) {
  EXPECT_EQ(shareBetween({0.0, 0.0, 0.3}, {0.0, 0.0, -0.05}, {lookingDown()}), 0.0);
  EXPECT_NEAR(shareBetween({0.0, 0.0, 0.2}, {0.0, 0.0, 0.0}, {lookingDown()}), 0.87, 0.1);
}

TEST_F(SeenShareTest, WhereTheToolIsNowDoesNotCount) {
  EXPECT_EQ(shareBetween({0.0, 0.0, -0.1}, {0.0, 0.0, -0.1}, {lookingDown()}), 1.0);
  EXPECT_EQ(shareBetween({0.0, 0.0, -0.1}, {0.0, 0.0, -0.101}, {lookingDown()}), 1.0) << "it hardly leaves";
  EXPECT_EQ(shareBetween({0.0, 0.0, -0.1}, {0.0, 0.0, -0.12}, {lookingDown()}), 0.0);
}

TEST_F(SeenShareTest, OneOfSeveralCamerasIsEnough) {
  EXPECT_EQ(shareBetween({-0.2, 0.0, -0.1}, {0.2, 0.0, -0.1}, {lookingDown(), lookingDown(1.5F)}), 1.0);
}

TEST_F(SeenShareTest, ACameraThatKnowsNothingSeesNothing) {
  Workpiece camera = lookingDown();
  camera.free_space = nullptr;
  EXPECT_EQ(shareBetween({-0.2, 0.0, 0.3}, {0.2, 0.0, 0.02}, {camera}), 0.0);
}

TEST_F(SeenShareTest, WithoutACameraThereIsNoShare) {
  Workpiece plain{"plain", 0, {}, {}, "world", TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
  EXPECT_FALSE(seen_.begin({std::make_shared<const Workpiece>(plain)}, {}));
}

TEST_F(SeenShareTest, ThePointsLieInEachPieceOfTheTool) {
  const Tool tool({{"a", ConvexShape::cylinder(0.01, 0.1)},
                   {"b", ConvexShape::box({0.02, 0.03, 0.04}).placed(placedAt(0.0, 0.0, 0.3))}});
  std::array<size_t, 2> in{};
  for (const Eigen::Vector3d& p_T : pointsWithin(tool)) {
    for (size_t i = 0; i < 2; ++i) in.at(i) += tool.pieces()[i].shape_T.depthOf(p_T).depth >= -1e-9 ? 1 : 0;
  }
  EXPECT_EQ(in, (std::array<size_t, 2>{32, 32}));
}

TEST_F(SeenShareTest, AGuardSaysHowMuchOfThePathIsSeen) {
  Guard guard(Tool(ConvexShape::sphere(0.01)), makeDetector("halfspace"), {});
  const Workpieces workpieces = {std::make_shared<const Workpiece>(lookingDown())};
  SweepReport report;
  Prediction prediction;
  guard.predict({}, workpieces, prediction);
  EXPECT_EQ(prediction.seen, std::nullopt) << "there is no path yet";
  const auto sweepTo = [&](int i, double z) {
    guard.sweep({atSecond(0.01 * i), {}, placedAt(0.0, 0.0, z), {{"world", Eigen::Isometry3d::Identity()}}}, workpieces,
                report);
  };
  for (int i = 0; i <= 50; ++i) sweepTo(i, 0.9 - 0.002 * i);
  guard.predict({}, workpieces, prediction);
  EXPECT_EQ(prediction.seen, 1.0);
  for (int i = 51; i <= 400; ++i) sweepTo(i, 0.9 - 0.002 * i);
  guard.predict({}, workpieces, prediction);
  EXPECT_EQ(prediction.seen, 0.0) << "in a second it is behind the floor";
  guard.predict({}, {}, prediction);
  EXPECT_EQ(prediction.seen, std::nullopt) << "there is no camera";
}

}  // namespace
}  // namespace sweep_guard_core
