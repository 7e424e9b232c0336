#include "session/session_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Intend.h>
#include <sweep_guard/MeshVertices.h>
#include <tf2_msgs/TFMessage.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/frame_name.h"
#include "ros/camera/depth_topic.h"
#include "ros/parameters/camera_parameters.h"
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
constexpr const char* kMeshType = "sweep_guard/DeformableMesh";
constexpr const char* kTransforms = "/tf";
constexpr const char* kLatched =
    "What is latched, as meshes and static transforms are, is recorded once, in the first part of a split recording: "
    "replay all parts, bag:=FIRST:SECOND, or record with rosbag record --repeat-latched";

std::string joinNames(const TopicTypes& topics) {
  std::string list;
  for (const auto& [topic, types] : topics) {
    for (const MessageType& type : types) list += fmt::format("\n  {} ({})", topic, type.name);
  }
  return list;
}

// The player would wait without end for the guard, which takes no other definition.
template <typename Message>
void requireVersion(const TopicTypes& topics, const std::string& topic) {
  const auto found = topics.find(absoluteName(topic));
  if (found == topics.end()) return;
  for (const MessageType& type : found->second) {
    if (type.md5sum == ros::message_traits::MD5Sum<Message>::value()) continue;
    throw InvalidInput(fmt::format(
        "{} is {} of another version of its definition: migrate it (rosbag fix), or record again", topic, type.name));
  }
}

template <typename Message>
void require(const TopicTypes& topics, const std::string& argument, const std::string& topic,
             const std::string& remedy) {
  const std::string expected = ros::message_traits::DataType<Message>::value();
  const auto found = topics.find(absoluteName(topic));
  std::string problem = found == topics.end() ? "no topic " + topic : "";
  for (const MessageType& type : found == topics.end() ? std::set<MessageType>() : found->second) {
    if (type.name != expected) problem = topic + " is " + type.name;
  }
  if (problem.empty()) return requireVersion<Message>(topics, topic);
  throw InvalidInput(
      fmt::format("{}, {} must be {}; {}. The bag has:{}", problem, argument, expected, remedy, joinNames(topics)));
}

bool hasMeshes(const TopicTypes& topics) {
  const auto is_mesh = [](const MessageType& type) { return type.name == kMeshType; };
  return std::any_of(topics.begin(), topics.end(), [&is_mesh](const auto& topic) {
    return std::any_of(topic.second.begin(), topic.second.end(), is_mesh);
  });
}

std::string remedyForMesh(const TopicTypes& types) {
  std::string remedy = "give mesh:=TOPIC, or mesh_file:=FILE if it was not recorded";
  if (hasMeshes(types)) return remedy;
  if (types.count(kStaticTransformsTopic) == 0)
    remedy += std::string("; there is no ") + kStaticTransformsTopic + " either";
  return remedy + ". " + kLatched;
}

void requireCamera(const TopicTypes& types, const SessionCamera& camera) {
  const std::string of_camera = " of camera '" + camera.id + "'";
  const std::string remedy = "change `cameras` in the file of config:=FILE, or record it";
  if (sweep_guard_ros::isCompressedDepth(camera.depth)) {
    require<sensor_msgs::CompressedImage>(types, "depth" + of_camera, camera.depth, remedy);
  } else {
    require<sensor_msgs::Image>(types, "depth" + of_camera, camera.depth, remedy);
  }
  require<sensor_msgs::CameraInfo>(types, "camera_info" + of_camera, camera.info, "record it beside the images");
}

void requireTopics(const TopicTypes& types, const SessionTopics& topics) {
  if (!topics.tool_pose.empty())
    require<geometry_msgs::PoseStamped>(types, "tool_pose", topics.tool_pose, "give tool_pose:=TOPIC");
  if (!topics.joint_states.empty())
    require<sensor_msgs::JointState>(types, "joint_states", topics.joint_states, "give joint_states:=TOPIC");
  for (const char* const topic : {kTransforms, kStaticTransformsTopic})
    requireVersion<tf2_msgs::TFMessage>(types, topic);
  requireVersion<sweep_guard::Intend>(types, kIntendTopic);
  for (const SessionCamera& camera : topics.cameras) requireCamera(types, camera);
  if (topics.mesh.empty()) return;
  require<sweep_guard::DeformableMesh>(types, "mesh", topics.mesh, remedyForMesh(types));
  if (types.count(absoluteName(topics.mesh_vertices)) == 0) return;
  require<sweep_guard::MeshVertices>(types, "mesh_vertices", topics.mesh_vertices, "give mesh_vertices:=TOPIC");
}

using Frames = std::set<std::string>;

void addFrame(const std::string& frame, Frames& frames) { frames.insert(sweep_guard_core::withoutSlash(frame)); }

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

void readCamera(const SessionFiles& files, const SessionCamera& camera, SessionBag& session, Frames& frames) {
  session.cameras.push_back(fmt::format("{}: {} images on {}", sweep_guard_core::printable(camera.id),
                                        files.count(camera.depth), camera.depth));
  files.forEach({camera.info}, [&](const rosbag::MessageInstance& message) {
    if (const auto info = message.instantiate<sensor_msgs::CameraInfo>()) addFrame(info->header.frame_id, frames);
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

std::string missingTransforms(const TopicTypes& types, const Frames& frames) {
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
  Frames frames;
  for (const std::string& frame : topics.frames) addFrame(frame, frames);
  if (!topics.mesh.empty()) {
    session.meshes = files.count(topics.mesh);
    session.vertices = files.count(topics.mesh_vertices);
    readMeshFrames(files, topics.mesh, frames);
  }
  for (const SessionCamera& camera : topics.cameras) readCamera(files, camera, session, frames);
  if (!topics.tool_pose.empty()) readPoses(files, topics.tool_pose, session, frames);
  frames.erase(sweep_guard_core::withoutSlash(topics.fixed_frame));
  erasePlaced(files, frames);
  if (!frames.empty()) session.missing.push_back(missingTransforms(files.types(), frames));
  return session;
}

}  // namespace

std::vector<SessionCamera> camerasOf(const ros::NodeHandle& guard) {
  sweep_guard_ros::ParameterReader parameters(guard);
  std::vector<SessionCamera> cameras;
  for (const sweep_guard_ros::CameraParameters& camera : sweep_guard_ros::readCameras(parameters)) {
    const std::string depth = absoluteName(camera.depth);
    cameras.push_back({camera.id, depth, sweep_guard_ros::infoTopicOf(depth)});
  }
  return cameras;
}

SessionBag inspectSession(const SessionFiles& files, const SessionTopics& topics, Duration start) {
  try {
    return inspect(files, topics, start);
  } catch (const InvalidInput& error) {
    throw InvalidInput(files.name() + ": " + error.what());
  }
}

}  // namespace sweep_guard_session
