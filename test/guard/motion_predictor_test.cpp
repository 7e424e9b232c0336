#include "sweep_guard/guard/motion_predictor.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>

#include "guard/times.h"
#include "guard/two_links.h"
#include "kinematics/random_robot.h"
#include "prediction/motion_space.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

std::shared_ptr<const Robot> robotWith(KinematicTree tree) {
  std::vector<std::pair<size_t, std::vector<ConvexPiece>>> pieces;
  for (size_t link = 0; link < tree.links().size(); ++link)
    pieces.push_back({link, {{"link", ConvexShape::sphere(0.02)}}});
  return std::make_shared<const Robot>(robotOf(std::move(tree), pieces));
}

PoseWithFrames poseAt(const Robot& robot, double seconds, const RobotState& state) {
  PoseWithFrames pose{atSecond(1000.0 + seconds), {}, state.X_WR};
  std::vector<Eigen::Isometry3d> X_WB;
  bodyPoses(robot.tree, robot.bodies, state, X_WB);
  pose.bodies.clear();
  for (const Eigen::Isometry3d& X : X_WB) pose.bodies.push_back({X});
  pose.state = state;
  return pose;
}

Horizon horizonNow() {
  Horizon horizon;
  computeHorizon({}, {}, horizon);
  return horizon;
}

using StateAt = std::function<RobotState(double)>;

PredictedMotion predicted(MotionPredictor& predictor, const Robot& robot, const StateAt& truth, double until) {
  PredictedMotion motion;
  for (double t = 0.0; t < until + 1e-9; t += 0.01) {
    motion.from = poseAt(robot, t, truth(t));
    predictor.observe(motion.from);
  }
  predictor.predict(horizonNow(), motion);
  return motion;
}

// The sum of twelve uniform numbers is nearly normal.
double normal(Random& random) {
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) sum += random.uniform(-0.5, 0.5);
  return sum;
}

PredictorOptions optionsOf(const std::string& name) {
  PredictorOptions options;
  options.predictor = name;
  return options;
}

std::vector<JointVariable> jointsOf(const KinematicTree& tree) {
  std::vector<JointVariable> joints(tree.variables().size());
  for (const TreeLink& link : tree.links()) {
    const bool mimics = link.joint != tree.variables()[link.variable].name;
    if (link.type == JointType::kPrismatic && !mimics) joints[link.variable].turns = false;
  }
  return joints;
}

// The root moves as well.
TEST(MotionPredictorTest, BodiesOfJointsAtConstantSpeedArePredictedExactly) {
  Random random(/*seed=*/5);
  for (const char* name : {"constant_velocity", "polynomial", "direct"}) {
    const auto robot = robotWith(randomRobot(random, 6, /*branches=*/true));
    const RobotState start = randomState(random, robot->tree, 1.0);
    std::vector<double> speeds;
    for (size_t i = 0; i < start.positions.size(); ++i) speeds.push_back(random.uniform(-0.5, 0.5));
    const StateAt truth = [&](double t) {
      RobotState state = start;
      state.X_WR =
          Eigen::Translation3d(0.05 * t, 0.0, 0.0) * start.X_WR * Eigen::AngleAxisd(0.2 * t, Eigen::Vector3d::UnitY());
      for (size_t i = 0; i < speeds.size(); ++i) state.positions[i] += speeds[i] * t;
      return state;
    };
    MotionPredictor predictor(optionsOf(name), robot);
    const PredictedMotion motion = predicted(predictor, *robot, truth, 0.5);
    ASSERT_EQ(motion.body_paths.size(), robot->bodies.size());
    for (size_t i = 0; i < motion.path.size(); ++i) {
      const PoseWithFrames then = poseAt(*robot, 0.0, truth(0.5 + toSeconds(motion.path[i].ahead)));
      for (size_t body = 0; body < then.bodies.size(); ++body) {
        EXPECT_EQ(motion.body_paths[body][i].ahead, motion.path[i].ahead);
        EXPECT_LT(displacement(motion.body_paths[body][i].X_WT, then.bodies[body].X_WB).norm(), 1e-8) << name;
      }
    }
  }
}

