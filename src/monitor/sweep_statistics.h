#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_core {

/// Counts sweeps, predictions and detector faults, and keeps their durations. Any thread.
class SweepStatistics {
 public:
  struct PredictionTiming {
    Duration latency{};        ///< from the received pose to the sent warning
    Duration time{};           ///< time taken by the prediction and its sweeps
    size_t sweeps_made = 0;    ///< 0: the motion is not known yet
    size_t sweeps_asked = 0;   ///< number of configured steps
    Duration covered{};        ///< length of the tested path, from the moment of the prediction
    double probability = 0.0;  ///< of contact within the considered interval, in [0, 1]
    PredictionSource source = PredictionSource::kMeasured;
  };
  struct Summary {
    std::uint64_t sweeps_total = 0;            ///< poses swept since the start or restart()
    std::uint64_t late_total = 0;              ///< poses swept later than a cycle
    std::uint64_t predictions_total = 0;       ///< predictions since the start or restart()
    std::uint64_t late_predictions_total = 0;  ///< predictions later than a cycle
    std::uint64_t faults_total = 0;            ///< detector faults since the start or restart()
    std::uint64_t faults = 0;                  ///< detector faults since the last summary
    std::string last_fault;                    ///< empty: none
    std::vector<double> latencies;  ///< first 10000 since the last summary, received pose to warning [s], unordered
    double longest_sweep = 0.0;     ///< since the last summary [s]
    std::vector<double> prediction_times;  ///< since the last summary [s], unordered
    bool coarser = false;                  ///< a prediction made fewer sweeps than configured
    PredictionTiming prediction;           ///< newest prediction
  };

  /// @param cycle  a pose whose warning takes longer is late [P, Sec. 3.2]
  explicit SweepStatistics(Duration cycle) : cycle_(cycle) {}

  void setCycle(Duration cycle);
  /// @param latency  from the received pose to the sent warning
  void swept(Duration latency, Duration sweep_time);
  void predicted(const PredictionTiming& prediction);
  void fault(const std::string& reason);  ///< records a detector fault
  Summary take();                         ///< returns the summary, and begins the next
  void restart();                         ///< resets all counters

 private:
  Mutex mutex_;
  Duration cycle_ GUARDED_BY(mutex_);
  Summary summary_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_core
