#include "monitor/sweep_statistics.h"

#include <algorithm>

namespace sweep_guard_core {

constexpr size_t kMaxTimes = 10000;

void SweepStatistics::setCycle(Duration cycle) {
  const Lock lock(mutex_);
  cycle_ = cycle;
}

void SweepStatistics::fault(const std::string& reason) {
  const Lock lock(mutex_);
  ++summary_.faults_total;
  ++summary_.faults;
  summary_.last_fault = reason;
}

void SweepStatistics::swept(Duration latency, Duration sweep_time) {
  const Lock lock(mutex_);
  ++summary_.sweeps_total;
  if (latency > cycle_) ++summary_.late_total;
  if (summary_.latencies.size() < kMaxTimes) summary_.latencies.push_back(toSeconds(latency));
  summary_.longest_sweep = std::max(summary_.longest_sweep, toSeconds(sweep_time));
}

void SweepStatistics::predicted(const PredictionTiming& prediction) {
  const Lock lock(mutex_);
  ++summary_.predictions_total;
  if (prediction.latency > cycle_) ++summary_.late_predictions_total;
  if (summary_.prediction_times.size() < kMaxTimes) summary_.prediction_times.push_back(toSeconds(prediction.time));
  if (prediction.sweeps_made > 0 && prediction.sweeps_made < prediction.sweeps_asked) summary_.coarser = true;
  summary_.prediction = prediction;
}

SweepStatistics::Summary SweepStatistics::take() {
  const Lock lock(mutex_);
  Summary taken = summary_;
  summary_.latencies.clear();
  summary_.longest_sweep = 0.0;
  summary_.prediction_times.clear();
  summary_.coarser = false;
  summary_.faults = 0;
  return taken;
}

void SweepStatistics::restart() {
  const Lock lock(mutex_);
  summary_ = {};
}

}  // namespace sweep_guard_core
