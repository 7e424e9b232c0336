#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>

#include <memory>
#include <string>

#include "guard/command_queue.h"
#include "monitor/input_record.h"
#include "ros/connection/bounded.h"
#include "ros/connection/sole_publisher.h"
#include "ros/input/frames.h"
#include "ros/input/joint_jog.h"
#include "ros/input/joint_names.h"
#include "ros/parameters/parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/queue_thread.h"

namespace sweep_guard_ros {

/// Takes what goes to the robot for the prediction, and refuses bad messages. The guard works without it.
class CommandInput {
 public:
  /// @param parameters  with a `command_type`, not CommandSource::kNone
  CommandInput(const ros::NodeHandle& node, const Parameters& parameters, const Frames& frames,
               sweep_guard_core::CommandQueue& commands);

  void start(Supervisor& supervisor) { thread_.start(supervisor, {"commands", sweep_guard_core::Stage::kReceive}); }

  const sweep_guard_core::InputRecord& record() const { return record_; }
  std::string topic() const { return subscriber_.getTopic(); }
  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }

 private:
  template <typename Msg>
  BoundedSubscriber subscribe(const ros::NodeHandle& node, const std::string& topic);
  BoundedSubscriber subscribeTo(const Parameters& parameters, const ros::NodeHandle& node);
  sweep_guard_core::SentCommand read(const geometry_msgs::PoseStamped& msg, const std_msgs::Header& header) const;
  sweep_guard_core::SentCommand read(const geometry_msgs::TwistStamped& msg, const std_msgs::Header& header) const;
  sweep_guard_core::SentCommand read(const geometry_msgs::Twist& msg, const std_msgs::Header& header) const;
  sweep_guard_core::SentCommand read(const JointJog& msg, const std_msgs::Header& header) const;
  Eigen::Isometry3d framePose(const std::string& frame) const;
  void refuse(const std::string& reason);

  const std::string fixed_frame_;
  const std::string tool_frame_;
  const Frames& frames_;
  sweep_guard_core::CommandQueue& commands_;
  std::shared_ptr<const RobotModel> robot_;  // null: no joints are commanded
  std::unique_ptr<JointNames> names_;        // the same
  SolePublisher sole_;
  sweep_guard_core::InputRecord record_;
  LogThrottle log_;
  QueueThread thread_;  // before the subscriber, which uses its queue
  BoundedSubscriber subscriber_;
};

}  // namespace sweep_guard_ros
