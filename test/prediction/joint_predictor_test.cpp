#include "sweep_guard/prediction/joint_predictor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "prediction/predictors.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

using PositionsAt = std::function<std::vector<double>(double)>;

void observe(JointPredictor& predictor, double seconds, const std::vector<double>& positions) {
  predictor.observe(at(seconds), positions);
}

void followJoints(JointPredictor& predictor, const PositionsAt& truth, double from, double until) {
  for (int i = 0; from + 0.01 * i <= until + 1e-9; ++i) observe(predictor, from + 0.01 * i, truth(from + 0.01 * i));
}

PredictedJoints predicted(const JointPredictor& predictor, Duration ahead) {
  PredictedJoints joints;
  predictor.predict(ahead, joints);
  return joints;
}

JointVariable sliding(double lower, double upper) {
  JointVariable joint{"", lower, upper};
  joint.turns = false;
  return joint;
}

// A joint that turns, and one that slides.
const std::vector<JointVariable> kBoth = {{}, sliding(-kUnlimited, kUnlimited)};

std::vector<double> steady(double t) { return {0.3 - 0.8 * t, 0.1 + 0.02 * t}; }

TEST(JointPredictorTest, ConstantSpeedIsPredictedExactlyByAllThatMove) {
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    JointPredictor predictor(optionsOf(name), kBoth);
    for (const double until : {0.5, 20.0}) {
      followJoints(predictor, steady, until == 0.5 ? 0.0 : 0.51, until);
      for (const Duration ahead : kAhead) {
        const std::vector<double> positions = predicted(predictor, ahead).positions;
        const std::vector<double> truth = steady(until + toSeconds(ahead));
        EXPECT_NEAR(positions[0], truth[0], 1e-9) << name;
        EXPECT_NEAR(positions[1], truth[1], 1e-9) << name;
      }
    }
  }
}

TEST(JointPredictorTest, TheLargestDegreeIsThatOfEachJoint) {
  PredictorOptions options = optionsOf("polynomial");
  options.degree = {1, 1, 1, 1, 2, 0};
  JointPredictor predictor(options, {{}});
  const auto parabola = [](double t) { return std::vector<double>{0.2 * t - 0.1 * t * t}; };
  followJoints(predictor, parabola, 0.0, 1.0);
  EXPECT_NEAR(predicted(predictor, milliseconds(500)).positions[0], parabola(1.5)[0], 1e-9);
}

TEST(JointPredictorTest, HoldStaysAndDoubtsIt) {
  JointPredictor predictor(optionsOf("hold"), kBoth);
  followJoints(predictor, steady, 0.0, 5.0);
  const PredictedJoints joints = predicted(predictor, milliseconds(500));
  EXPECT_EQ(joints.positions, steady(5.0));
  EXPECT_NEAR(std::sqrt(joints.variances[0]), 0.4, 0.1) << "half a second at 0.8 rad/s";
}

TEST(JointPredictorTest, AJointStopsAtItsLimits) {
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    JointPredictor predictor(optionsOf(name), {{"", -1.0, 1.0}, sliding(0.0, 0.2)});
    followJoints(
        predictor,
        [](double t) {
          return std::vector<double>{0.5 + 0.4 * t, 0.15 - 0.1 * t};
        },
        0.0, 1.0);
    EXPECT_NEAR(predicted(predictor, milliseconds(200)).positions[0], 0.98, 1e-9) << name;
    EXPECT_EQ(predicted(predictor, milliseconds(1000)).positions[0], 1.0) << name;
    EXPECT_EQ(predicted(predictor, milliseconds(1000)).positions[1], 0.0) << name;
  }
}

struct Course {
  JointVariable joint;
  double start;
  double speed;
};

// Half a second after half a second of steady motion.
double positionAfter(const std::string& name, const Course& course) {
  JointPredictor predictor(optionsOf(name), {course.joint});
  followJoints(
      predictor, [&](double t) { return std::vector<double>{course.start + course.speed * t}; }, 0.0, 0.5);
  return predicted(predictor, milliseconds(500)).positions[0];
}