// A link of which only the pose were predicted would go on through its limit.
TEST(MotionPredictorTest, BodiesStopWhereTheirJointsDo) {
  const auto robot = planarArm({"elbow", -2.0, 0.5}).robot();
  MotionPredictor predictor(optionsOf("constant_velocity"), robot);
  const auto bends = [](double t) { return RobotState{Eigen::Isometry3d::Identity(), {0.0, 0.1 + 0.6 * t}}; };
  const PredictedMotion motion = predicted(predictor, *robot, bends, 0.5);
  const PoseWithFrames stopped = poseAt(*robot, 0.0, {Eigen::Isometry3d::Identity(), {0.0, 0.5}});
  EXPECT_LT(displacement(motion.body_paths[1].back().X_WT, stopped.bodies[1].X_WB).norm(), 1e-9);
}

TEST(MotionPredictorTest, TheJointsOfARobotMayCountTheirTurnsAnew) {
  const auto robot = planarArm({"elbow", -INFINITY, INFINITY, /*continuous=*/true}).robot();
  MotionPredictor predictor(optionsOf("direct"), robot);
  const auto turns = [](double t) {
    return RobotState{Eigen::Isometry3d::Identity(), {0.0, std::remainder(2.0 * t, 2.0 * M_PI)}};
  };
  const PredictedMotion motion = predicted(predictor, *robot, turns, 4.0);
  const PoseWithFrames then = poseAt(*robot, 0.0, turns(4.0 + toSeconds(motion.path.back().ahead)));
  EXPECT_LT(displacement(motion.body_paths[1].back().X_WT, then.bodies[1].X_WB).norm(), 1e-6);
}

// Of errors of joints and root with the predicted variances, pushed through the exact kinematics.
TEST(MotionPredictorTest, ItsCovariancesAreThoseOfErrorsOfJointsAndRoot) {
  Random random(/*seed=*/11);
  for (int i = 0; i < 6; ++i) {
    const auto robot = robotWith(randomRobot(random, 5, /*branches=*/false));
    const RobotState start = randomState(random, robot->tree, 1.0);
    const double swing = i < 3 ? 0.02 : 0.3;  // [rad or m]: small errors, and errors whose arcs count
    const StateAt truth = [&](double t) {
      RobotState state = start;
      state.X_WR = Eigen::Translation3d(0.3 * swing * std::sin(5.0 * t), 0.0, 0.0) * start.X_WR *
                   Eigen::AngleAxisd(0.3 * swing * std::sin(6.0 * t), Eigen::Vector3d::UnitX());
      for (size_t k = 0; k < start.positions.size(); ++k)
        state.positions[k] += swing * std::sin((4.0 + static_cast<double>(k)) * t);
      return state;
    };
    MotionPredictor predictor(optionsOf("hold"), robot);
    const PredictedMotion motion = predicted(predictor, *robot, truth, 10.0);
    JointPredictor joints(optionsOf("hold"), jointsOf(robot->tree));
    for (double t = 0.0; t < 10.0 + 1e-9; t += 0.01) joints.observe(atSecond(1000.0 + t), truth(t).positions);
    const PredictedPose& root = motion.path.back();
    PredictedJoints expected;
    joints.predict(root.ahead, expected);

    const Eigen::Matrix<double, 6, 6> root_deviation =
        Eigen::LLT<Matrix6d>(root.covariance + 1e-18 * Matrix6d::Identity()).matrixL();
    std::vector<Matrix6d> sums(robot->bodies.size(), Matrix6d::Zero());
    constexpr int kSamples = 4000;
    for (int sample = 0; sample < kSamples; ++sample) {
      RobotState off = motion.from.state;
      Vector6d error;
      for (double& axis : error) axis = normal(random);
      error = root_deviation * error;
      off.X_WR.translation() += error.head<3>();
      off.X_WR.linear() = Eigen::AngleAxisd(error.tail<3>().norm(), error.tail<3>().normalized()) * off.X_WR.linear();
      for (size_t k = 0; k < off.positions.size(); ++k)
        off.positions[k] += std::sqrt(expected.variances[k]) * normal(random);
      std::vector<Eigen::Isometry3d> X_WB;
      bodyPoses(robot->tree, robot->bodies, off, X_WB);
      for (size_t body = 0; body < X_WB.size(); ++body) {
        const Eigen::Isometry3d& X = motion.body_paths[body].back().X_WT;
        const Eigen::AngleAxisd turn_W(X_WB[body].linear() * X.linear().transpose());
        Vector6d moved;
        moved << X_WB[body].translation() - X.translation(), turn_W.angle() * turn_W.axis();
        sums[body] += moved * moved.transpose();
      }
    }
    for (size_t body = 0; body < sums.size(); ++body) {
      const Matrix6d found = sums[body] / kSamples;
      const Matrix6d& covariance = motion.body_paths[body].back().covariance;
      const double tolerance = i < 3 ? 0.1 : 0.35;
      EXPECT_LT((covariance - found).norm(), tolerance * found.norm()) << "robot " << i << ", body " << body;
      EXPECT_EQ(Eigen::LLT<Matrix6d>(covariance + 1e-12 * Matrix6d::Identity()).info(), Eigen::Success)
          << "robot " << i << ", body " << body;
    }
  }
}

