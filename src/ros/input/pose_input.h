#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/subscriber.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "ros/input/frames.h"
#include "ros/input/input_record.h"
#include "ros/input/workpiece_store.h"
#include "ros/log_throttle.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/monitor/warning_monitor.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// A tool pose that has been checked, with the frames of the workpieces.
struct QueuedPose {
  sweep_guard_core::PoseWithFrames pose;
  sweep_guard_core::WarningMonitor::Checkpoint came;
};

/// Takes tool poses from the topic or from tf, refuses bad ones, looks up their transforms, and hands them on in order.
/// Its own thread, because a transform may be up to 20 ms late.
class PoseInput {
 public:
  using Sink = std::function<void(QueuedPose)>;

  PoseInput(const ros::NodeHandle& node, const Parameters& parameters, Frames& frames, const WorkpieceStore& workpieces,
            sweep_guard_core::WarningMonitor& monitor, Sink sink);

  void start() { thread_.start(); }

  const InputRecord& record() const { return record_; }
  std::string source() const;                       ///< resolved topic, or the tf frames
  std::optional<std::uint32_t> publishers() const;  ///< of the topic; empty for tf

 private:
  struct Incoming {
    sweep_guard_core::Time stamp;
    sweep_guard_core::SteadyTime received;
    std::string frame;
    Eigen::Isometry3d X_FT;
  };

  void onMessage(const geometry_msgs::PoseStamped& msg);
  void onTransforms();
  void acceptOrRefuse(const sweep_guard_core::Timestamps& seen, const std::function<Incoming()>& read);
  void accept(const Incoming& incoming);
  void checkStamp(sweep_guard_core::Time stamp) const;
  std::map<std::string, Eigen::Isometry3d> locate(const std::set<std::string>& mesh_frames,
                                                  sweep_guard_core::Time stamp);
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp);
  void refuse(sweep_guard_core::Reason reason, const std::string& why);

  const std::string fixed_frame_;
  const std::string tool_frame_;
  Frames& frames_;
  const WorkpieceStore& workpieces_;
  sweep_guard_core::WarningMonitor& monitor_;
  const Sink sink_;

  std::optional<sweep_guard_core::Time> last_;
  std::uint64_t last_epoch_ = 0;
  std::optional<sweep_guard_core::Time> last_transform_;  // of the listener's thread
  using FramePair = std::pair<std::string, std::string>;
  std::map<FramePair, std::optional<sweep_guard_core::Time>>
      missing_;  // transforms that did not come, and the newest there was
  LogThrottle log_;
  InputRecord record_;

  QueueThread thread_;  // outlives what calls back on it
  std::shared_ptr<void> transforms_changed_;
  ros::Subscriber subscriber_;
};

}  // namespace sweep_guard_ros
