#include "sweep_guard/prediction/pose_predictor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "prediction/motion_space.h"
#include "prediction/predictors.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

PredictedPath pathOf(const PosePredictor& predictor, const std::vector<Duration>& ahead) {
  PredictedPath path;
  predictor.predict(ahead, path);
  return path;
}

using std::chrono::milliseconds;

using PoseAt = std::function<Eigen::Isometry3d(double)>;

PosePredictor predictorOf(const std::string& name) { return PosePredictor(optionsOf(name)); }

void follow(PosePredictor& predictor, const PoseAt& truth, double from, double until, double period) {
  for (int i = 0; from + i * period <= until + 1e-9; ++i) {
    predictor.observe({at(from + i * period), truth(from + i * period)});
  }
}

void expectExact(const PosePredictor& predictor, const PoseAt& truth, double now, double tolerance) {
  const PredictedPath path = pathOf(predictor, kAhead);
  ASSERT_EQ(path.size(), kAhead.size());
  for (const PredictedPose& pose : path) {
    const Vector6d error = displacement(pose.X_WT, truth(now + toSeconds(pose.ahead)));
    EXPECT_LT(error.norm(), tolerance) << toSeconds(pose.ahead) << " s ahead";
  }
}

// Each axis a polynomial of its own; it turns about one axis, faster and faster, through many half turns.
Eigen::Isometry3d polynomialMotion(double t) {
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() << 0.2 - 0.1 * t, 0.05 * t * t - 0.1 * t, 0.01 * t * t * t;
  const Eigen::Vector3d axis_T = Eigen::Vector3d(1.0, 2.0, -2.0) / 3.0;
  X_WT.linear() = Eigen::AngleAxisd(3.0 * t + 0.2 * t * t, axis_T).toRotationMatrix();
  return X_WT;
}

Eigen::Isometry3d steadyMotion(double t) {
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() << 0.1 * t, 0.02 - 0.05 * t, 0.0;
  X_WT.linear() = Eigen::AngleAxisd(1.5 * t, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return X_WT;
}

TEST(PosePredictorTest, APolynomialOfItsDegreeIsPredictedExactly) {
  for (const double period : {0.001, 0.01, 0.066}) {
    PredictorOptions options = optionsOf("polynomial");
    options.degree = {1, 2, 3, 2, 2, 2};
    PosePredictor predictor(options);
    follow(predictor, polynomialMotion, 0.0, 3.0, period);
    expectExact(predictor, polynomialMotion, std::floor(3.0 / period + 1e-9) * period, 1e-9);
  }
}

TEST(PosePredictorTest, ConstantVelocityIsPredictedExactlyByAllThatMove) {
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    PosePredictor predictor = predictorOf(name);
    follow(predictor, steadyMotion, 0.0, 0.5, 0.01);
    expectExact(predictor, steadyMotion, 0.5, 1e-9);
    follow(predictor, steadyMotion, 0.51, 30.0, 0.01);
    expectExact(predictor, steadyMotion, 30.0, 1e-9);
  }
}

TEST(PosePredictorTest, HoldStaysWhereTheToolIs) {
  PosePredictor predictor = predictorOf("hold");
  follow(predictor, steadyMotion, 0.0, 1.0, 0.01);
  for (const PredictedPose& pose : pathOf(predictor, kAhead)) {
    EXPECT_TRUE(pose.X_WT.isApprox(steadyMotion(1.0), 1e-12));
    EXPECT_GT(pose.covariance(0, 0), 0.0);
  }
}

TEST(PosePredictorTest, AConstrainedAxisIsHeld) {
  for (const char* name : {"polynomial", "constant_velocity", "direct"}) {
    PredictorOptions options = optionsOf(name);
    options.constrained = {false, true, false, false, true, false};
    PosePredictor predictor(options);
    follow(predictor, steadyMotion, 0.0, 1.0, 0.01);
    const Eigen::Isometry3d X_WT = pathOf(predictor, kAhead).back().X_WT;
    EXPECT_NEAR(X_WT.translation().x(), steadyMotion(2.0).translation().x(), 1e-9) << name;
    EXPECT_NEAR(X_WT.translation().y(), steadyMotion(1.0).translation().y(), 1e-9) << name;
    EXPECT_TRUE(X_WT.linear().isApprox(steadyMotion(1.0).linear(), 1e-9)) << name;
  }
}

