#pragma once

#include <ros/ros.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Warning.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

#include "simulation/pose_scheduler.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

/// Calls callbacks until a condition holds, and says in the log what it waits for.
/// @returns false if the node ends before
bool waitUntil(const std::function<bool()>& condition, const std::string& what);

/// Returns the current ROS time.
sweep_guard_core::Time rosNow();

/// Sleeps until a sample of a motion is due.
/// @param stamp  of the sample, counted from the start of the motion (0)
/// @returns false if the node ends before
bool awaitDue(const PoseScheduler& scheduler, sweep_guard_core::Time stamp);

/// Waits for all that a motion of the demo needs: a workpiece on `mesh`, a guard that knows it, as `warning` says, and
/// subscribers. One thread.
class MotionStart {
 public:
  /// Reads `frame`, the tf frame W of the motion, and `min_subscribers`, the number of subscribers to wait for.
  /// @throws sweep_guard_core::InvalidInput as ParameterReader
  explicit MotionStart(sweep_guard_ros::ParameterReader& parameters);

  // Each returns false if the node ends before.
  bool awaitWorkpiece();
  bool awaitGuard();
  bool awaitSubscribers(const ros::Publisher& publisher) const;

  const std::string& frame() const { return frame_; }
  const sweep_guard_core::TriangleMesh& mesh_W() const { return *mesh_W_; }  ///< after awaitWorkpiece()
  const Eigen::Vector3d& center_W() const { return center_W_; }              ///< [m] origin of its frame, as mesh_W()
  const std::string& meshId() const { return mesh_->id; }                    ///< after awaitWorkpiece()

  void stopListening();  ///< to workpiece and warnings

  const tf2_ros::Buffer& transforms() const { return buffer_; }  ///< received so far

 private:
  bool locate();

  std::string frame_;
  int min_subscribers_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};
  sweep_guard::DeformableMesh::ConstPtr mesh_;
  std::optional<sweep_guard_core::TriangleMesh> mesh_W_;
  Eigen::Vector3d center_W_ = Eigen::Vector3d::Zero();
  bool guard_ready_ = false;
  ros::NodeHandle node_;
  ros::Subscriber mesh_subscriber_;
  ros::Subscriber warning_subscriber_;
};

}  // namespace sweep_guard_simulation