// Both joints at 3 rad/s: in 0.1 s, the end of the arm leaves its chord by 3 cm. In a step that was cut, no point leaves
// the Motion of its body by more than is said.
TEST(MotionPredictorTest, StepsInWhichABodyLeavesItsMotionAreCutAndSaySo) {
  const auto robot = planarArm().robot();
  MotionPredictor predictor(optionsOf("constant_velocity"), robot);
  const StateAt truth = [](double t) { return RobotState{Eigen::Isometry3d::Identity(), {3.0 * t, 3.0 * t}}; };
  const PredictedMotion motion = predicted(predictor, *robot, truth, 0.5);
  EXPECT_GT(motion.path.size(), horizonNow().ends.size());
  EXPECT_EQ(motion.path[motion.reflex_sweeps - 1].ahead, milliseconds(100));
  double largest = 0.0;
  for (size_t body = 0; body < 2; ++body) {
    PredictedPose before{{}, motion.from.bodies[body].X_WB};
    for (const PredictedPose& pose : motion.body_paths[body]) {
      const Motion step{before.X_WT, pose.X_WT};
      for (double share = 0.1; share < 0.95; share += 0.1) {
        const double t = 0.5 + (1.0 - share) * toSeconds(before.ahead) + share * toSeconds(pose.ahead);
        const Eigen::Isometry3d X_WB = poseAt(*robot, 0.0, truth(t)).bodies[body].X_WB;
        const Eigen::Vector3d end_B(0.4, 0.0, 0.0);
        const double deviation = (X_WB * end_B - step.at(share) * end_B).norm();
        EXPECT_LE(deviation, pose.deviation_bound + 1e-9);
        largest = std::max(largest, deviation);
      }
      EXPECT_LE(pose.deviation_bound, pose.ahead <= milliseconds(100) ? 5e-4 : 5e-3);
      before = pose;
    }
  }
  EXPECT_GT(largest, 1e-4);
}

// The elbow turns back after 0.3 s, which nothing measured tells.
TEST(MotionPredictorTest, ATrajectoryUnderWayIsPredictedInStepsOf20Milliseconds) {
  const auto robot = planarArm().robot();
  const StateAt truth = [](double t) {
    return RobotState{Eigen::Isometry3d::Identity(), {0.0, t < 0.8 ? t : 1.6 - t}};
  };
  const TrajectoryPlan plan{
      {"elbow"}, {{{}, {0.0}}, {milliseconds(800), {0.8}}, {milliseconds(1600), {0.0}}, {milliseconds(2600), {-1.0}}}};
  MotionPredictor predictor(optionsOf("constant_velocity"), robot);
  PredictedMotion motion = predicted(predictor, *robot, truth, 0.5);
  EXPECT_EQ(motion.source, PredictionSource::kMeasured);
  const double measured_variance = motion.body_paths[1].back().covariance.trace();
  motion.trajectory = std::make_shared<const JointTrajectory>(robot->tree, JointsBesideTree(), plan, atSecond(1000.0),
                                                              motion.from.state.positions);
  predictor.predict(horizonNow(), motion);
  EXPECT_EQ(motion.source, PredictionSource::kTrajectory);
  Duration before{};
  for (size_t i = 0; i < motion.path.size(); ++i) {
    const PredictedPose& pose = motion.body_paths[1][i];
    const PoseWithFrames then = poseAt(*robot, 0.0, truth(0.5 + toSeconds(pose.ahead)));
    EXPECT_LT(displacement(pose.X_WT, then.bodies[1].X_WB).norm(), 1e-6) << toSeconds(pose.ahead);
    EXPECT_LE(pose.ahead - before, kTrajectoryStep);
    before = pose.ahead;
  }
  EXPECT_LT(motion.body_paths[1].back().covariance.trace(), 0.1 * measured_variance);
}