// Limits of the description that are narrower than those of the arm.
TEST(JointPredictorTest, AJointThatContradictsALimitGoesOnAsIfItHadNone) {
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    EXPECT_NEAR(positionAfter(name, {{"", -1.0, 1.0}, 1.2, 0.4}), 1.6, 1e-9) << name;
    EXPECT_NEAR(positionAfter(name, {{"", 0.0, 0.0}, 0.3, 0.5}), 0.8, 1e-9) << name;
    EXPECT_NEAR(positionAfter(name, {sliding(0.1, 0.2), 0.08, -0.1}), -0.02, 1e-9) << name;
  }
}

TEST(JointPredictorTest, AJointThatIsHardlyBeyondALimitGoesNoFarther) {
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    EXPECT_NEAR(positionAfter(name, {{"", -1.0, 1.0}, 0.8009, 0.4}), 1.0009, 1e-9) << name;
    EXPECT_NEAR(positionAfter(name, {{"", 0.0, 0.0}, -0.2491, 0.5}), 0.0009, 1e-9) << name;
    EXPECT_NEAR(positionAfter(name, {sliding(0.1, 0.2), 0.1491, -0.1}), 0.0991, 1e-9) << name;
  }
}

TEST(JointPredictorTest, AJointThatIsBeyondALimitMayReturnAndStopsAtTheOther) {
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    EXPECT_NEAR(positionAfter(name, {{"", -1.0, 1.0}, 1.4, -0.4}), 1.0, 1e-9) << name;
    EXPECT_NEAR(positionAfter(name, {{"", -0.1, 0.1}, 0.9, -1.4}), -0.1, 1e-9) << name;
    EXPECT_NEAR(positionAfter(name, {sliding(0.1, 0.2), 0.05, 0.05}), 0.1, 1e-9) << name;
  }
}

TEST(JointPredictorTest, AContinuousJointGoesOnWhereItsPositionsWrap) {
  const auto turning = [](double t) { return std::vector<double>{std::remainder(3.0 * t, 2.0 * M_PI)}; };
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    JointPredictor predictor(optionsOf(name), {{"", -kUnlimited, kUnlimited, /*continuous=*/true}});
    followJoints(predictor, turning, 0.0, 0.3);
    for (int i = 31; i < 500; ++i) {
      observe(predictor, 0.01 * i, turning(0.01 * i));
      const double position = predicted(predictor, milliseconds(500)).positions[0];
      ASSERT_NEAR(position - turning(0.01 * i)[0], 1.5, 1e-6) << name << " at " << 0.01 * i << " s";
    }
  }
}

TEST(JointPredictorTest, ATurnOfAJointWithLimitsIsNotAWrap) {
  JointPredictor predictor(optionsOf("constant_velocity"), {{"", -4.0, 4.0}});
  observe(predictor, 0.0, {3.1});
  observe(predictor, 0.01, {3.1});
  observe(predictor, 0.02, {-3.1});
  EXPECT_FALSE(predictor.knowsMotion()) << "a jump";
}

TEST(JointPredictorTest, BeginsAnewAfterAGapAJumpOrARestart) {
  for (const std::string& name : predictorNames()) {
    JointPredictor predictor(optionsOf(name), kBoth);
    EXPECT_FALSE(predictor.knowsMotion());
    observe(predictor, 0.0, steady(0.0));
    EXPECT_FALSE(predictor.knowsMotion());
    followJoints(predictor, steady, 0.01, 1.0);
    EXPECT_TRUE(predictor.knowsMotion());
    observe(predictor, 3.0, steady(3.0));
    EXPECT_FALSE(predictor.knowsMotion()) << name << ": a gap of 2 s";
    followJoints(predictor, steady, 3.01, 3.1);
    observe(predictor, 3.11, {steady(3.11)[0], 0.3});
    EXPECT_FALSE(predictor.knowsMotion()) << name << ": one joint jumped by 0.14 m";
    followJoints(predictor, steady, 3.12, 3.2);
    predictor.restart();
    observe(predictor, 0.0, steady(0.0));
    EXPECT_FALSE(predictor.knowsMotion()) << name << ": restarted";
  }
}

