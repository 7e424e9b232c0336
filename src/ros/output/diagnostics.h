#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <optional>
#include <string>

#include "monitor/repeated_positions.h"
#include "monitor/sweep_statistics.h"
#include "ros/guard/guard_state.h"
#include "ros/input/inputs.h"
#include "ros/parameters/reconfigure_server.h"
#include "ros/service/trajectory_watch.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Reports whether the detector works, and keeps up with the poses.
void reportDetector(const sweep_guard_core::SweepStatistics::Summary& statistics, const Parameters& parameters,
                    diagnostic_updater::DiagnosticStatusWrapper& status);

/// Reports what the tool and each of its links are made of.
void reportTool(const Parameters& parameters, diagnostic_updater::DiagnosticStatusWrapper& status);

/// Publishes on /diagnostics the warning, each input (source, publishers, rate, age, last error), the tool, the cameras, the
/// workpieces, which contact is allowed, other tools, the detector and its deadlines, the prediction, the trajectory under way, the time in each
/// stage, the changed parameters, and the memory of the process.
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, GuardState& state, const Inputs& inputs,
              const ReconfigureServer& reconfigure, const TrajectoryWatch& trajectory_watch);

  /// Publishes now. To be called once a second.
  void publish();

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  struct Counts {
    std::uint64_t received = 0;
    std::uint64_t refused = 0;
    sweep_guard_core::SteadyTime time = std::chrono::steady_clock::now();
  };
  struct Input {
    std::string source;
    std::optional<std::uint32_t> publishers;  // empty: not a topic
    sweep_guard_core::InputRecord::Summary record;
    bool continuous;  // silence is an error
  };

  void warning(Status& status) const;
  void pose(Status& status);
  void mesh(Status& status);
  void vertices(Status& status);
  void command(Status& status);
  void input(Status& status, const Input& input, Counts& previous) const;
  void camera(Status& status, const CameraInput& camera, Counts& previous) const;
  void workpieces(Status& status) const;
  void allowed(Status& status) const;
  void otherTools(Status& status) const;
  void detector(Status& status) const;
  void prediction(Status& status) const;
  void trajectory(Status& status) const;
  void stages(Status& status);
  void parameters(Status& status) const;
  void process(Status& status) const;

  GuardState& state_;
  const Inputs& inputs_;
  const ReconfigureServer& reconfigure_;
  const TrajectoryWatch& trajectory_watch_;
  Counts poses_;  // at the end of the last period
  Counts meshes_;
  Counts vertices_;
  Counts commands_;
  sweep_guard_core::RepeatedPositions::Counts repeated_;
  sweep_guard_core::StageTimes stage_times_{};
  sweep_guard_core::SteadyTime stages_read_ = std::chrono::steady_clock::now();
  sweep_guard_core::SweepStatistics::Summary statistics_;  // of the last period
  diagnostic_updater::Updater updater_;
};

}  // namespace sweep_guard_ros
