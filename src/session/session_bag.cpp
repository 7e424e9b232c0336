#include "session/session_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "recording/bag.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::InvalidInput;
using sweep_guard_ros::fromMsg;

namespace {

// No configuration of the guard accepts poses from farther ahead, or takes older poses for fresh.
constexpr Duration kMaxAhead = std::chrono::milliseconds(50);
constexpr Duration kMaxDelay = std::chrono::seconds(2);
constexpr const char* kPoseType = "geometry_msgs/PoseStamped";

using Types = std::map<std::string, std::string>;  // by topic

Types typesIn(const rosbag::Bag& bag) {
  Types types;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
    types[connection->topic] = connection->datatype;
  }
  return types;
}

std::string joinNames(const Types& types) {
  std::string list;
  for (const auto& [topic, type] : types) list += fmt::format("\n  {} ({})", topic, type);
  return list;
}

void require(const Types& types, const std::string& argument, const std::string& topic, const std::string& type,
             const std::string& remedy) {
  const auto found = types.find(topic);
  if (found != types.end() && found->second == type) return;
  throw InvalidInput(fmt::format("{}, {} must be {}; {}. The bag has:{}",
                                 found == types.end() ? "no topic " + topic : topic + " is " + found->second, argument,
                                 type, remedy, joinNames(types)));
}

void requireTopics(const Types& types, const SessionTopics& topics) {
  if (!topics.tool_pose.empty()) require(types, "tool_pose", topics.tool_pose, kPoseType, "give tool_pose:=TOPIC");
  if (!topics.joint_states.empty()) {
    require(types, "joint_states", topics.joint_states, "sensor_msgs/JointState", "give joint_states:=TOPIC");
  }
  if (topics.mesh.empty()) return;
  require(types, "mesh", topics.mesh, "sweep_guard/DeformableMesh",
          "give mesh:=TOPIC, or mesh_file:=FILE if it was not recorded");
  if (types.count(topics.mesh_vertices) == 0) return;
  require(types, "mesh_vertices", topics.mesh_vertices, "sweep_guard/MeshVertices", "give mesh_vertices:=TOPIC");
}

void readPoses(const rosbag::Bag& bag, const std::string& topic, SessionBag& session) {
  Duration min_delay = Duration::max();
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    const auto pose = message.instantiate<geometry_msgs::PoseStamped>();
    if (!pose) throw InvalidInput("a message on " + topic + " cannot be read; record it again");
    const sweep_guard_core::Time stamp = fromMsg(pose->header.stamp);
    session.poses.push_back(stamp);
    const Duration delay = fromMsg(message.getTime()) - stamp;
    if (std::chrono::abs(delay) < std::chrono::abs(min_delay)) min_delay = delay;
  }
  if (session.poses.empty()) throw InvalidInput("no message on " + topic + "; record it again");
  std::sort(session.poses.begin(), session.poses.end());
  if (session.poses.back() == sweep_guard_core::Time()) {
    throw InvalidInput("the poses on " + topic + " have no stamps; stamp each pose with the time of its measurement");
  }
  if (min_delay > kMaxDelay || min_delay < -kMaxAhead) {
    throw InvalidInput(fmt::format(
        "the poses on {} are stamped {:.1f} s {} they were recorded, by another clock: all would be {}; synchronize "
        "the "
        "clocks, or correct the stamps",
        topic, std::abs(sweep_guard_core::toSeconds(min_delay)), min_delay > Duration(0) ? "before" : "after",
        min_delay > Duration(0) ? "stale" : "from the future"));
  }
}

SessionBag inspect(const rosbag::Bag& bag, const SessionTopics& topics) {
  rosbag::View all(bag);
  if (all.size() == 0) throw InvalidInput("the bag is empty; record the session again, until rosbag record ends");
  requireTopics(typesIn(bag), topics);
  SessionBag session;
  session.begin = fromMsg(all.getBeginTime());
  session.end = fromMsg(all.getEndTime());
  const auto count = [&bag](const std::string& topic) { return rosbag::View(bag, rosbag::TopicQuery(topic)).size(); };
  if (!topics.mesh.empty()) {
    session.meshes = count(topics.mesh);
    session.vertices = count(topics.mesh_vertices);
  }
  if (!topics.tool_pose.empty()) readPoses(bag, topics.tool_pose, session);
  return session;
}

}  // namespace

SessionBag inspectBag(const std::string& path, const SessionTopics& topics) {
  try {
    if (!std::filesystem::exists(path)) throw InvalidInput("no such file; give bag:=FILE");
    if (!std::filesystem::is_regular_file(path)) throw InvalidInput("not a regular file; give bag:=FILE");
    if (!sweep_guard_recording::isBag(path)) throw InvalidInput("not a rosbag, or not readable; give bag:=FILE");
    return inspect(rosbag::Bag(path), topics);
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  } catch (const rosbag::BagUnindexedException&) {
    throw InvalidInput(path + ": the bag has no index, its recorder did not end; run rosbag reindex on it");
  } catch (const std::exception& error) {  // of rosbag or ROS, or no memory for the size in a broken header
    throw InvalidInput(path + ": the bag is broken: " + error.what());
  }
}

}  // namespace sweep_guard_session
