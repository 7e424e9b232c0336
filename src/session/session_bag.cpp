#include "session/session_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <sweep_guard/DeformableMesh.h>
#include <tf2_msgs/TFMessage.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
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
constexpr const char* kMeshType = "sweep_guard/DeformableMesh";
constexpr const char* kTransforms = "/tf";
constexpr const char* kLatched =
    "What is latched, as meshes and static transforms are, is recorded once, in the first part of a split recording: "
    "replay all parts, bag:=FIRST:SECOND, or record with rosbag record --repeat-latched";

using Types = std::map<std::string, std::string>;  // by topic

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

bool hasMeshes(const Types& types) {
  return std::any_of(types.begin(), types.end(), [](const auto& topic) { return topic.second == kMeshType; });
}

std::string remedyForMesh(const Types& types) {
  std::string remedy = "give mesh:=TOPIC, or mesh_file:=FILE if it was not recorded";
  if (hasMeshes(types)) return remedy;
  if (types.count(kStaticTransformsTopic) == 0)
    remedy += std::string("; there is no ") + kStaticTransformsTopic + " either";
  return remedy + ". " + kLatched;
}

void requireTopics(const Types& types, const SessionTopics& topics) {
  if (!topics.tool_pose.empty()) require(types, "tool_pose", topics.tool_pose, kPoseType, "give tool_pose:=TOPIC");
  if (!topics.joint_states.empty()) {
    require(types, "joint_states", topics.joint_states, "sensor_msgs/JointState", "give joint_states:=TOPIC");
  }
  if (topics.mesh.empty()) return;
  require(types, "mesh", topics.mesh, kMeshType, remedyForMesh(types));
  if (types.count(topics.mesh_vertices) == 0) return;
  require(types, "mesh_vertices", topics.mesh_vertices, "sweep_guard/MeshVertices", "give mesh_vertices:=TOPIC");
}

using Frames = std::set<std::string>;

void addFrame(std::string frame, Frames& frames) {
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
  frames.insert(std::move(frame));
}

void readPoses(const SessionFiles& files, const std::string& topic, SessionBag& session, Frames& frames) {
  Duration min_delay = Duration::max();
  files.forEach({topic}, session.start, session.end, [&](const rosbag::MessageInstance& message) {
    const auto pose = message.instantiate<geometry_msgs::PoseStamped>();
    if (!pose) throw InvalidInput("a message on " + topic + " cannot be read; record it again");
    const sweep_guard_core::Time stamp = fromMsg(pose->header.stamp);
    session.poses.push_back(stamp);
    addFrame(pose->header.frame_id, frames);
    const Duration delay = fromMsg(message.getTime()) - stamp;
    if (std::chrono::abs(delay) < std::chrono::abs(min_delay)) min_delay = delay;
  });
  if (session.poses.empty())
    throw InvalidInput("no message on " + topic +
                       " from the start on; give another start:=SECONDS, or record it again");
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

void readMeshFrames(const SessionFiles& files, const std::string& topic, Frames& frames) {
  files.forEach({topic}, [&](const rosbag::MessageInstance& message) {
    const auto mesh = message.instantiate<sweep_guard::DeformableMesh>();
    if (mesh && !mesh->mesh.triangles.empty()) addFrame(mesh->header.frame_id, frames);
  });
}

// /tf, which may be long, is read only if /tf_static is not enough.
void erasePlaced(const SessionFiles& files, Frames& frames) {
  for (const char* const topic : {kStaticTransformsTopic, kTransforms}) {
    if (frames.empty()) return;
    Frames placed;
    files.forEach({topic}, [&](const rosbag::MessageInstance& message) {
      const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
      if (!transforms) return;
      for (const geometry_msgs::TransformStamped& transform : transforms->transforms) {
        addFrame(transform.child_frame_id, placed);
        addFrame(transform.header.frame_id, placed);
      }
    });
    for (const std::string& frame : placed) frames.erase(frame);
  }
}

std::string missingTransforms(const Types& types, const Frames& frames) {
  std::string names;
  for (const std::string& frame : frames) {
    names += (names.empty() ? "'" : ", '") + sweep_guard_core::printable(frame) + "'";
  }
  const bool no_static = types.count(kStaticTransformsTopic) == 0;
  return "no transform of " + names + (no_static ? ", and no topic /tf_static. " : ". ") + kLatched;
}

Duration lengthOf(const SessionFiles& files) { return files.end() - files.begin(); }

SessionBag inspect(const SessionFiles& files, const SessionTopics& topics, Duration start) {
  if (start > lengthOf(files)) {
    throw InvalidInput(fmt::format("it ends after {:.1f} s; give a smaller start:=SECONDS",
                                   sweep_guard_core::toSeconds(lengthOf(files))));
  }
  requireTopics(files.types(), topics);
  SessionBag session;
  session.begin = files.begin();
  session.start = session.begin + start;
  session.end = files.end();
  Frames frames(topics.frames.begin(), topics.frames.end());
  if (!topics.mesh.empty()) {
    session.meshes = files.count(topics.mesh);
    session.vertices = files.count(topics.mesh_vertices);
    readMeshFrames(files, topics.mesh, frames);
  }
  if (!topics.tool_pose.empty()) readPoses(files, topics.tool_pose, session, frames);
  frames.erase(topics.fixed_frame);
  erasePlaced(files, frames);
  if (!frames.empty()) session.missing.push_back(missingTransforms(files.types(), frames));
  return session;
}

}  // namespace

SessionBag inspectSession(const SessionFiles& files, const SessionTopics& topics, Duration start) {
  try {
    return inspect(files, topics, start);
  } catch (const InvalidInput& error) {
    throw InvalidInput(files.name() + ": " + error.what());
  }
}

}  // namespace sweep_guard_session
