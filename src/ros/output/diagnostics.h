#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <optional>
#include <string>

#include "ros/input/mesh_input.h"
#include "ros/input/pose_input.h"
#include "ros/input/workpiece_store.h"
#include "ros/output/sweep_statistics.h"
#include "ros/parameters/parameters.h"
#include "ros/parameters/reconfigure_server.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// What the diagnostics look at.
struct DiagnosticsSources {
  const LiveParameters& parameters;
  const PoseInput& poses;
  const MeshInput& meshes;
  const WorkpieceStore& workpieces;
  const sweep_guard_core::WarningMonitor& monitor;
  SweepStatistics& statistics;
  const ReconfigureServer& reconfigure;
};

/// Events per second since it was last asked.
class RateMeter {
 public:
  double update(std::uint64_t count);

 private:
  std::uint64_t count_ = 0;
  sweep_guard_core::SteadyTime asked_ = std::chrono::steady_clock::now();
};

/// Whether the detector works, and keeps up with the poses.
void reportDetector(const SweepStatistics::Summary& load, const Parameters& parameters,
                    diagnostic_updater::DiagnosticStatusWrapper& status);

/// Answers "why is there no warning" on /diagnostics: the warning; of each input its source, publishers, rate, age and
/// last error; the workpieces; the detector and its deadlines; the prediction; what was changed since the start;
/// memory.
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const DiagnosticsSources& parts);

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

  void warning(Status& status) const;
  void pose(Status& status);
  void mesh(Status& status);
  void vertices(Status& status);
  void input(Status& status, const Input& input, Meter& meter) const;
  void workpieces(Status& status) const;
  void detector(Status& status) const;
  void prediction(Status& status) const;
  void parameters(Status& status) const;
  void process(Status& status) const;

  const DiagnosticsSources parts_;
  Meter poses_;
  Meter meshes_;
  Meter vertices_;
  SweepStatistics::Summary load_;  // of the last period
  diagnostic_updater::Updater updater_;
};

}  // namespace sweep_guard_ros
