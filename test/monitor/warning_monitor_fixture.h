#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "guard/cross_check.h"
#include "monitor/warnings.h"
#include "refusal.h"

namespace sweep_guard_core {

using std::chrono::milliseconds;

inline constexpr WarningThresholds kThresholds;

// In standard deviations.
inline constexpr double kMeeting = -1.0;
inline const double kReflexAt = deviationsAt(PredictionInterval::kReflex, kThresholds.reflex);
inline const double kConsideredOnAt = deviationsAt(PredictionInterval::kConsidered, kThresholds.considered_on);
inline const double kConsideredOffAt = deviationsAt(PredictionInterval::kConsidered, kThresholds.considered_off);

inline const WarningLimits kLimits = {milliseconds(100), milliseconds(500), milliseconds(500)};

inline Instant at(int ms) { return {Time(milliseconds(ms)), SteadyTime(milliseconds(ms))}; }
inline Timestamps timestampsAt(int ms) { return {at(ms).stamp, at(ms).steady}; }

inline std::shared_ptr<const Workpiece> workpiece(const std::string& id, int ms, std::uint32_t revision = 1) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, /*is_sheet=*/true);
  return std::make_shared<const Workpiece>(Workpiece{id, revision, at(ms).stamp, at(ms).steady, "table", mesh});
}

inline SweepReport reportOf(const Workpieces& workpieces, const std::vector<std::uint32_t>& in_contact = {}) {
  SweepReport report;
  report.end = at(1000).stamp;
  for (const auto& one : workpieces) report.objects.push_back({one, {}, {}, {in_contact, 0.0, {}, false, in_contact}});
  return report;
}

// From a pose on, 1.1 s ahead in two sweeps.
inline Prediction predictionFrom(const Workpieces& workpieces, int ms) {
  Prediction prediction;
  prediction.stamp = at(ms).stamp;
  prediction.path.resize(2);
  prediction.path[0].ahead = milliseconds(100);
  prediction.path[1].ahead = milliseconds(1100);
  for (const auto& one : workpieces)
    prediction.objects.push_back({one, {{milliseconds(0)}, {milliseconds(100)}}, {}, {}, {}});
  return prediction;
}

// One that meets its first workpiece after so long.
inline Prediction collisionOn(const Workpieces& workpieces, int ms, int after_ms) {
  Prediction prediction = predictionFrom(workpieces, ms);
  prediction.objects[0].sweeps[1] = {milliseconds(after_ms), /*contact=*/true, kMeeting};
  prediction.objects[0].considered = {4};
  return prediction;
}

// One that only may meet its first workpiece after so long.
inline Prediction probableOn(const Workpieces& workpieces, int ms, int after_ms, double deviations) {
  Prediction prediction = predictionFrom(workpieces, ms);
  prediction.objects[0].sweeps[1] = {milliseconds(after_ms), /*contact=*/false, deviations};
  return prediction;
}

/// A monitor of one workpiece that was swept and looked ahead from there. Times are in milliseconds.
class WarningMonitorTest : public testing::Test {
 protected:
  WarningMonitorTest() {
    monitor_.setWorkpieces(workpieces_);
    sweep(reportOf(workpieces_), 1000);
  }

  void sweep(const SweepReport& report, int ms) {
    sweepOnly(report, ms);
    Workpieces tested;
    for (const SweptObject& object : report.objects) tested.push_back(object.workpiece);
    predict(predictionFrom(tested, ms), ms);
  }
  void sweepOnly(SweepReport report, int ms) {
    report.end = at(ms).stamp;
    monitor_.swept(report, timestampsAt(ms), monitor_.checkpoint(), at(ms).steady);
  }
  // The workpiece comes again, and is swept.
  Workpieces refresh(int ms) {
    Workpieces fresh = {workpiece("liver", ms)};
    monitor_.setWorkpieces(fresh);
    sweepOnly(reportOf(fresh), ms);
    return fresh;
  }
  void predict(const Prediction& prediction, int pose_ms) {
    monitor_.predicted(prediction, timestampsAt(pose_ms), monitor_.checkpoint(), at(pose_ms));
  }

  void disagree(const SampledQuery& query, const std::vector<std::uint32_t>& missed) {
    monitor_.detectorsDisagree("detectors disagree", query, missed, at(1000).steady);
  }
  SampledQuery query(bool measured = true) const {
    SampledQuery query;
    query.workpiece = workpieces_[0];
    query.origin = {measured, monitor_.checkpoint().epoch};
    return query;
  }

  WarningLevel levelAt(int ms) const { return warningOf(monitor_, at(ms)).level; }
  std::uint32_t reasonsAt(int ms) const { return warningOf(monitor_, at(ms)).reasons; }

  const Workpieces workpieces_ = {workpiece("liver", 1000)};
  WarningMonitor monitor_{kLimits};
};

}  // namespace sweep_guard_core
