#include "evaluation/prediction_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "evaluation/motions.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::Duration;

const std::vector<Duration> kHorizons = {milliseconds(100), seconds(1)};

std::vector<ErrorSummary> errorsOf(const std::string& predictor, const std::vector<StampedPose>& poses) {
  const RecordedMotion motion(poses);
  sweep_guard_core::PredictorOptions options;
  options.predictor = predictor;
  const std::vector<size_t> samples = samplesOf(poses, motion, seconds(1), seconds(1));
  return summaries({predictionErrors({poses, motion, samples}, kHorizons, options, [](size_t) {})})[0];
}

TEST(PredictionErrorsTest, AreZeroForConstantVelocityOnSuchAMotion) {
  for (const ErrorSummary& errors : errorsOf("constant_velocity", straightMotion(0.3, milliseconds(10), seconds(4)))) {
    EXPECT_EQ(errors.samples, 201U);
    EXPECT_LT(errors.position_p95, 1e-6);
    EXPECT_LT(errors.rotation_p95, 1e-6);
  }
}

TEST(PredictionErrorsTest, AreTheDisplacementOfTheToolForHold) {
  const std::vector<ErrorSummary> errors = errorsOf("hold", straightMotion(0.3, milliseconds(10), seconds(4)));
  EXPECT_NEAR(errors[0].position_median, 0.03, 1e-6);
  EXPECT_NEAR(errors[1].position_median, 0.3, 1e-6);
  EXPECT_NEAR(errors[1].position_p95, 0.3, 1e-6);
  EXPECT_LT(errors[1].rotation_p95, 1e-6);
}

TEST(PredictionErrorsTest, ReportTheirProgress) {
  const std::vector<StampedPose> poses = straightMotion(0.3, milliseconds(10), seconds(4));
  const RecordedMotion motion(poses);
  size_t done = 0;
  predictionErrors({poses, motion, {}}, kHorizons, {}, [&](size_t count) { done += count; });
  EXPECT_EQ(done, poses.size());
}

TEST(SamplesTest, HaveHistoryAndFutureWithoutAGap) {
  std::vector<StampedPose> poses = straightMotion(0.3, milliseconds(100), seconds(6));
  poses.erase(poses.begin() + 31, poses.begin() + 34);  // from 3.0 to 3.4 s
  const std::vector<size_t> samples = samplesOf(poses, RecordedMotion(poses), seconds(1), milliseconds(500));
  ASSERT_EQ(samples.size(), 16U + 12U);
  EXPECT_EQ(poses[samples[0]].stamp, sweep_guard_core::Time(seconds(1)));
  EXPECT_EQ(poses[samples[15]].stamp, sweep_guard_core::Time(milliseconds(2500)));
  EXPECT_EQ(poses[samples[16]].stamp, sweep_guard_core::Time(milliseconds(4400)));
  EXPECT_EQ(poses[samples[27]].stamp, sweep_guard_core::Time(milliseconds(5500)));
}

TEST(SamplesTest, CountAStampOnce) {
  std::vector<StampedPose> poses = straightMotion(0.3, milliseconds(100), seconds(2));
  poses.insert(poses.begin() + 10, poses[10]);
  EXPECT_EQ(samplesOf(poses, RecordedMotion(poses), seconds(1), seconds(1)), (std::vector<size_t>{10}));
}

TEST(SummariesTest, TakeTheSamplesThatEveryPredictorHas) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const ErrorsAhead first{{1, 2, none, 4}, {1, 2, none, 4}};
  const ErrorsAhead second{{none, 20, 30, 40}, {none, 20, 30, 40}};
  const auto all = summaries({{first}, {second}});
  EXPECT_EQ(all[0][0].samples, 2U);
  EXPECT_EQ(all[0][0].position_median, 3.0);
  EXPECT_EQ(all[1][0].rotation_median, 30.0);
}

TEST(SummariesTest, AreUnknownWithoutSamples) {
  const auto all = summaries({{ErrorsAhead{}}});
  EXPECT_EQ(all[0][0].samples, 0U);
  EXPECT_TRUE(std::isnan(all[0][0].position_median));
}

}  // namespace
}  // namespace sweep_guard_evaluation
