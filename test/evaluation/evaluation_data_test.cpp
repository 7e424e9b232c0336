#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "data_path.h"
#include "evaluation/evaluate.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_recording::Recording;
using Field = double ErrorSummary::*;

constexpr const char* kSlowRecording = "handheld_stylus_15hz";

/// Recorded hands and a recorded robot arm, which are no part of the repository.
class EvaluationDataTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path data = dataPath("motion");
    if (!std::filesystem::exists(data)) GTEST_SKIP() << missing(data);
    std::vector<std::string> words = {"evaluate_prediction"};
    for (const auto& entry : std::filesystem::directory_iterator(data)) {
      if (entry.path().extension() == ".txt") words.push_back(entry.path());
    }
    std::vector<const char*> arguments;
    arguments.reserve(words.size());
    for (const std::string& word : words) arguments.push_back(word.c_str());
    options_ = parseOptions(static_cast<int>(arguments.size()), arguments.data());
    for (const std::string& file : options_.files) {
      recordings_.push_back(sweep_guard_recording::readRecording(file, ""));
    }
    ASSERT_GE(recordings_.size(), 5U);
  }

  Options options_;
  std::vector<Recording> recordings_;
};

/// Error of `direct` over that of the better of `hold` and `constant_velocity`.
double ratio(const ErrorReport& report, size_t horizon, Field field) {
  const auto of = [&](const char* name) {
    const auto found = std::find(report.predictors.begin(), report.predictors.end(), name);
    return report.errors.at(static_cast<size_t>(found - report.predictors.begin())).at(horizon).*field;
  };
  return of("direct") / std::min(of("hold"), of("constant_velocity"));
}

/// Largest ratio that is allowed: 1, but for the fastest rotations of the slow recording. It begins with the fastest of
/// them, before anything is learned.
double allowed(const ErrorReport& report, size_t horizon, Field field) {
  const bool tail = report.recording == kSlowRecording && field == &ErrorSummary::rotation_p95;
  if (!tail || report.horizons.at(horizon) < std::chrono::milliseconds(500)) return 1.0;
  return report.horizons.at(horizon) < std::chrono::seconds(1) ? 1.1 : 1.25;
}

TEST_F(EvaluationDataTest, TheDefaultPredictorIsAheadOfHoldingAndOfConstantVelocity) {
  options_.predictors = {"hold", "constant_velocity", "direct"};
  double sum = 0.0;
  int ratios = 0;
  for (const ErrorReport& report : reportErrors(recordings_, options_, [](size_t) {})) {
    for (size_t horizon = 0; horizon < report.horizons.size(); ++horizon) {
      for (const Field field : {&ErrorSummary::position_median, &ErrorSummary::position_p95,
                                &ErrorSummary::rotation_median, &ErrorSummary::rotation_p95}) {
        const double found = ratio(report, horizon, field);
        EXPECT_LE(found, allowed(report, horizon, field)) << report.recording << ' ' << horizon;
        sum += found;
        ++ratios;
      }
    }
  }
  EXPECT_LE(sum / ratios, 0.82);
}

TEST_F(EvaluationDataTest, EveryContactIsWarnedOfByTheReflexWarning) {
  options_.predictors = {"direct"};
  options_.placements = 10;
  for (const WarningReport& report : reportWarnings(recordings_, options_, [](size_t) {})) {
    const AlarmStatistics& reflex = report.statistics[0][report.chosen][0];
    EXPECT_EQ(reflex.contacts, 5U) << report.recording;
    EXPECT_EQ(reflex.leads.size(), reflex.contacts) << report.recording;
  }
}

}  // namespace
}  // namespace sweep_guard_evaluation
