#include "sweep_guard/guard/frame_motion.h"

#include <gtest/gtest.h>

#include "guard/pose_history.h"
#include "scenes.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

PredictedFrame predictedAlong(Duration ahead, double x, double variance) {
  return {ahead, along(x), variance * Matrix6d::Identity()};
}

// Measured every 10 ms up to 40 ms; predicted from 30 ms on, where it goes another way.
FrameMotion motion() {
  FrameMotion motion;
  for (int i = 0; i <= 4; ++i) motion.measured.push_back({Time(i * 10ms), along(0.1 * i), 0.0});
  motion.predicted_from = Time(30ms);
  motion.predicted = {predictedAlong(0ms, 0.3, 0.0), predictedAlong(100ms, 5.0, 1.0), predictedAlong(200ms, 6.0, 4.0)};
  return motion;
}

TEST(FrameMotionTest, IsMeasuredUpToThePrediction) {
  EXPECT_FALSE(motion().at(Time(-1ms)));
  EXPECT_NEAR(motion().at(Time(0ms))->X_WM.translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(motion().at(Time(25ms))->X_WM.translation().x(), 0.25, 1e-12);
  EXPECT_NEAR(motion().at(Time(80ms))->X_WM.translation().x(), 2.65, 1e-12);
  EXPECT_NEAR(motion().at(Time(80ms))->covariance(0, 0), 0.5, 1e-12);
}

TEST(FrameMotionTest, GoesOnForAQuarterOfASecond) {
  EXPECT_NEAR(motion().at(Time(430ms))->X_WM.translation().x(), 8.0, 1e-12);
  EXPECT_NEAR(motion().at(Time(430ms))->covariance(0, 0), 16.0, 1e-9);
  EXPECT_TRUE(motion().at(Time(480ms)));
  EXPECT_FALSE(motion().at(Time(481ms)));
}

TEST(FrameMotionTest, EndsWithTheNewestPoseIfNothingIsPredicted) {
  FrameMotion measured = motion();
  measured.predicted.clear();
  EXPECT_NEAR(measured.at(Time(40ms))->X_WM.translation().x(), 0.4, 1e-12);
  EXPECT_FALSE(measured.at(Time(41ms)));
  EXPECT_FALSE(framePath(measured, Time(40ms), {{10ms}}, 1.0));
  EXPECT_FALSE(framePath(motion(), Time(-1ms), {{10ms}}, 1.0));
}

// How far a point may be from where the frame is at a time: 0 at a pose.
double deviationAt(const FrameMotion& motion, Time time) {
  for (const FramePose& pose : motion.measured) {
    if (pose.stamp >= time) return pose.stamp == time ? 0.0 : pose.deviation_bound;
  }
  for (const PredictedFrame& pose : motion.predicted) {
    const Time stamp = motion.predicted_from + pose.ahead;
    if (stamp >= time) return stamp == time ? 0.0 : pose.deviation_bound;
  }
  return motion.predicted.back().deviation_bound;
}

// Compares each point with where the path and its bound put it, at many times.
TEST(FrameMotionTest, NoPointIsFartherFromThePathThanItsBound) {
  Random random(8);
  double tightest = 1.0;
  for (int round = 0; round < 300; ++round) {
    FrameMotion motion;
    Eigen::Isometry3d X = random.pose(random.inBox({1.0, 1.0, 1.0}));
    const auto step = [&] {
      X.translation() += random.inBox({0.1, 0.1, 0.1});
      X.linear() = X.linear() * random.turn(random.uniform(0.0, 0.4));
      return X;
    };
    for (int i = 0; i <= 5; ++i) motion.measured.push_back({Time(i * 10ms), step(), random.uniform(0.0, 0.02)});
    motion.predicted_from = Time(50ms);
    for (int i = 0; i <= 10; ++i)
      motion.predicted.push_back({i * 10ms, step(), Matrix6d::Zero(), random.uniform(0.0, 0.02)});
    const double radius = random.uniform(0.0, 0.5);
    const PredictedPath times = {{13ms}, {20ms}, {41ms}, {90ms}};
    const auto path = framePath(motion, Time(7ms), times, radius);
    ASSERT_TRUE(path);
    const Eigen::Vector3d p_M = radius * random.direction();
    Duration from{};
    for (size_t i = 0; i < times.size(); ++i) {
      const Motion straight{(*path)[i].X_WM, (*path)[i + 1].X_WM};
      double farthest = 0.0;
      for (int k = 0; k <= 50; ++k) {
        const Duration time = from + (times[i].ahead - from) * k / 50;
        const Eigen::Vector3d meant_W = straight.at(k / 50.0) * p_M;
        const double off = deviationAt(motion, Time(7ms) + time);
        farthest = std::max(farthest, off + (motion.at(Time(7ms) + time)->X_WM * p_M - meant_W).norm());
      }
      const double bound = (*path)[i + 1].deviation_bound;
      EXPECT_LE(farthest, bound + 1e-9);
      if (bound > 0.0) tightest = std::min(tightest, 1.0 - farthest / bound);
      from = times[i].ahead;
    }
  }
  EXPECT_LT(tightest, 0.5) << "a bound that holds anyway proves nothing";
}

// It may be as far on one side of the straight way as the way to it is on the other.
TEST(FrameMotionTest, APredictionThatBeginsBetweenTwoPosesDoublesTheirBound) {
  FrameMotion motion;
  motion.measured = {{Time(0ms), along(0.0)}, {Time(10ms), along(1.0), 0.1}};
  motion.predicted_from = Time(5ms);
  motion.predicted = {predictedAlong(0ms, 0.5, 0.0), predictedAlong(100ms, 5.0, 1.0)};
  const auto path = framePath(motion, Time(0ms), {{3ms}, {20ms}}, 0.5);
  EXPECT_NEAR((*path)[1].deviation_bound, 0.2, 1e-12);
  EXPECT_GE((*path)[2].deviation_bound, 0.2);
}

TEST(SparseMotionTest, NoPointIsFartherFromTheFewerPosesThanTheirBound) {
  Random random(9);
  for (int round = 0; round < 300; ++round) {
    const double radius = random.uniform(0.0, 0.5);
    const Eigen::Vector3d p_B = radius * random.direction();
    SparseMotion sparse(radius);
    std::vector<Eigen::Isometry3d> poses = {random.pose(random.inBox({1.0, 1.0, 1.0}))};
    sparse.add(Time(0ms), {poses[0]});
    EXPECT_EQ(sparse.take().deviation_bound, 0.0);
    for (int i = 1; i <= 6; ++i) {
      Eigen::Isometry3d X = poses.back();
      X.translation() += random.inBox({0.1, 0.1, 0.1});
      X.linear() = X.linear() * random.turn(random.uniform(0.0, 0.4));
      poses.push_back(X);
      sparse.add(Time(i * 10ms), {X});
    }
    const BodyPose newest = sparse.take();
    EXPECT_TRUE(newest.X_WB.isApprox(poses.back()));
    const Motion straight{poses.front(), poses.back()};
    for (int k = 0; k <= 300; ++k) {
      const int i = std::min(k / 50, 5);
      const Eigen::Isometry3d at =
          Motion{poses[static_cast<size_t>(i)], poses[static_cast<size_t>(i) + 1]}.at(k / 50.0 - i);
      EXPECT_LE((at * p_B - straight.at(k / 300.0) * p_B).norm(), newest.deviation_bound + 1e-9);
    }
  }
}

// 33 ms apart, 0.3 m/s and a quarter of a turn in a second.
FrameMotion seldomMeasured() {
  FrameMotion motion;
  motion.goes_on = true;
  for (int i = 0; i < 4; ++i) {
    Eigen::Isometry3d X = along(0.3 * 0.033 * i);
    X.linear() = Eigen::AngleAxisd(M_PI_2 * 0.033 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    motion.measured.push_back({Time(33ms * i), X});
  }
  return motion;
}

TEST(FrameThatGoesOnTest, IsWhereItsLastSpeedPutsIt) {
  const auto pose = seldomMeasured().at(Time(99ms + 400ms));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->X_WM.translation().x(), 0.3 * 0.499, 1e-9);
  const Eigen::AngleAxisd turn(pose->X_WM.linear());
  EXPECT_NEAR(turn.angle(), M_PI_2 * 0.499, 1e-9);
  EXPECT_FALSE(seldomMeasured().at(Time(-1ms)));
}

TEST(FrameThatGoesOnTest, ItsErrorGrowsAsSpeedTimesTime) {
  for (const int ms : {0, 100, 1000}) {
    const Matrix6d covariance = seldomMeasured().at(Time(99ms + std::chrono::milliseconds(ms)))->covariance;
    EXPECT_NEAR(std::sqrt(covariance.topLeftCorner<3, 3>().trace()), 0.3e-3 * ms, 1e-9);
    EXPECT_NEAR(std::sqrt(covariance.bottomRightCorner<3, 3>().trace()), M_PI_2 * 1e-3 * ms, 1e-9);
  }
}

// Samples at stamps of poses may be microseconds from a transform: their rounding is no speed.
TEST(FrameThatGoesOnTest, ItsSpeedIsThatOfTwentyMillisecondsAtLeast) {
  FrameMotion motion = seldomMeasured();
  FramePose newest = motion.measured.back();
  newest.stamp += 1us;
  newest.X_WM.translation().x() += 1e-4;
  motion.measured.push_back(newest);
  EXPECT_NEAR(motion.velocity()[0], 0.3, 0.01);
  motion.measured.resize(1);
  EXPECT_TRUE(motion.velocity().isZero(0.0));
}

TEST(FrameThatGoesOnTest, HasAPathOfAnyLength) {
  const auto path = framePath(seldomMeasured(), Time(150ms), {{10ms}, {1s}}, 1.0);
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->back().X_WM.translation().x(), 0.3 * 1.15, 1e-9);
  EXPECT_NEAR(path->back().deviation_bound, 0.0, 1e-9);
}