TEST(JointPredictorTest, IsNeverFasterThanTheLimits) {
  for (const std::string& name : predictorNames()) {
    PredictorOptions options = optionsOf(name);
    options.max_turn_rate = 2.0;
    options.max_speed = 0.5;
    options.degree = {3, 3, 3, 3, 3, 3};
    JointPredictor predictor(options, kBoth);
    const auto rush = [](double t) { return std::vector<double>{1.5 * t * t, 0.4 * t * t}; };
    followJoints(predictor, rush, 0.0, 0.6);
    for (const Duration ahead : kAhead) {
      const std::vector<double> positions = predicted(predictor, ahead).positions;
      EXPECT_LE(std::abs(positions[0] - rush(0.6)[0]), 2.0 * toSeconds(ahead) + 1e-12) << name;
      EXPECT_LE(std::abs(positions[1] - rush(0.6)[1]), 0.5 * toSeconds(ahead) + 1e-12) << name;
    }
  }
}

// More frequencies than a predictor has regressors: what it can learn exactly, its errors show only later.
TEST(JointPredictorTest, ItsVariancesMatchItsErrors) {
  const auto wave = [](double t) {
    double sum = 0.0;
    for (int i = 0; i < 10; ++i) sum += 0.3 * std::sin((1.0 + 0.61 * i) * t + 1.7 * i * i);
    return sum;
  };
  const PositionsAt sway = [&](double t) { return std::vector<double>{wave(t), 0.1 * wave(t + 100.0)}; };
  for (const std::string& name : predictorNames()) {
    JointPredictor predictor(optionsOf(name), kBoth);
    followJoints(predictor, sway, 0.0, 30.0);
    double errors[] = {0.0, 0.0};
    double expected[] = {0.0, 0.0};
    for (int i = 3001; i < 6000; ++i) {
      observe(predictor, 0.01 * i, sway(0.01 * i));
      const PredictedJoints joints = predicted(predictor, milliseconds(500));
      for (size_t joint = 0; joint < 2; ++joint) {
        errors[joint] += std::pow(joints.positions[joint] - sway(0.01 * i + 0.5)[joint], 2);
        expected[joint] += joints.variances[joint];
      }
    }
    for (size_t joint = 0; joint < 2; ++joint) {
      EXPECT_GT(expected[joint], 0.5 * errors[joint]) << name;
      EXPECT_LT(expected[joint], 2.0 * errors[joint]) << name;
    }
  }
}

TEST(JointPredictorTest, AJointThatNeverMovedIsNotInDoubt) {
  JointPredictor predictor(optionsOf("direct"), kBoth);
  followJoints(
      predictor,
      [](double t) {
        return std::vector<double>{std::sin(t), 0.1};
      },
      0.0, 5.0);
  const PredictedJoints joints = predicted(predictor, milliseconds(1000));
  EXPECT_EQ(joints.positions[1], 0.1);
  EXPECT_EQ(joints.variances[1], 0.0);
  EXPECT_GT(joints.variances[0], 0.0);
}

TEST(JointPredictorTest, TheSamePositionsGiveTheSamePrediction) {
  for (const std::string& name : predictorNames()) {
    JointPredictor one(optionsOf(name), kBoth);
    JointPredictor other(optionsOf(name), kBoth);
    Random random(3);
    double t = 0.0;
    std::vector<double> positions = {0.0, 0.0};
    for (int i = 0; i < 2000; ++i) {
      t += random.logUniform(1e-4, 0.3);
      for (double& position : positions) position += random.uniform(-0.01, 0.01);
      observe(one, t, positions);
      observe(other, t, positions);
      if (!one.knowsMotion()) continue;
      const PredictedJoints joints = predicted(one, milliseconds(700));
      ASSERT_EQ(joints.positions, predicted(other, milliseconds(700)).positions) << name;
      ASSERT_EQ(joints.variances, predicted(other, milliseconds(700)).variances) << name;
      ASSERT_GE(joints.variances[0], 0.0);
      ASSERT_TRUE(std::isfinite(joints.positions[0]) && std::isfinite(joints.variances[0]));
    }
  }
}

TEST(JointPredictorTest, RefusesOptionsThatCannotWork) {
  EXPECT_THROW(JointPredictor(optionsOf("oracle"), kBoth), InvalidInput);
  PredictorOptions options;
  options.max_turn_rate = 0.0;
  EXPECT_THROW(JointPredictor(options, kBoth), InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_core