TEST(PosePredictorTest, KnowsNothingBeforeTheSecondPose) {
  for (const std::string& name : predictorNames()) {
    PosePredictor predictor = predictorOf(name);
    EXPECT_TRUE(pathOf(predictor, kAhead).empty());
    predictor.observe({at(0.0), steadyMotion(0.0)});
    EXPECT_TRUE(pathOf(predictor, kAhead).empty());
    predictor.observe({at(0.01), steadyMotion(0.01)});
    EXPECT_EQ(pathOf(predictor, kAhead).size(), kAhead.size()) << name;
  }
}

TEST(PosePredictorTest, BeginsAnewAfterAGapAJumpOrARestart) {
  for (const std::string& name : predictorNames()) {
    PosePredictor predictor = predictorOf(name);
    follow(predictor, steadyMotion, 0.0, 1.0, 0.01);
    predictor.observe({at(3.0), steadyMotion(3.0)});
    EXPECT_TRUE(pathOf(predictor, kAhead).empty()) << name << ": a gap of 2 s";
    follow(predictor, steadyMotion, 3.01, 3.1, 0.01);
    predictor.observe({at(3.11), Eigen::Translation3d(9.0, 0.0, 0.0) * steadyMotion(3.11)});
    EXPECT_TRUE(pathOf(predictor, kAhead).empty()) << name << ": a jump of 9 m";
    follow(predictor, steadyMotion, 3.12, 3.3, 0.01);
    EXPECT_FALSE(pathOf(predictor, kAhead).empty());
    predictor.restart();
    predictor.observe({at(0.0), steadyMotion(0.0)});
    EXPECT_TRUE(pathOf(predictor, kAhead).empty()) << name << ": restarted";
  }
}

TEST(PosePredictorTest, WhatWasLearnedSurvivesAGap) {
  // Back and forth: a velocity does not carry far.
  const PoseAt shake = [](double t) { return Eigen::Isometry3d(Eigen::Translation3d(0.05 * std::sin(6.0 * t), 0, 0)); };
  PosePredictor predictor = predictorOf("direct");
  follow(predictor, shake, 0.0, 30.0, 0.01);
  follow(predictor, shake, 33.0, 33.05, 0.01);
  const double speed = 0.3 * std::cos(6.0 * 33.05);
  const double far = pathOf(predictor, kAhead).back().X_WT.translation().x() - shake(33.05).translation().x();
  EXPECT_LT(std::abs(far), 0.5 * std::abs(speed));
}

// Out to one side, rest for a second, back, rest, then to the other side. All velocities of the last 0.8 s are 0 when the
// rest ends: only where the tool is tells where it will go.
TEST(PosePredictorTest, AToolThatAlwaysReturnsIsPredictedToReturn) {
  const PoseAt visit = [](double t) {
    const double phase = std::fmod(t, 4.0);
    const double side = std::fmod(t, 8.0) < 4.0 ? 1.0 : -1.0;
    const double out = phase < 1.0 ? phase : phase < 2.0 ? 1.0 : std::max(3.0 - phase, 0.0);
    return Eigen::Isometry3d(Eigen::Translation3d(side * 0.2 * out, 0.0, 0.0));
  };
  PosePredictor predictor = predictorOf("direct");
  follow(predictor, visit, 0.0, 65.95, 0.01);
  const double there = visit(65.95).translation().x();
  ASSERT_NEAR(there, 0.2, 1e-9);
  EXPECT_LT(pathOf(predictor, kAhead).back().X_WT.translation().x(), there - 0.05);
}

TEST(PosePredictorTest, IsNeverFasterThanTheLimits) {
  for (const std::string& name : predictorNames()) {
    PredictorOptions options = optionsOf(name);
    options.degree = {3, 3, 3, 3, 3, 3};
    options.max_speed = 0.5;
    options.max_turn_rate = 2.0;
    PosePredictor predictor(options);
    const PoseAt rush = [](double t) {
      return Eigen::Translation3d(0.4 * t * t, 0, 0) * Eigen::AngleAxisd(1.5 * t * t, Eigen::Vector3d::UnitZ());
    };
    follow(predictor, rush, 0.0, 0.6, 0.01);
    for (const PredictedPose& pose : pathOf(predictor, kAhead)) {
      const Vector6d moved = displacement(rush(0.6), pose.X_WT);
      EXPECT_LE(moved.head<3>().norm(), 0.5 * toSeconds(pose.ahead) + 1e-12) << name;
      EXPECT_LE(moved.tail<3>().norm(), 2.0 * toSeconds(pose.ahead) + 1e-9) << name;
    }
  }
}