TEST(FrameThatGoesOnTest, RestsTwoSecondsAfterItWasHeardLast) {
  for (const auto later : {2s, 60s})
    EXPECT_NEAR(seldomMeasured().at(Time(99ms + later))->X_WM.translation().x(), 0.3 * 2.099, 1e-9);
}

// Its first step there may be from a place that is wrong by a millimetre: within a millisecond, that would be 1 m/s.
TEST(FrameThatGoesOnTest, WhereItWasPlacedAnewItGoesOnAsBeforeForTwentyMilliseconds) {
  FrameMotion motion = seldomMeasured();
  FramePose anew{Time(99ms + 1ns), along(7.0), 0.0, /*anew=*/true};
  const Eigen::AngleAxisd quarter(M_PI_2, Eigen::Vector3d::UnitY());
  anew.X_WM.linear() = quarter * motion.measured.back().X_WM.linear();
  motion.measured.push_back(anew);
  EXPECT_NEAR((motion.velocity().head<3>() - Eigen::Vector3d(0.0, 0.0, -0.3)).norm(), 0.0, 1e-9);
  anew.stamp = Time(100ms);
  anew.X_WM.translation().x() += 1e-3;
  anew.anew = false;
  motion.measured.push_back(anew);
  EXPECT_NEAR(motion.velocity()[2], -0.3, 1e-9);
  anew.stamp = Time(130ms);
  anew.X_WM.translation().x() = 7.03;
  motion.measured.push_back(anew);
  EXPECT_NEAR(motion.velocity()[0], 0.029 / 0.03, 1e-9);
}

