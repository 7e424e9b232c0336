#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "prediction/predictors.h"
#include "sweep_guard/prediction/joint_predictor.h"

namespace sweep_guard_core {
namespace {

constexpr double kPosePeriod = 0.01;  // [s]
constexpr double kDeadTime = 0.07;    // [s]
constexpr double kLag = 0.03;         // [s]

// No operator's motion goes on at constant velocity for long.
double wantedAt(double t) {
  return 0.1 * std::sin(2.0 * t) + 0.04 * std::sin(5.3 * t + 1.0) + 0.02 * std::sin(9.1 * t);
}
double wantedSpeedAt(double t) {
  return 0.2 * std::cos(2.0 * t) + 0.212 * std::cos(5.3 * t + 1.0) + 0.182 * std::cos(9.1 * t);
}

// A robot that follows a coordinate after a dead time and with a lag, in steps of 1 ms.
class Plant {
 public:
  double at(double t) {
    for (; time_ + 5e-4 < t; time_ += 1e-3) position_ += 1e-3 / kLag * (wantedAt(time_ - kDeadTime) - position_);
    return position_;
  }

 private:
  double time_ = -3.0;
  double position_ = wantedAt(-3.0);
};

// Along z, and a turn about it.
Eigen::Isometry3d poseOf(double coordinate) {
  return Eigen::Translation3d(0.3, 0.0, coordinate) * Eigen::AngleAxisd(2.0 * coordinate, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX());
}

SentCommand poseCommand(double t) { return {at(t), poseOf(wantedAt(t))}; }
SentCommand twistCommand(double t) {
  CommandedTwist command;
  command.twist << 0.0, 0.0, wantedSpeedAt(t), 0.0, 0.0, 2.0 * wantedSpeedAt(t);
  return {at(t), command};
}
SentCommand twistOfTool(double t) {
  SentCommand command = twistCommand(t);
  auto& commanded = std::get<CommandedTwist>(command.value);
  const Eigen::Matrix3d R_TW = poseOf(wantedAt(t)).linear().transpose();
  commanded.twist << R_TW * commanded.twist.head<3>(), R_TW * commanded.twist.tail<3>();
  commanded.of_tool = true;
  return command;
}

// Of another tip: it stays 20 mm and 5 degrees away from the one that is measured.
SentCommand poseOfAnotherTip(double t) {
  const Eigen::Isometry3d X_WT = poseOf(wantedAt(t));
  const Eigen::AngleAxisd turn(5.0 / 180.0 * M_PI, Eigen::Vector3d::UnitY());
  return {at(t), Eigen::Translation3d(0.012, 0.0, 0.016) * X_WT * turn};
}

using CommandAt = std::function<SentCommand(double)>;

PosePredictor toldUntil(double end, const CommandAt& command) {
  PosePredictor predictor(optionsOf("direct"));
  Plant plant;
  for (int i = 0; i * kPosePeriod < end; ++i) {
    if (command) predictor.command(command(i * kPosePeriod));
    predictor.observe({at(i * kPosePeriod), poseOf(plant.at(i * kPosePeriod))});
  }
  return predictor;
}

// Mean distance of a tool point from where it is so long after each pose from second 20 on [m].
double meanError(double ahead, const CommandAt& command) {
  PosePredictor predictor(optionsOf("direct"));
  const Eigen::Vector3d point(0.0, 0.1, 0.0);
  Plant plant;
  Plant later;
  PredictedPath path;
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 3000; ++i) {
    if (command) predictor.command(command(i * kPosePeriod));
    predictor.observe({at(i * kPosePeriod), poseOf(plant.at(i * kPosePeriod))});
    const Eigen::Vector3d then = poseOf(later.at(i * kPosePeriod + ahead)) * point;
    predictor.predict({fromSeconds(ahead)}, path);
    if (i < 2000) continue;
    sum += (path.front().X_WT * point - then).norm();
    ++count;
  }
  return sum / count;
}

TEST(CommandedMotionTest, ThePoseSentIsWhereTheToolWillBeAfterDeadTimeAndLag) {
  EXPECT_LT(meanError(0.1, poseCommand), 0.15 * meanError(0.1, {}));
  EXPECT_LT(meanError(0.2, poseCommand), 0.6 * meanError(0.2, {}));
}

TEST(CommandedMotionTest, ADistanceThatStaysBetweenPosesSentAndMeasuredIsNoMotion) {
  for (const double ahead : {0.1, 0.5})
    EXPECT_LT(meanError(ahead, poseOfAnotherTip), 1.03 * meanError(ahead, poseCommand));
}

TEST(CommandedMotionTest, ATwistSentIsHowItWillMove) {
  EXPECT_LT(meanError(0.1, twistCommand), 0.4 * meanError(0.1, {}));
  EXPECT_NEAR(meanError(0.1, twistOfTool), meanError(0.1, twistCommand), 1e-4);
}

TEST(CommandedMotionTest, TheCovarianceIsThatOfItsOwnErrors) {
  PredictedPath told;
  PredictedPath measured;
  toldUntil(40.0, poseCommand).predict({fromSeconds(0.1)}, told);
  toldUntil(40.0, {}).predict({fromSeconds(0.1)}, measured);
  const auto variance = [](const PredictedPath& path) { return path.front().covariance.topLeftCorner<3, 3>().trace(); };
  EXPECT_LT(variance(told), 0.1 * variance(measured));
}

TEST(CommandedMotionTest, CountsOnceCommandsHaveComeForASecond) {
  EXPECT_FALSE(toldUntil(0.9, poseCommand).usesCommand());
  EXPECT_TRUE(toldUntil(1.1, poseCommand).usesCommand());
  EXPECT_FALSE(toldUntil(5.0, {}).usesCommand());
}

TEST(CommandedMotionTest, ItMayComeMoreSeldomThanThePoses) {
  const auto at_5_hz = [](double t) {
    return std::lround(t / kPosePeriod) % 20 == 0 ? poseCommand(t) : SentCommand{at(t), CommandedJoints{}};
  };
  EXPECT_TRUE(toldUntil(5.0, at_5_hz).usesCommand());
}

TEST(CommandedMotionTest, SilentForThreePeriodsItIsForgottenForASecond) {
  const auto until_5 = [](double t) { return t < 5.0 ? poseCommand(t) : SentCommand{at(t), CommandedJoints{}}; };
  EXPECT_TRUE(toldUntil(5.025, until_5).usesCommand());
  EXPECT_FALSE(toldUntil(5.045, until_5).usesCommand());
  const auto paused = [](double t) {
    return t < 5.0 || t > 5.1 ? poseCommand(t) : SentCommand{at(t), CommandedJoints{}};
  };
  EXPECT_FALSE(toldUntil(6.05, paused).usesCommand());
  EXPECT_TRUE(toldUntil(6.2, paused).usesCommand());
}

TEST(CommandedMotionTest, OnceForgottenThePredictionIsAsIfNothingHadBeenSent) {
  const auto until_5 = [](double t) { return t < 5.0 ? poseCommand(t) : SentCommand{at(t), CommandedJoints{}}; };
  PredictedPath told;
  PredictedPath measured;
  toldUntil(6.0, until_5).predict(kAhead, told);
  toldUntil(6.0, {}).predict(kAhead, measured);
  for (size_t i = 0; i < kAhead.size(); ++i) {
    EXPECT_EQ(told[i].X_WT.matrix(), measured[i].X_WT.matrix());
    EXPECT_EQ(told[i].covariance, measured[i].covariance);
  }
}

TEST(CommandedMotionTest, ARobotThatDoesNotDoWhatWasSentEndsItAtOnce) {
  PosePredictor predictor(optionsOf("direct"));
  Plant plant;
  double stopped = 0.0;
  for (int i = 0; i < 1025; ++i) {
    const double t = i * kPosePeriod;
    predictor.command(poseCommand(t));
    if (t < 10.0) stopped = plant.at(t);
    predictor.observe({at(t), poseOf(stopped)});
    EXPECT_TRUE(i != 999 || predictor.usesCommand());
  }
  EXPECT_FALSE(predictor.usesCommand());
}

TEST(CommandedMotionTest, NoOtherPredictorHearsOfIt) {
  PosePredictor predictor(optionsOf("constant_velocity"));
  for (int i = 0; i < 300; ++i) {
    predictor.command(poseCommand(i * kPosePeriod));
    predictor.observe({at(i * kPosePeriod), poseOf(wantedAt(i * kPosePeriod))});
  }
  EXPECT_FALSE(predictor.usesCommand());
}

TEST(CommandedMotionTest, VelocitiesSentPredictTheJointsTheyAreFor) {
  JointPredictor told(optionsOf("direct"), {{"first"}, {"second"}});
  JointPredictor measured(optionsOf("direct"), {{"first"}, {"second"}});
  Plant plant;
  for (int i = 0; i < 2000; ++i) {
    const double t = i * kPosePeriod;
    told.command({at(t), CommandedJoints{{wantedSpeedAt(t), std::numeric_limits<double>::quiet_NaN()}}});
    for (JointPredictor* const predictor : {&told, &measured}) predictor->observe(at(t), {plant.at(t), plant.at(t)});
  }
  EXPECT_TRUE(told.usesCommand());
  PredictedJoints with;
  PredictedJoints without;
  told.predict(fromSeconds(0.1), with);
  measured.predict(fromSeconds(0.1), without);
  EXPECT_LT(with.variances[0], 0.3 * without.variances[0]);
  EXPECT_EQ(with.positions[1], without.positions[1]);
}

}  // namespace
}  // namespace sweep_guard_core
