#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// What the worker did since it was last asked. Any thread.
class SweepStatistics {
 public:
  /// One look ahead.
  struct PredictionTiming {
    sweep_guard_core::Duration latency{};  ///< pose received to warning sent
    sweep_guard_core::Duration time{};     ///< taken by the prediction and its sweeps
    size_t sweeps_made = 0;                ///< 0: the motion is not known yet
    size_t sweeps_asked = 0;               ///< of the configured steps
    sweep_guard_core::Duration covered{};  ///< from the moment of the prediction on
    double probability = 0.0;              ///< of a contact, in [0, 1]
  };
  struct Summary {
    std::uint64_t sweeps_total = 0;            ///< poses swept since the start, or since restart()
    std::uint64_t late_total = 0;              ///< of them later than a cycle
    std::uint64_t predictions_total = 0;       ///< looks ahead since then
    std::uint64_t late_predictions_total = 0;  ///< of them later than a cycle
    std::uint64_t faults_total = 0;            ///< failures of the detector since then
    std::uint64_t faults = 0;                  ///< of them since the last summary
    std::string last_fault;                    ///< empty: none
    std::vector<double> latencies;             ///< pose received to warning sent, since the last summary [s], ascending
    double busiest = 0.0;                      ///< longest sweep since the last summary [s]
    std::vector<double> prediction_times;      ///< of the looks ahead since the last summary [s], ascending
    bool coarser = false;                      ///< some of them made fewer sweeps than asked for
    PredictionTiming prediction;               ///< the newest
  };

  /// @param cycle  a pose whose warning takes longer is late [P, Sec. 3.2]
  explicit SweepStatistics(sweep_guard_core::Duration cycle) : cycle_(cycle) {}

  void setCycle(sweep_guard_core::Duration cycle);
  void swept(sweep_guard_core::Duration latency, sweep_guard_core::Duration sweep_time);
  void predicted(const PredictionTiming& prediction);
  void failed(const std::string& why);  ///< the detector
  Summary take();
  void restart();  ///< counts from 0

 private:
  std::mutex mutex_;
  sweep_guard_core::Duration cycle_;
  Summary summary_;
};

}  // namespace sweep_guard_ros