class FrameMotionStoreTest : public testing::Test {
 protected:
  static FramePose pose(int ms) { return {Time(std::chrono::milliseconds(ms)), along(ms)}; }
  void add(int ms) { store_.add("tray", {pose(ms)}); }
  void sweep(Time stamp) { store_.forgetBefore(stamp, *store_.get()); }
  std::vector<FramePose> measured() const { return store_.get()->at("tray")->measured; }

  FrameMotionStore store_;
};

TEST_F(FrameMotionStoreTest, SortsWhatIsAddedAndTakesEachTimeOnce) {
  store_.add("tray", {pose(30), pose(10), pose(20)});
  for (const int ms : {30, 25}) add(ms);
  std::vector<double> places;
  for (const FramePose& pose : measured()) places.push_back(pose.X_WM.translation().x());
  EXPECT_EQ(places, (std::vector<double>{10, 20, 25, 30}));
}

TEST_F(FrameMotionStoreTest, KeepsWhatLaterPosesOfTheToolNeed) {
  for (int ms = 0; ms <= 1000; ms += 10) add(ms);
  EXPECT_EQ(measured().size(), 101U) << "nothing was swept yet";
  sweep(Time(505ms));
  add(1010);
  EXPECT_EQ(measured().front().stamp, Time(500ms)) << "at 505 ms it lies after this one";
  sweep(Time(2s));
  add(1020);
  EXPECT_LE(measured().front().stamp, Time(920ms)) << "its speed needs some";
  EXPECT_GE(measured().front().stamp, Time(900ms));
}

