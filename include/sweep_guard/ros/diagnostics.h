#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <mutex>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/ros/mesh_input.h"
#include "sweep_guard/ros/parameters.h"
#include "sweep_guard/ros/pose_input.h"
#include "sweep_guard/ros/tuning.h"
#include "sweep_guard/ros/workpiece_store.h"

namespace sweep_guard_ros {

/// What the worker did since it was last asked. Any thread.
class Workload {
 public:
  /// One look ahead.
  struct Prediction {
    sweep_guard::Duration latency{};  ///< pose received to warning sent
    sweep_guard::Duration time{};     ///< taken by the prediction and its sweeps
    size_t sweeps_made = 0;           ///< 0: the motion is not known yet
    size_t sweeps_asked = 0;          ///< of the configured steps
    sweep_guard::Duration covered{};  ///< from the moment of the prediction on
    double probability = 0.0;         ///< of a contact, in [0, 1]
  };
  struct Summary {
    std::uint64_t sweeps_total = 0;            ///< poses swept since the start
    std::uint64_t late_total = 0;              ///< of them later than a cycle
    std::uint64_t predictions_total = 0;       ///< looks ahead since the start
    std::uint64_t late_predictions_total = 0;  ///< of them later than a cycle
    std::uint64_t faults_total = 0;            ///< failures of the detector
    std::string last_fault;                    ///< empty: none
    std::vector<double> latencies;             ///< pose received to warning sent, since the last summary [s], ascending
    double busiest = 0.0;                      ///< longest sweep since the last summary [s]
    std::vector<double> prediction_times;      ///< of the looks ahead since the last summary [s], ascending
    bool coarser = false;                      ///< some of them made fewer sweeps than asked for
    Prediction prediction;                     ///< the newest
  };

  /// @param cycle  a pose whose warning takes longer is late [P, Sec. 3.2]
  explicit Workload(sweep_guard::Duration cycle) : cycle_(cycle) {}

  void setCycle(sweep_guard::Duration cycle);
  void swept(sweep_guard::Duration latency, sweep_guard::Duration sweep_time);
  void predicted(const Prediction& prediction);
  void failed(const std::string& why);  ///< the detector
  Summary take();
  void restart();  ///< counts from 0

 private:
  std::mutex mutex_;
  sweep_guard::Duration cycle_;
  Summary summary_;
};

/// What the diagnostics look at.
struct Diagnosed {
  const LiveParameters& parameters;
  const PoseInput& poses;
  const MeshInput& meshes;
  const WorkpieceStore& workpieces;
  const sweep_guard::Ledger& ledger;
  Workload& workload;
  const Tuning& tuning;
};

/// Events per second since it was last asked.
class RateMeter {
 public:
  double operator()(std::uint64_t count);

 private:
  std::uint64_t count_ = 0;
  sweep_guard::SteadyTime asked_ = std::chrono::steady_clock::now();
};

/// Answers "why is there no warning" on /diagnostics: the verdict; of each input its source, publishers, rate, age and
/// last error; the workpieces; the detector and its deadlines; the prediction; what was changed since the start;
/// memory.
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const Diagnosed& parts);

  /// Publishes now; call once a second.
  void publish();

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// Of one input, since the last period.
  struct Meter {
    RateMeter received;
    RateMeter refused;
  };
  struct Input {
    std::string source;
    std::optional<std::uint32_t> publishers;  // empty: it has none
    InputRecord::Summary record;
    bool goes_on;  // its silence is an error
  };

  void verdict(Status& status) const;
  void pose(Status& status);
  void mesh(Status& status);
  void vertices(Status& status);
  void input(Status& status, const Input& input, Meter& meter) const;
  void workpieces(Status& status) const;
  void detector(Status& status) const;
  void prediction(Status& status) const;
  void parameters(Status& status) const;
  void process(Status& status) const;

  const Diagnosed parts_;
  Meter poses_;
  Meter meshes_;
  Meter vertices_;
  Workload::Summary load_;  // of the last period
  diagnostic_updater::Updater updater_;
};

}  // namespace sweep_guard_ros