// Gaps, jumps, outliers, equal stamps, rest, rates from 5 Hz to 1 GHz: whatever comes, what goes out is a pose, as near
// as the limits say, with a covariance that a tool at the limits could have earned.
TEST(PosePredictorTest, NothingThatComesMakesItExplode) {
  for (const std::string& name : predictorNames()) {
    Random random(7);
    PredictorOptions options = optionsOf(name);
    options.degree = {0, 1, 2, 3, 4, 5};
    PosePredictor predictor(options);
    double t = 0.0;
    Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 20000; ++i) {
      if (!random.chance(0.05)) t += random.chance(0.002) ? 3.0 : random.logUniform(1e-9, 0.2);
      const double step = random.chance(0.3) ? 0.0 : random.logUniform(1e-9, 1e-2);
      X_WT.translation() += step * random.direction();
      X_WT.linear() = X_WT.linear() * random.turn(random.chance(0.3) ? 0.0 : random.logUniform(1e-9, 0.3));
      X_WT.linear() = Eigen::Quaterniond(X_WT.linear()).normalized().toRotationMatrix();
      const Eigen::Isometry3d outlier = random.pose(100.0 * random.direction());
      const StampedPose pose{at(t), random.chance(0.01) ? outlier : X_WT};
      predictor.observe(pose);
      for (const PredictedPose& expected : pathOf(predictor, kAhead)) {
        const double ahead = toSeconds(expected.ahead);
        ASSERT_TRUE(expected.X_WT.matrix().allFinite()) << name << ", pose " << i;
        ASSERT_NEAR(expected.X_WT.linear().determinant(), 1.0, 1e-9);
        ASSERT_LE((expected.X_WT.translation() - pose.X_WT.translation()).norm(),
                  options.max_speed * ahead * (1.0 + 1e-9));
        ASSERT_GE(expected.covariance.diagonal().minCoeff(), 0.0);
        ASSERT_LE(expected.covariance.diagonal().head<3>().maxCoeff(), std::pow(3.0 * options.max_speed * ahead, 2));
      }
    }
  }
}

// A tool that has rested for long, and then goes: more than half of its displacement is predicted at once, and the doubt does not
// outgrow the motion.
TEST(PosePredictorTest, FollowsAToolThatHasRested) {
  const PoseAt start = [](double t) {
    return Eigen::Isometry3d(Eigen::Translation3d(0.3 * std::max(t - 30.0, 0.0), 0.0, 0.0));
  };
  for (const char* name : {"constant_velocity", "direct"}) {
    PosePredictor predictor = predictorOf(name);
    follow(predictor, start, 0.0, 30.0, 0.01);
    for (int i = 3001; i < 3500; ++i) {
      predictor.observe({at(0.01 * i), start(0.01 * i)});
      const PredictedPose pose = pathOf(predictor, {milliseconds(1000)})[0];
      const double displaced = pose.X_WT.translation().x() - start(0.01 * i).translation().x();
      if (i > 3010) {
        ASSERT_GT(displaced, 0.16) << name << " at " << 0.01 * i << " s";
      }
      ASSERT_LT(std::sqrt(pose.covariance(0, 0)), 0.45) << name << " at " << 0.01 * i << " s";
    }
  }
}

// Two poses a microsecond and half a millimetre apart are no speed of 500 m/s to learn from.
TEST(PosePredictorTest, AStutterOfTheStampsDoesNotPoisonWhatIsLearned) {
  const PoseAt sway = [](double t) { return Eigen::Isometry3d(Eigen::Translation3d(0.2 * std::sin(2.0 * t), 0, 0)); };
  for (const char* name : {"constant_velocity", "direct"}) {
    PosePredictor steady = predictorOf(name);
    PosePredictor stuttering = predictorOf(name);
    follow(steady, sway, 0.0, 10.0, 0.01);
    follow(stuttering, sway, 0.0, 5.0, 0.01);
    stuttering.observe({at(5.000001), Eigen::Translation3d(0.0005, 0.0, 0.0) * sway(5.0)});
    follow(stuttering, sway, 5.01, 10.0, 0.01);
    const PredictedPose expected = pathOf(steady, {milliseconds(500)})[0];
    const PredictedPose disturbed = pathOf(stuttering, {milliseconds(500)})[0];
    EXPECT_LT((expected.X_WT.translation() - disturbed.X_WT.translation()).norm(), 0.002) << name;
    EXPECT_LT(disturbed.covariance(0, 0), 1.2 * expected.covariance(0, 0)) << name;
  }
}