TEST_F(FrameMotionStoreTest, KeepsTwoPosesHoweverOld) {
  add(0);
  sweep(Time(2s));
  add(400);
  sweep(Time(2s));
  add(800);
  EXPECT_EQ(measured().size(), 2U);
}

TEST_F(FrameMotionStoreTest, KeepsWhatCameSinceTheSweepOfAFrameThatWasSilent) {
  add(0);
  add(10);
  sweep(Time(5s));  // which knew it up to 10 ms
  std::vector<FramePose> poses;
  for (int ms = 1000; ms <= 5000; ms += 10) poses.push_back(pose(ms));
  store_.add("tray", poses);
  EXPECT_EQ(measured().size(), poses.size() + 1);
}

TEST_F(FrameMotionStoreTest, MarksWhereItLeavesOutPoses) {
  std::vector<FramePose> poses;
  for (int ms = 0; ms < 8192; ++ms) poses.push_back(pose(ms));
  store_.add("tray", poses);
  EXPECT_FALSE(measured()[1].left_out);
  store_.add("tray", {pose(8192), pose(8193)});
  EXPECT_EQ(measured().size(), 8192U);
  EXPECT_EQ(measured().front().stamp, Time(0ms));
  EXPECT_EQ(measured()[1].stamp, Time(3ms));
  EXPECT_TRUE(measured()[1].left_out);
  EXPECT_FALSE(measured()[2].left_out);
}

class FramePlacedAnewTest : public FrameMotionStoreTest {
 protected:
  FramePlacedAnewTest() { store_.add("tray", {pose(0), pose(20), pose(40)}); }
  void place(const std::vector<int>& stamps) {
    std::vector<FramePose> placed;
    for (const int ms : stamps) placed.push_back({Time(std::chrono::milliseconds(ms)), along(1000 + ms)});
    store_.placeAnew("tray", placed);
  }
  double at(Time time) const { return store_.at("tray", time)->translation().x(); }
};

TEST_F(FramePlacedAnewTest, AFrameIsWhereItWasUpToThenAndThenWhereItIs) {
  place({30, 40});
  EXPECT_NEAR(at(Time(25ms)), 25.0, 1e-9);
  EXPECT_NEAR(at(Time(30ms - 1ns)), 30.0, 1e-5);
  EXPECT_EQ(at(Time(30ms)), 1030.0);
  EXPECT_NEAR(at(Time(35ms)), 1035.0, 1e-9);
  EXPECT_EQ(measured().size(), 5U);
  EXPECT_TRUE(measured()[3].anew);
  EXPECT_FALSE(measured()[4].anew);
}

TEST_F(FramePlacedAnewTest, WhereItIsNotKnownYetItWentOnInTheOldPlace) {
  place({100});
  EXPECT_NEAR(at(Time(100ms - 1ns)), 100.0, 1e-5);
  EXPECT_EQ(at(Time(100ms)), 1100.0);
}

TEST_F(FramePlacedAnewTest, BeforeAllThatIsKnownThereIsNoOldPlace) {
  store_.keepOnly({});
  store_.add("tray", {pose(50)});
  place({50});
  EXPECT_EQ(measured().size(), 1U);
  EXPECT_FALSE(measured()[0].anew);
}

TEST_F(FrameMotionStoreTest, ForgetsOnlyWhatWasAdded) {
  add(0);
  store_.expect("/other/", {"/other/arm"});
  store_.set({{"/other/arm", std::make_shared<const FrameMotion>(motion())}});
  store_.keepOnly({});
  EXPECT_EQ(store_.get()->count("tray"), 0U);
  EXPECT_EQ(store_.get()->count("/other/arm"), 1U);
  EXPECT_FALSE(store_.expects("tray"));
}

}  // namespace
}  // namespace sweep_guard_core
