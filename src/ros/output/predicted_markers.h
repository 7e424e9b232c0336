#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "ros/output/trail.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// What the drawings of the prediction share.
struct PredictedScene {
  const sweep_guard_core::Prediction& prediction;
  const sweep_guard_core::Tool& tool;
  std::string fixed_frame;
  sweep_guard_core::WarningLevel level;
};

/// `predicted_tool`: at most ten ghosts, evenly spread in time, fading with it. One that has hardly moved is left out.
void addGhosts(visualization_msgs::MarkerArray& array, const PredictedScene& scene);

/// `predicted_volume`: the boxes and planes of the predicted sweeps, faint.
void addPredictedVolumes(visualization_msgs::MarkerArray& array, const PredictedScene& scene);

/// `predicted_triangles`: those met within the reflex interval in red, those met later in amber.
void addPredictedTriangles(visualization_msgs::MarkerArray& array, const PredictedScene& scene);

/// `trajectory`: the way of the tip, measured (id 0) and predicted (id 1), fading with the time from now.
void addTrail(visualization_msgs::MarkerArray& array, const Trail& trail, const std::string& fixed_frame,
              sweep_guard_core::WarningLevel level);
void addPredictedTrail(visualization_msgs::MarkerArray& array, const PredictedScene& scene,
                       const Eigen::Vector3d& from_W);

}  // namespace sweep_guard_ros
