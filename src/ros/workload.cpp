#include "sweep_guard/ros/workload.h"

#include <algorithm>

namespace sweep_guard_ros {
namespace {

using sweep_guard::toSeconds;

constexpr size_t kTimesKept = 10000;

}  // namespace

void Workload::setCycle(sweep_guard::Duration cycle) {
  const std::lock_guard lock(mutex_);
  cycle_ = cycle;
}

void Workload::failed(const std::string& why) {
  const std::lock_guard lock(mutex_);
  ++summary_.faults_total;
  ++summary_.faults;
  summary_.last_fault = why;
}

void Workload::swept(sweep_guard::Duration latency, sweep_guard::Duration sweep_time) {
  const std::lock_guard lock(mutex_);
  ++summary_.sweeps_total;
  if (latency > cycle_) ++summary_.late_total;
  if (summary_.latencies.size() < kTimesKept) summary_.latencies.push_back(toSeconds(latency));
  summary_.busiest = std::max(summary_.busiest, toSeconds(sweep_time));
}

void Workload::predicted(const Prediction& prediction) {
  const std::lock_guard lock(mutex_);
  ++summary_.predictions_total;
  if (prediction.latency > cycle_) ++summary_.late_predictions_total;
  if (summary_.prediction_times.size() < kTimesKept) summary_.prediction_times.push_back(toSeconds(prediction.time));
  if (prediction.sweeps_made > 0 && prediction.sweeps_made < prediction.sweeps_asked) summary_.coarser = true;
  summary_.prediction = prediction;
}

Workload::Summary Workload::take() {
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

void Workload::restart() {
  const std::lock_guard lock(mutex_);
  summary_ = {};
}

}  // namespace sweep_guard_ros