TEST(MotionPredictorTest, ARobotThatLeavesItsTrajectoryIsPredictedAsMeasured) {
  const auto robot = planarArm().robot();
  const StateAt rests = [](double) { return RobotState{Eigen::Isometry3d::Identity(), {0.0, 0.0}}; };
  MotionPredictor predictor(optionsOf("constant_velocity"), robot);
  PredictedMotion motion = predicted(predictor, *robot, rests, 0.5);
  motion.trajectory = std::make_shared<const JointTrajectory>(
      robot->tree, JointsBesideTree(), TrajectoryPlan{{"elbow"}, {{{}, {0.0}}, {milliseconds(1000), {1.0}}}},
      atSecond(1000.0), motion.from.state.positions);
  predictor.predict(horizonNow(), motion);
  EXPECT_EQ(motion.source, PredictionSource::kMeasured);
  EXPECT_LT(displacement(motion.body_paths[1].back().X_WT, motion.from.bodies[1].X_WB).norm(), 1e-9);
}

TEST(MotionPredictorTest, AllPathsAreEmptyUntilTheMotionOfEveryJointIsKnown) {
  const auto robot = planarArm().robot();
  MotionPredictor predictor({}, robot);
  PredictedMotion motion;
  motion.from = poseAt(*robot, 0.0, {Eigen::Isometry3d::Identity(), {0.0, 0.0}});
  predictor.observe(motion.from);
  predictor.predict(horizonNow(), motion);
  EXPECT_TRUE(motion.path.empty());
  ASSERT_EQ(motion.body_paths.size(), 2U);
  EXPECT_TRUE(motion.body_paths[0].empty());
  predictor.observe(poseAt(*robot, 0.01, {Eigen::Isometry3d::Identity(), {0.0, 0.0}}));
  motion.from = poseAt(*robot, 0.02, {Eigen::Isometry3d::Identity(), {0.0, 2.0}});
  predictor.observe(motion.from);
  predictor.predict(horizonNow(), motion);
  EXPECT_TRUE(motion.path.empty()) << "the elbow jumped";
  EXPECT_TRUE(motion.body_paths[1].empty());
}

TEST(MotionPredictorTest, TheSamePosesGiveTheSamePaths) {
  Random random(/*seed=*/7);
  const auto robot = robotWith(randomRobot(random, 5, /*branches=*/true));
  const RobotState start = randomState(random, robot->tree, 1.0);
  const StateAt truth = [&](double t) {
    RobotState state = start;
    for (size_t i = 0; i < start.positions.size(); ++i)
      state.positions[i] += std::sin((1.0 + 0.3 * static_cast<double>(i)) * t);
    return state;
  };
  for (const std::string& name : predictorNames()) {
    MotionPredictor one(optionsOf(name), robot);
    MotionPredictor other(optionsOf(name), robot);
    const PredictedMotion first = predicted(one, *robot, truth, 3.0);
    const PredictedMotion second = predicted(other, *robot, truth, 3.0);
    for (size_t body = 0; body < robot->bodies.size(); ++body) {
      for (size_t i = 0; i < first.path.size(); ++i) {
        ASSERT_EQ(first.body_paths[body][i].X_WT.matrix(), second.body_paths[body][i].X_WT.matrix()) << name;
        ASSERT_EQ(first.body_paths[body][i].covariance, second.body_paths[body][i].covariance) << name;
      }
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core