// A driver at 100 Hz whose poses are stamped when they arrive: in bursts. A tool at 0.1 m/s never looks as if it would go 0.1 m
// within 0.1 s, from the first burst on; once they are known, it goes as far as it does.
TEST(PosePredictorTest, BurstsOfStampsAreNoFastMotion) {
  struct Bursts {
    int poses;
    double apart;   // [s]
    double period;  // [s]
  };
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    for (const Bursts& bursts :
         {Bursts{5, 0.001, 0.05}, Bursts{3, 0.002, 0.03}, Bursts{10, 0.0006, 0.1}, Bursts{20, 0.001, 0.2}}) {
      PosePredictor predictor = predictorOf(name);
      for (int i = 0; i < 40 * bursts.poses; ++i) {
        const int burst = i / bursts.poses;
        const double x = 0.1 * bursts.period * i / bursts.poses;
        predictor.observe({at(bursts.period * burst + bursts.apart * (i % bursts.poses)),
                           Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0))});
        if (i == 0) continue;
        const PredictedPose pose = pathOf(predictor, {milliseconds(100)})[0];
        const double moved = pose.X_WT.translation().x() - x;
        ASSERT_LT(moved + 3.0 * std::sqrt(pose.covariance(0, 0)), 0.3)
            << name << ", pose " << i << " of bursts of " << bursts.poses;
        if (burst > 30) {
          ASSERT_NEAR(moved, 0.01, 0.02) << name << ", pose " << i << " of bursts of " << bursts.poses;
        }
      }
    }
  }
}

// The smaller rotation from pose to pose, so that neither a half turn nor a full turn shows.
TEST(PosePredictorTest, SpinsThroughHalfTurnsSmoothly) {
  const PoseAt spin = [](double t) {
    return Eigen::Isometry3d(Eigen::AngleAxisd(9.0 * t, Eigen::Vector3d(2.0, -1.0, 2.0) / 3.0));
  };
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    PosePredictor predictor = predictorOf(name);
    follow(predictor, spin, 0.0, 0.3, 0.01);
    for (int i = 31; i < 300; ++i) {
      predictor.observe({at(0.01 * i), spin(0.01 * i)});
      const PredictedPose pose = pathOf(predictor, {milliseconds(100)})[0];
      ASSERT_LT(displacement(pose.X_WT, spin(0.01 * i + 0.1)).norm(), 1e-6) << name << " at " << 0.01 * i << " s";
    }
  }
}

// More frequencies than a predictor has regressors: what it can learn exactly, its errors show only later.
TEST(PosePredictorTest, ItsCovarianceMatchesItsErrors) {
  const auto wave = [](double t) {
    double sum = 0.0;
    for (int i = 0; i < 10; ++i) sum += 0.05 * std::sin((1.0 + 0.61 * i) * t + 1.7 * i * i);
    return sum;
  };
  const PoseAt sway = [&](double t) {
    return Eigen::Isometry3d(Eigen::Translation3d(wave(t), wave(t + 100.0), wave(t + 200.0)));
  };
  for (const std::string& name : predictorNames()) {
    PosePredictor predictor = predictorOf(name);
    follow(predictor, sway, 0.0, 30.0, 0.01);
    double errors = 0.0;
    double expected = 0.0;
    for (int i = 3001; i < 6000; ++i) {
      predictor.observe({at(0.01 * i), sway(0.01 * i)});
      const PredictedPose pose = pathOf(predictor, {milliseconds(500)})[0];
      errors += displacement(pose.X_WT, sway(0.01 * i + 0.5)).head<3>().squaredNorm();
      expected += pose.covariance.topLeftCorner<3, 3>().trace();
    }
    EXPECT_GT(expected, 0.5 * errors) << name;
    EXPECT_LT(expected, 2.0 * errors) << name;
  }
}

TEST(PosePredictorTest, RefusesOptionsThatCannotWork) {
  const auto refuses = [](const std::function<void(PredictorOptions&)>& change) {
    for (const std::string& name : predictorNames()) {
      PredictorOptions options = optionsOf(name);
      change(options);
      EXPECT_THROW(PosePredictor{options}, InvalidInput) << name;
    }
  };
  refuses([](PredictorOptions& options) { options.predictor = "oracle"; });
  refuses([](PredictorOptions& options) { options.degree[2] = 6; });
  refuses([](PredictorOptions& options) { options.degree[2] = -1; });
  refuses([](PredictorOptions& options) { options.forgetting_factor = 0.0; });
  refuses([](PredictorOptions& options) { options.forgetting_factor = std::nan(""); });
  refuses([](PredictorOptions& options) { options.window = Duration::zero(); });
  refuses([](PredictorOptions& options) { options.max_speed = 0.0; });
  refuses([](PredictorOptions& options) { options.max_turn_rate = std::nan(""); });
}

}  // namespace
}  // namespace sweep_guard_core
