#include "ros/output/sweep_statistics.h"

#include <algorithm>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::toSeconds;

constexpr size_t kTimesKept = 10000;

}  // namespace

void SweepStatistics::setCycle(sweep_guard_core::Duration cycle) {
  const std::lock_guard lock(mutex_);
  cycle_ = cycle;
}

void SweepStatistics::failed(const std::string& why) {
  const std::lock_guard lock(mutex_);
  ++summary_.faults_total;
  ++summary_.faults;
  summary_.last_fault = why;
}

void SweepStatistics::swept(sweep_guard_core::Duration latency, sweep_guard_core::Duration sweep_time) {
  const std::lock_guard lock(mutex_);
  ++summary_.sweeps_total;
  if (latency > cycle_) ++summary_.late_total;
  if (summary_.latencies.size() < kTimesKept) summary_.latencies.push_back(toSeconds(latency));
  summary_.busiest = std::max(summary_.busiest, toSeconds(sweep_time));
}

void SweepStatistics::predicted(const PredictionTiming& prediction) {
  const std::lock_guard lock(mutex_);
  ++summary_.predictions_total;
  if (prediction.latency > cycle_) ++summary_.late_predictions_total;
  if (summary_.prediction_times.size() < kTimesKept) summary_.prediction_times.push_back(toSeconds(prediction.time));
  if (prediction.sweeps_made > 0 && prediction.sweeps_made < prediction.sweeps_asked) summary_.coarser = true;
  summary_.prediction = prediction;
}

SweepStatistics::Summary SweepStatistics::take() {
  const std::lock_guard lock(mutex_);
  Summary taken = summary_;
  summary_.latencies.clear();
  summary_.busiest = 0.0;
  summary_.prediction_times.clear();
  summary_.coarser = false;
  summary_.faults = 0;
  std::sort(taken.latencies.begin(), taken.latencies.end());
  std::sort(taken.prediction_times.begin(), taken.prediction_times.end());
  return taken;
}

void SweepStatistics::restart() {
  const std::lock_guard lock(mutex_);
  summary_ = {};
}

}  // namespace sweep_guard_ros
