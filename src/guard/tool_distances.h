#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Returns a lower bound on the distance [m] between a body of the tool and a mesh, >= 0: that of two boxes along the axes of M,
/// around the bounds of the body and around the mesh.
double boxDistance(const Tool& body, const Eigen::Isometry3d& X_MB, const TriangleMesh& mesh_M);

/// Keeps how far the tool is from the box around each workpiece, and how near it ever came: what tells that something is not in
/// meters. Any thread.
class ToolDistances {
 public:
  struct Distance {
    /// At the newest pose that was measured at [m], >= 0; empty: the frame of the workpiece was not known there.
    std::optional<double> now;
    /// Since the workpiece came, or came in another unit: more than three times as long or short as at the pose before [m], >= 0.
    std::optional<double> least;
  };

  /// Measures at a pose. Of a tool of many bodies among many workpieces not at each one: a thousand pairs are measured every 20 ms,
  /// and at none while get() copies: whoever sweeps does not wait.
  /// @param workpieces  ascending by id; not checked
  /// @param bodies      of the tool, as many as the pose has, none null
  void add(const PoseWithFrames& pose, const Workpieces& workpieces, SteadyTime now,
           const std::vector<const Tool*>& bodies);

  std::map<std::string, Distance> get() const;  ///< by id, of the workpieces of the newest pose

 private:
  struct Known {
    Distance distance;
    double length = 0.0;  // longest side of the box around the mesh [m]
  };
  static void measure(std::optional<double> distance, double length, Known& known);

  mutable Mutex mutex_;
  std::optional<SteadyTime> measured_ GUARDED_BY(mutex_);  // newest
  std::map<std::string, Known> known_ GUARDED_BY(mutex_);  // by id
};

}  // namespace sweep_guard_core
