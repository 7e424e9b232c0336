#include "ros/output/interaction_publisher.h"

#include <sweep_guard/Interaction.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "common/stage_clock.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InStage;
using sweep_guard_core::Stage;

constexpr std::uint32_t kForcesQueued = 100;  // 0.1 s at 1 kHz: older forces serve nobody

geometry_msgs::Wrench wrenchMsg(const sweep_guard_core::Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = vectorMsg<geometry_msgs::Vector3>(wrench.force_T);
  message.torque = vectorMsg<geometry_msgs::Vector3>(wrench.torque_T);
  return message;
}

sweep_guard::ObjectInteraction interactionMsg(const sweep_guard_core::ObjectInteraction& object) {
  sweep_guard::ObjectInteraction message;
  message.mesh_id = object.workpiece->id;
  message.revision = object.workpiece->revision;
  message.mesh_stamp = toMsg(object.workpiece->stamp);
  message.enclosed = static_cast<std::uint8_t>(object.enclosed);
  message.volume = object.volume;
  message.centroid = vectorMsg<geometry_msgs::Point>(object.centroid_T);
  message.area = vectorMsg<geometry_msgs::Vector3>(object.area_T);
  message.depth = object.depth;
  message.wrench = wrenchMsg(object.wrench);
  return message;
}

}  // namespace

InteractionPublisher::InteractionPublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                                           const sweep_guard_core::WarningMonitor& monitor)
    : parameters_(parameters),
      known_surfaces_(monitor),
      publisher_(private_node.advertise<sweep_guard::Interaction>("interaction", kForcesQueued)),
      finder_(*parameters.initial().bodies) {}

void InteractionPublisher::swept(const sweep_guard_core::PoseWithFrames& pose,
                                 const sweep_guard_core::Workpieces& workpieces,
                                 const sweep_guard_core::SweepReport& report) {
  const auto parameters = parameters_.get();
  if (publisher_.getNumSubscribers() == 0) return reset();
  const InStage computing(Stage::kInteraction);
  finder_.find(pose, workpieces, parameters->interaction, interaction_);
  const InStage publishing(Stage::kPublish);
  const auto message = boost::make_shared<sweep_guard::Interaction>();
  message->header.stamp = toMsg(pose.stamp);
  message->header.frame_id = parameters->tool_frame;
  message->valid_until = toMsg(pose.stamp + parameters->limits.pose_timeout);
  const bool counted_twice = std::any_of(interaction_.objects.begin(), interaction_.objects.end(),
                                         [](const auto& object) { return object.counted_twice; });
  message->valid = static_cast<std::uint8_t>(known_surfaces_.complete(report, interaction_.unplaced) && !counted_twice);
  message->wrench = wrenchMsg(interaction_.total);
  for (const auto& object : interaction_.objects) message->objects.push_back(interactionMsg(object));
  publisher_.publish(message);
}

}  // namespace sweep_guard_ros
