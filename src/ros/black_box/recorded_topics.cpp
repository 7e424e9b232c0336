#include "ros/black_box/recorded_topics.h"

namespace sweep_guard_ros {
namespace {

// Megabytes each, so that few may wait.
constexpr std::uint32_t kMeshes = 16;
constexpr std::uint32_t kVertices = 60;

const std::string kRecordedGuard = "/sweep_guard/";

}  // namespace

std::vector<RecordedTopic> recordedTopics(const ros::NodeHandle& node, const BlackBoxParameters& parameters) {
  std::vector<RecordedTopic> topics = {
      {node.resolveName("tool_pose"), "/tool_pose"},
      {node.resolveName("joint_states"), "/joint_states"},
      {node.resolveName("mesh"), "/mesh", KeptMessages::kEachMesh, kMeshes},
      {node.resolveName("mesh_vertices"), "/mesh_vertices", KeptMessages::kEachVertices, kVertices},
      {"/tf", "/tf", KeptMessages::kEachTransform},
      {"/tf_static", "/tf_static", KeptMessages::kEachTransform},
      {"/diagnostics", "/diagnostics"},
  };
  const auto add = [&](const std::string& name, KeptMessages kept) {
    topics.push_back({parameters.guard + "/" + name, kRecordedGuard + name, kept});
  };
  for (const char* const name : {"warning", "contacts", "prediction", "reflex_warning", "considered_warning",
                                 "time_to_collision", "intend_updates"}) {
    add(name, KeptMessages::kNone);
  }
  for (const char* const latched :
       {"tool", "tool_balls", "intended", "touches", "parameter_descriptions", "parameter_updates"}) {
    add(latched, KeptMessages::kNewest);
  }
  if (parameters.proximity) add("proximity", KeptMessages::kNone);
  if (parameters.interaction) add("interaction", KeptMessages::kNone);
  return topics;
}

}  // namespace sweep_guard_ros
