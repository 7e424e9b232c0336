#include "evaluation/joint_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::fromSeconds;
using sweep_guard_core::JointType;
using sweep_guard_core::KinematicTree;
using sweep_guard_core::Time;
using sweep_guard_core::TreeLink;

// Two links of half a metre in a plane.
KinematicTree planarArm() {
  std::vector<TreeLink> links(3);
  for (size_t i = 0; i < 3; ++i) {
    links[i].name = i == 0 ? "upper" : i == 1 ? "elbow" : "tip";
    if (i > 0) links[i].parent = i - 1;
    if (i > 0) links[i].X_PJ.translation().x() = 0.5;
    if (i < 2) links[i].type = JointType::kRevolute;
    links[i].variable = i < 2 ? i : 0;
  }
  return {{{"shoulder"}, {"elbow"}}, links};
}

class JointErrorsTest : public testing::Test {
 protected:
  void add(double from, double until, const std::function<std::vector<double>(double)>& positions) {
    for (int i = 0; from + 0.01 * i < until - 1e-9; ++i) {
      const double t = from + 0.01 * i;
      states_.push_back({Time(fromSeconds(100.0 + t)), positions(t)});
    }
  }
  std::vector<JointErrorReport> compare(const std::string& predictor = "constant_velocity") const {
    JointErrorRequest request{tree_, links_, states_, {milliseconds(100), milliseconds(500)}, {}};
    request.predictor.predictor = predictor;
    return compareJointPrediction(request);
  }

  const KinematicTree tree_ = planarArm();
  const std::vector<size_t> links_ = {1, 2};
  std::vector<StampedPositions> states_;
};

// On a circle of half a metre a point that goes on along its tangent is 0.5 * sqrt(1 + a^2 - 2 (cos a + a sin a) + 1) off.
TEST_F(JointErrorsTest, JointsAtConstantSpeedArePredictedExactlyAndLinksAreNot) {
  add(0.0, 5.0, [](double t) { return std::vector<double>{1.5 * t, 0.5}; });
  const std::vector<JointErrorReport> reports = compare();
  ASSERT_EQ(reports.size(), 4U);
  EXPECT_EQ(reports[1].link, "elbow");
  EXPECT_EQ(reports[1].horizon, milliseconds(500));
  EXPECT_LT(reports[1].by_joints.distance(0.9), 1e-9);
  const double turn = 1.5 * 0.5;
  const double off = 0.5 * std::hypot(std::cos(turn) - 1.0, std::sin(turn) - turn);
  EXPECT_NEAR(reports[1].by_pose.distance(0.5), off, 0.02);  // the fitted velocity is that of a moment ago
  EXPECT_EQ(reports[3].link, "tip");
  EXPECT_GT(reports[3].by_pose.distance(0.5), 1.5 * reports[1].by_pose.distance(0.5));
  EXPECT_LT(reports[3].by_joints.width(), reports[3].by_pose.width());
  EXPECT_EQ(reports[0].by_joints.samples(), 150U) << "5 s without 3 s before and half a second after";
}

TEST_F(JointErrorsTest, SamplesHaveNoGapBeforeOrAfterThem) {
  const auto positions = [](double t) { return std::vector<double>{std::sin(t), std::cos(t)}; };
  add(0.0, 5.0, positions);
  add(6.0, 11.0, positions);
  EXPECT_EQ(compare()[0].by_joints.samples(), 300U);
}

TEST_F(JointErrorsTest, TheCalibratedWidthHoldsNineTenthsOfTheErrors) {
  add(0.0, 60.0, [](double t) {
    double sum[] = {0.0, 0.0};
    for (int i = 0; i < 10; ++i) {
      sum[0] += 0.2 * std::sin((1.0 + 0.61 * i) * t + 1.7 * i * i);
      sum[1] += 0.2 * std::sin((1.1 + 0.57 * i) * t + 1.3 * i * i);
    }
    return std::vector<double>{sum[0], sum[1]};
  });
  for (const JointErrorReport& report : compare("hold")) {
    EXPECT_GT(report.by_joints.calibratedWidth(), 0.3 * report.by_joints.width());
    EXPECT_LT(report.by_joints.calibratedWidth(), 3.0 * report.by_joints.width());
  }
}

TEST_F(JointErrorsTest, TheTableHasALineForEachWayToPredict) {
  add(0.0, 4.0, [](double t) { return std::vector<double>{t, 0.5}; });
  const std::string csv = jointErrorCsv("arm", "direct", compare("direct"), /*header=*/true);
  EXPECT_EQ(csv.rfind("recording,predictor,link,horizon_s,by,median_m,p90_m,width_m,calibrated_width_m,samples\n", 0),
            0U);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 9);
  EXPECT_NE(csv.find("\narm,direct,tip,0.5,pose,"), std::string::npos) << csv;
}

}  // namespace
}  // namespace sweep_guard_evaluation
