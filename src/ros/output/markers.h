#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ros/output/trail.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// What the markers show.
struct MarkerScene {
  std::shared_ptr<const sweep_guard_core::Tool> tool;
  std::set<std::string> namespaces;                                ///< only these are drawn
  std::shared_ptr<const sweep_guard_core::SweepReport> newest;     ///< null: nothing swept yet
  std::shared_ptr<const sweep_guard_core::SweepReport> contact;    ///< newest with a contact; null: none
  std::shared_ptr<const sweep_guard_core::Prediction> prediction;  ///< newest; null: none yet
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();          ///< of the newest report
  Eigen::Vector3d prediction_from_W = Eigen::Vector3d::Zero();     ///< where the tip was when it was looked ahead [m]
  Trail trail;
  sweep_guard_core::Warning warning;
};

/// The namespaces that markers come in, in the order in which they are documented.
const std::vector<std::string>& markerNamespaces();

/// Draws the tool, its sweep, the triangles met, the same of the prediction, and the warning text for rviz. Ids are
/// stable, what is gone is deleted once, nothing outlives half a second, and everything is grey while the level is
/// unknown. One thread.
class Markers {
 public:
  explicit Markers(std::string fixed_frame);

  visualization_msgs::MarkerArray draw(const MarkerScene& scene);

 private:
  using Key = std::pair<std::string, int>;  // namespace and id

  void addMeasured(visualization_msgs::MarkerArray& array, const MarkerScene& scene) const;
  void addPredicted(visualization_msgs::MarkerArray& array, const MarkerScene& scene) const;
  void deleteGone(visualization_msgs::MarkerArray& array);

  const std::string fixed_frame_;
  std::set<Key> shown_;
};

}  // namespace sweep_guard_ros
