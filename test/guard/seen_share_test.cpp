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
  // Of a ball of 10 mm, or another tool, that moves straight on in ten steps.
  double shareBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const std::vector<Workpiece>& cameras,
                      const Tool& tool = Tool(ConvexShape::sphere(0.01))) {
    const BodyBoxes boxes(tool, 64);
    Workpieces workpieces;
    for (const Workpiece& camera : cameras) workpieces.push_back(std::make_shared<const Workpiece>(camera));
    PoseWithFrames pose{atSecond(1.0), {}, placedAt(from), {{"world", Eigen::Isometry3d::Identity()}}};
    PredictedPath path;
    for (int i = 1; i <= 10; ++i)
      path.push_back({i * std::chrono::milliseconds(100), placedAt(from + 0.1 * i * (to - from))});
    EXPECT_TRUE(seen_.begin(workpieces, pose));
    seen_.place(boxes, pose.X_WT);
    seen_.add(boxes, pose.X_WT, path);
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

TEST_F(SeenShareTest, PlacesNearToTheToolDoNotCount) {
  EXPECT_EQ(shareBetween({0.0, 0.0, -0.1}, {0.0, 0.0, -0.1}, {lookingDown()}), 1.0);
  EXPECT_EQ(shareBetween({0.0, 0.0, -0.1}, {0.0, 0.0, -0.12}, {lookingDown()}), 1.0);
  EXPECT_EQ(shareBetween({0.0, 0.0, -0.1}, {0.0, 0.0, -0.15}, {lookingDown()}), 0.0);
}

TEST_F(SeenShareTest, ALongToolThatGoesAlongItselfIsNotSeenWhereItsTipIsNot) {
  const Tool needle = Tool::cylinder(0.002, 0.3);
  EXPECT_EQ(shareBetween({0.0, 0.0, 0.3}, {0.0, 0.0, 0.2}, {lookingDown()}, needle), 0.0);
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

TEST_F(SeenShareTest, ThePointsAreSpreadEvenlyOverTheBoxesOfThePieces) {
  const Tool tool({{"a", ConvexShape::cylinder(0.01, 0.1)},
                   {"b", ConvexShape::box({0.02, 0.03, 0.04}).placed(placedAt(0.0, 0.0, 0.3))}});
  const BodyBoxes boxes(tool, 64);
  Eigen::AlignedBox3d of_a, of_b;
  Eigen::Vector3d mean_b = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < 64; ++i) {
    (i < 32 ? of_a : of_b).extend(boxes.points_B()[i]);
    if (i >= 32) mean_b += boxes.points_B()[i] / 32.0;
  }
  EXPECT_LT((of_a.center() - Eigen::Vector3d(0.0, 0.0, -0.05)).norm(), 0.005);
  EXPECT_NEAR(of_a.sizes().z(), 0.1, 0.01);
  EXPECT_NEAR(of_b.sizes().z(), 0.08, 0.01);
  EXPECT_LT((mean_b - Eigen::Vector3d(0.0, 0.0, 0.3)).norm(), 0.005);
  EXPECT_TRUE(boxes.isNear({0.0, 0.0, 0.019}));
  EXPECT_FALSE(boxes.isNear({0.0, 0.0, 0.021}));
  EXPECT_TRUE(boxes.isNear({0.039, 0.0, 0.3}));
}

TEST_F(SeenShareTest, WhereAnotherBodyOfTheToolIsNowDoesNotCount) {
  const BodyBoxes moving(Tool(ConvexShape::sphere(0.01)), 64);
  const BodyBoxes resting(Tool(ConvexShape::sphere(0.06)), 32);
  PredictedPath path(10);
  for (int i = 0; i < 10; ++i) path[static_cast<size_t>(i)].X_WT = placedAt(0.006 * (i + 1), 0.0, -0.1);
  for (const bool is_there : {false, true}) {
    seen_.begin({std::make_shared<const Workpiece>(lookingDown())}, {{}, {}, {}, {{"world", placedAt(0.0, 0.0, 0.0)}}});
    seen_.place(moving, placedAt(0.0, 0.0, -0.1));
    if (is_there) seen_.place(resting, placedAt(0.07, 0.0, -0.1));
    seen_.add(moving, placedAt(0.0, 0.0, -0.1), path);
    EXPECT_EQ(seen_.share(), is_there ? 1.0 : 0.0);
  }
}

TEST_F(SeenShareTest, AnotherToolTakesUpOtherPlaces) {
  Guard guard(Tool(ConvexShape::sphere(0.01)), makeDetector("halfspace"), {});
  const Workpieces workpieces = {std::make_shared<const Workpiece>(lookingDown())};
  SweepReport report;
  for (int i = 0; i <= 50; ++i)
    guard.sweep({atSecond(0.01 * i), {}, placedAt(0.001 * i, 0.0, 0.3), {{"world", Eigen::Isometry3d::Identity()}}},
                workpieces, report);
  Prediction prediction;
  guard.predict({}, workpieces, prediction);
  EXPECT_EQ(prediction.seen, 1.0);
  GuardChange change;
  change.bodies = {Tool(ConvexShape::sphere(0.01).placed(placedAt(0.0, 0.0, -0.9)))};
  guard.exchange(change);
  guard.predict({}, workpieces, prediction);
  EXPECT_EQ(prediction.seen, 0.0) << "it is under the floor";
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
