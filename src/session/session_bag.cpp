#include "session/session_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "evaluation/format.h"
#include "recording/bag.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::InvalidInput;
using sweep_guard_ros::fromMsg;

namespace {

// A guard takes no pose from farther ahead, and none that is older as fresh, whatever its configuration.
constexpr Duration kMaxAhead = std::chrono::milliseconds(50);
constexpr Duration kMaxBehind = std::chrono::seconds(2);
constexpr const char* kPoseType = "geometry_msgs/PoseStamped";

using Types = std::map<std::string, std::string>;  // by topic

Types typesIn(const rosbag::Bag& bag) {
  Types types;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
    types[connection->topic] = connection->datatype;
  }
  return types;
}

std::string listed(const Types& types) {
  std::string list;
  for (const auto& [topic, type] : types) list.append("\n  ").append(topic).append(" (").append(type).append(")");
  return list;
}

void require(const Types& types, const std::string& argument, const std::string& topic, const std::string& type,
             const std::string& remedy) {
  const auto found = types.find(topic);
  if (found != types.end() && found->second == type) return;
  throw InvalidInput((found == types.end() ? "there is no " + topic : topic + " is " + found->second) + ", and " +
                     argument + " must be " + type + "; " + remedy + ". The bag has:" + listed(types));
}

void requireTopics(const Types& types, const SessionTopics& topics) {
  if (!topics.tool_pose.empty()) require(types, "tool_pose", topics.tool_pose, kPoseType, "give tool_pose:=TOPIC");
  if (topics.mesh.empty()) return;
  require(types, "mesh", topics.mesh, "sweep_guard/DeformableMesh",
          "give mesh:=TOPIC, or mesh_file:=FILE if it was not recorded");
  if (types.count(topics.mesh_vertices) == 0) return;
  require(types, "mesh_vertices", topics.mesh_vertices, "sweep_guard/MeshVertices", "give mesh_vertices:=TOPIC");
}

void readPoses(const rosbag::Bag& bag, const std::string& topic, SessionBag& session) {
  Duration least_behind = Duration::max();
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    const auto pose = message.instantiate<geometry_msgs::PoseStamped>();
    if (!pose) throw InvalidInput("a message on " + topic + " cannot be read; record it again");
    const sweep_guard_core::Time stamp = fromMsg(pose->header.stamp);
    session.poses.push_back(stamp);
    const Duration behind = fromMsg(message.getTime()) - stamp;
    if (std::chrono::abs(behind) < std::chrono::abs(least_behind)) least_behind = behind;
  }
  if (session.poses.empty()) throw InvalidInput("there is no message on " + topic + "; record it again");
  std::sort(session.poses.begin(), session.poses.end());
  if (session.poses.back() == sweep_guard_core::Time()) {
    throw InvalidInput("the poses on " + topic + " have no stamps, and without them nothing is known of the motion; " +
                       "stamp each pose when the tool is there");
  }
  if (least_behind > kMaxBehind || least_behind < -kMaxAhead) {
    throw InvalidInput(sweep_guard_evaluation::format(
        "the poses on %s are stamped %.1f s %s they were recorded, by another clock: to the guard they would all be "
        "%s; "
        "synchronise the clocks, or correct the stamps",
        topic.c_str(), std::abs(sweep_guard_core::toSeconds(least_behind)),
        least_behind > Duration(0) ? "before" : "after", least_behind > Duration(0) ? "stale" : "from the future"));
  }
}

SessionBag inspect(const rosbag::Bag& bag, const SessionTopics& topics) {
  rosbag::View all(bag);
  if (all.size() == 0) throw InvalidInput("the bag is empty; record the session again, until rosbag record is ended");
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
  } catch (const std::exception& error) {  // rosbag's own, ROS's, no memory for what a broken header asks for
    throw InvalidInput(path + ": the bag is broken: " + error.what());
  }
}

}  // namespace sweep_guard_session
