#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/trail.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// Workpieces are drawn up to so many triangles in all.
constexpr size_t kMaxMarkedTriangles = 50'000;

/// Everything that the markers show.
struct MarkerScene {
  std::shared_ptr<const sweep_guard_core::Tool> tool;
  std::shared_ptr<const std::vector<sweep_guard_core::Tool>> bodies;  ///< of the tool, each in its frame
  std::set<std::string> namespaces;                                   ///< drawn ones
  sweep_guard_core::Workpieces workpieces;                            ///< drawn ones, but for links of other tools
  std::shared_ptr<const sweep_guard_core::SweepReport> newest;        ///< null: none yet
  std::shared_ptr<const sweep_guard_core::SweepReport> contact;       ///< newest one with a contact; null: none
  std::shared_ptr<const sweep_guard_core::Prediction> prediction;     ///< newest one; null: none yet
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();             ///< tool pose of the newest report
  std::vector<sweep_guard_core::BodyPose> body_poses;                 ///< of an articulated tool at the same time
  Eigen::Vector3d prediction_from_W = Eigen::Vector3d::Zero();  ///< tip of the tool where the prediction begins [m]
  sweep_guard_core::Trail trail;
  sweep_guard_core::Warning warning;
};

/// Returns whether the scene's contact is the one that the warning reports. It is not if it is older than what may be
/// held, or of another workpiece: detectors may also disagree about a sweep that met nothing.
bool isOfWarning(const MarkerScene& scene, const sweep_guard_core::WarningLimits& limits);

/// Returns the namespaces of all markers, in the order of the documentation.
const std::vector<std::string>& markerNamespaces();

/// Draws the workpieces, the tool, its swept volume, the triangles in contact, the prediction, and the warning text for
/// rviz. Ids are stable. A marker is deleted once when its subject is gone, lives for at most half a second, and is gray while
/// the level is unknown, but for workpieces. One thread.
///
/// A workpiece is drawn when it has changed, and anew before its marker ends. One that is too much for kMaxMarkedTriangles is
/// a text in its place.
class Markers {
 public:
  explicit Markers(std::string fixed_frame);

  visualization_msgs::MarkerArray draw(const MarkerScene& scene, sweep_guard_core::SteadyTime now);

 private:
  using Key = std::pair<std::string, int>;  // namespace and id
  struct DrawnWorkpiece {
    int id;
    sweep_guard_core::SteadyTime received;  // the positions that are drawn
    sweep_guard_core::SteadyTime at;        // when they were drawn
  };

  void addWorkpieces(visualization_msgs::MarkerArray& array, const MarkerScene& scene,
                     sweep_guard_core::SteadyTime now);
  void addMeasured(visualization_msgs::MarkerArray& array, const MarkerScene& scene) const;
  void addPredicted(visualization_msgs::MarkerArray& array, const MarkerScene& scene) const;
  void deleteOld(visualization_msgs::MarkerArray& array);

  const std::string fixed_frame_;
  std::set<Key> shown_;
  std::map<std::string, DrawnWorkpiece> workpieces_;  // by id
  int next_workpiece_ = 0;
};

}  // namespace sweep_guard_ros
