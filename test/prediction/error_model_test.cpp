#include "prediction/error_model.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

// A tool that goes along x at a speed that changes now and then, and predictions that err by a known share of it.
class ErrorModelTest : public testing::Test {
 protected:
  void go(double seconds, double speed, double error_share) {
    for (int i = 0; i < static_cast<int>(seconds / kPeriod); ++i) {
      time_ += kPeriod;
      x_ += speed * kPeriod;
      StampedPose pose;
      pose.stamp = Time(fromSeconds(time_));
      pose.X_WT.translation().x() = x_;
      track_.add(pose);
      Vector6d velocity = Vector6d::Zero();
      velocity[0] = speed;
      PredictedDisplacements<PoseSpace> predicted;
      for (size_t k = 0; k < predicted.size(); ++k) {
        predicted[k] = kLearnedHorizons[k] * velocity;
        predicted[k].head<3>() += error_share * kLearnedHorizons[k] * speed * std::sqrt(3.0) * random_.direction();
      }
      model_.observe(track_, velocity, predicted);
    }
  }
  double deviation(double ahead) const {
    return std::sqrt(model_.covariance(ahead).topLeftCorner<3, 3>().trace() / 3.0);
  }

  static constexpr double kPeriod = 0.01;
  Random random_{1};
  double time_ = 100.0;
  double x_ = 0.0;
  PoseTracker track_{PoseSpace{5.0, 20.0}};
  ErrorModel<PoseSpace> model_{PoseSpace{5.0, 20.0}};
};

TEST_F(ErrorModelTest, AssumesAShareOfTheDisplacementBeforeItHasErrors) {
  go(0.02, 0.2, 0.0);
  EXPECT_GT(deviation(0.5), 0.1 * 0.5 * 0.2);
  EXPECT_LT(deviation(0.5), 0.5 * 0.2);
}

TEST_F(ErrorModelTest, MeasuresTheErrorsOfPredictions) {
  go(60.0, 0.2, 0.1);
  for (const double ahead : kLearnedHorizons) EXPECT_NEAR(deviation(ahead), 0.1 * ahead * 0.2, 0.1 * 0.1 * ahead * 0.2);
}

TEST_F(ErrorModelTest, InterpolatesBetweenHorizonsAndGrowsBeyondThem) {
  go(60.0, 0.2, 0.1);
  EXPECT_GT(deviation(0.6), deviation(0.5));
  EXPECT_LT(deviation(0.6), deviation(0.75));
  EXPECT_NEAR(deviation(2.0), 2.0 * deviation(1.0), 1e-9);
  EXPECT_LT(deviation(0.001), deviation(0.02));
}

TEST_F(ErrorModelTest, ExpectsGreaterErrorsInFastMotion) {
  go(20.0, 0.1, 0.1);
  go(20.0, 0.3, 0.1);
  const double fast = deviation(0.5);
  go(0.02, 0.1, 0.1);
  EXPECT_LT(deviation(0.5), 0.9 * fast);
}

// The tool goes along x and its predictions err along x alone.
TEST(ErrorModelDirectionTest, SeparatesErrorsAlongTheMotionFromErrorsAcrossIt) {
  PoseTracker tracker(PoseSpace{5.0, 20.0});
  ErrorModel<PoseSpace> model(PoseSpace{5.0, 20.0});
  for (int i = 0; i < 6000; ++i) {
    StampedPose pose;
    pose.stamp = Time(fromSeconds(100.0 + 0.01 * i));
    pose.X_WT.translation().x() = 0.002 * i;
    tracker.add(pose);
    const Vector6d velocity = 0.2 * Vector6d::Unit(0);
    PredictedDisplacements<PoseSpace> predicted;
    for (size_t k = 0; k < predicted.size(); ++k) predicted[k] = 1.1 * kLearnedHorizons[k] * velocity;
    model.observe(tracker, velocity, predicted);
  }
  const Eigen::Matrix3d covariance = model.covariance(0.5).topLeftCorner<3, 3>();
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), 0.1 * 0.5 * 0.2, 1e-3);
  EXPECT_LT(std::sqrt(covariance(1, 1)), 0.1 * std::sqrt(covariance(0, 0)));
  EXPECT_NEAR(covariance(0, 1), 0.0, 1e-12);
}

TEST_F(ErrorModelTest, AToolThatNeverErrsIsTrusted) {
  go(120.0, 0.2, 0.0);
  EXPECT_LT(deviation(1.0), 0.01 * 0.2);
}

TEST_F(ErrorModelTest, KnowsNothingAboutTurnsOfAToolThatNeverTurned) {
  go(20.0, 0.2, 0.1);
  EXPECT_EQ((model_.covariance(0.5).bottomRightCorner<3, 3>().norm()), 0.0);
}

}  // namespace
}  // namespace sweep_guard_core
