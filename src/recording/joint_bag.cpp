#include "recording/joint_bag.h"

#include <rosbag/message_instance.h>

#include "recording/bag_topic.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_recording {
namespace {

const TopicChoice kJoints = {{"sensor_msgs/JointState"}, "sensor_msgs/JointState", "joints_topic:=TOPIC"};

}  // namespace

void readJointBag(const std::string& path, const std::string& topic,
                  const std::function<void(const std::string& publisher, const sensor_msgs::JointState&)>& read) {
  openBag(path, [&](const rosbag::Bag& bag) {
    forEachMessage(bag, chooseTopic(bag, topic, kJoints), [&](const rosbag::MessageInstance& message) {
      const auto joints = message.instantiate<sensor_msgs::JointState>();
      if (!joints) throw sweep_guard_core::InvalidInput("message cannot be read; record it again");
      read(message.getCallerId(), *joints);
    });
  });
}

}  // namespace sweep_guard_recording
