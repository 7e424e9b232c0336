#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "common/trail.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// Everything that the markers of the prediction share.
struct PredictedScene {
  const sweep_guard_core::Prediction& prediction;
  const std::vector<sweep_guard_core::Tool>& bodies;
  double lift;  ///< of contact triangles [m], see liftOff()
  std::string fixed_frame;
  sweep_guard_core::WarningLevel level;
};

/// Adds `predicted_tool`: at most ten ghosts at even intervals, fading with time. Omits a ghost that has hardly moved.
void addGhosts(visualization_msgs::MarkerArray& array, const PredictedScene& scene);

/// Adds `predicted_volume`: the faint boxes and planes of the predicted sweeps.
void addPredictedVolumes(visualization_msgs::MarkerArray& array, const PredictedScene& scene);

/// Adds `predicted_triangles`: contacts within the reflex interval in red, later ones in amber.
void addPredictedTriangles(visualization_msgs::MarkerArray& array, const PredictedScene& scene);

/// Adds `trajectory`: the path of the tip, measured (id 0) and predicted (id 1), fading with the time from now.
void addTrail(visualization_msgs::MarkerArray& array, const sweep_guard_core::Trail& trail,
              const std::string& fixed_frame, sweep_guard_core::WarningLevel level);
void addPredictedTrail(visualization_msgs::MarkerArray& array, const PredictedScene& scene,
                       const Eigen::Vector3d& from_W);

}  // namespace sweep_guard_ros
