#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <Eigen/Geometry>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/depth_surface.h"
#include "common/guarded_by.h"
#include "common/pool.h"
#include "monitor/input_record.h"
#include "ros/camera/depth_image.h"
#include "ros/camera/self_volumes.h"
#include "ros/connection/bounded.h"
#include "ros/input/frames.h"
#include "ros/input/worker.h"
#include "ros/output/points_publisher.h"
#include "ros/parameters/camera_parameters.h"
#include "ros/parameters/live_parameters.h"
#include "ros/process/log_throttle.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Names the user of a camera's frames, see Frames::use().
inline std::string frameUserOf(const std::string& camera) { return "camera '" + camera + "'"; }

struct CameraInputDependencies {
  ros::NodeHandle private_node;  ///< publishes the points
  Frames& frames;
  const LiveParameters& parameters;
  sweep_guard_core::WarningMonitor& monitor;
  const sweep_guard_core::RecentPoses& poses;
  /// Hands an image to the guard; false: too many wait.
  std::function<bool(const std::shared_ptr<sweep_guard_core::Workpiece>&)> show;
};

/// Takes the images of one depth camera: puts what they show into the fixed frame at their stamps, and hands it to the guard, each
/// image in its turn. What is refused, or dropped because 16 images wait, makes the warning UNKNOWN until the next image. Images
/// before the first camera_info are left out for 1 s, and then refused. Messages arrive in a thread that all cameras share; a thread
/// of its own takes them.
class CameraInput {
 public:
  /// @param node  whose callbacks run in the thread that receives
  CameraInput(const ros::NodeHandle& node, const CameraParameters& camera, const CameraInputDependencies& dependencies);

  void start(Supervisor& supervisor);

  const CameraParameters& camera() const { return camera_; }
  const std::string& topic() const { return topic_; }           ///< of the images, resolved
  const std::string& infoTopic() const { return info_topic_; }  ///< resolved
  std::uint32_t publishers() const { return images_.getNumPublishers(); }
  const sweep_guard_core::InputRecord& record() const { return record_; }
  std::uint64_t dropped() const { return dropped_; }  ///< images, since the start
  /// What an image shows, in shares of its pixels.
  struct Shares {
    double seen;            ///< where there is a surface
    double self;            ///< that show the robot
    double hidden;          ///< where it hides a surface that was seen before
    size_t unplaced_links;  ///< of the robot description, that tf did not know at its stamp: they count as surroundings
    /// Of the points of the tool in the picture, the share that shows the tool; empty: too few are in it.
    std::optional<double> tool_found;
    bool rests;      ///< the camera: what the robot hides is remembered
    bool misplaced;  ///< for 5 s, less than half of the tool is where it is expected
    double delay;    ///< from its stamp until the guard had its surface [s]
  };
  std::optional<Shares> shares() const;  ///< of the newest image; empty: none has come

 private:
  template <typename Msg>
  BoundedSubscriber subscribe(ros::NodeHandle node);
  template <typename Msg>
  void take(const Msg& msg, sweep_guard_core::SteadyTime received);
  sensor_msgs::CameraInfo::ConstPtr info() const;
  std::string missingInfo() const;
  bool awaitsInfo(sweep_guard_core::SteadyTime received);
  void prepare(const ImageSize& size);
  double secondsSince(sweep_guard_core::Time stamp) const;
  Eigen::Isometry3d locate(const std::string& frame, sweep_guard_core::Time stamp);
  std::shared_ptr<sweep_guard_core::Workpiece> unusedImage();
  void keepShares(const sweep_guard_core::Timestamps& image);
  void refuse(const std::string& why, sweep_guard_core::SteadyTime received);
  void drop(sweep_guard_core::SteadyTime received);

  const CameraParameters camera_;
  const CameraInputDependencies dependencies_;
  const std::string topic_;
  const std::string info_topic_;
  sweep_guard_core::InputRecord record_;
  LogThrottle log_;
  std::atomic<std::uint64_t> dropped_ = 0;
  mutable sweep_guard_core::Mutex shares_mutex_;
  std::optional<Shares> shares_ GUARDED_BY(shares_mutex_);
  mutable sweep_guard_core::Mutex info_mutex_;
  sensor_msgs::CameraInfo::ConstPtr info_ GUARDED_BY(info_mutex_);  // the newest

  // Used by the thread that takes the images:
  PointsPublisher points_;
  SelfVolumes self_;
  std::optional<sweep_guard_core::SteadyTime> first_received_;
  std::string frame_;
  ImageSize size_{};
  sweep_guard_core::Pinhole pinhole_{};
  std::shared_ptr<const std::vector<sweep_guard_core::Tool>> bodies_;
  std::vector<float> depths_;
  std::optional<sweep_guard_core::DepthSurface> surface_;  // of images of this size and camera; empty: none has come
  std::optional<sweep_guard_core::TriangleMesh> empty_;    // of the size
  sweep_guard_core::Pool<sweep_guard_core::Workpiece> images_shown_;
  std::optional<sweep_guard_core::Time> newest_;                 // stamp of what surface_ shows
  std::optional<sweep_guard_core::SteadyTime> misplaced_since_;  // where most of the tool is not where it is expected
  std::uint64_t number_ = 0;                                     // of the newest image

  Worker worker_;  // before the subscribers, which push
  BoundedSubscriber images_;
  BoundedSubscriber infos_;
};

}  // namespace sweep_guard_ros
