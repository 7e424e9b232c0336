#include "ros/scene/scene_reader.h"

#include <map>

#include "ros/scene/marker_reader.h"
#include "ros/scene/planning_scene_reader.h"
#include "ros/scene/single_mesh_readers.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

class SingleMeshReader : public SceneReader {
 public:
  SingleMeshReader(ReadSingleMesh read_mesh, const EnvironmentTopic& topic) : read_mesh_(read_mesh), topic_(topic) {}

  sweep_guard_core::SceneUpdate read(const MessageValue& message, sweep_guard_core::Time /*now*/) override {
    sweep_guard_core::SceneUpdate update;
    update.changes.emplace_back().object = read_mesh_(message, topic_);
    return update;
  }
  bool isComplete() const override { return true; }

 private:
  const ReadSingleMesh read_mesh_;
  const EnvironmentTopic topic_;
};

using Make = std::unique_ptr<SceneReader> (*)(const EnvironmentTopic& topic);

template <ReadSingleMesh kRead>
std::unique_ptr<SceneReader> makeSingle(const EnvironmentTopic& topic) {
  return std::make_unique<SingleMeshReader>(kRead, topic);
}

std::unique_ptr<SceneReader> makeMarkers(const EnvironmentTopic& topic) {
  return std::make_unique<MarkerReader>(topic);
}

template <bool kHasFullScenes>
std::unique_ptr<SceneReader> makePlanningScene(const EnvironmentTopic& topic) {
  return std::make_unique<PlanningSceneReader>(topic, kHasFullScenes);
}

const std::map<std::string, Make>& readers() {
  static const std::map<std::string, Make> kReaders = {{"mesh_msgs/MeshGeometryStamped", makeSingle<readMeshGeometry>},
                                                       {"mesh_msgs/TriangleMeshStamped", makeSingle<readTriangleMesh>},
                                                       {"moveit_msgs/CollisionObject", makePlanningScene<false>},
                                                       {"moveit_msgs/PlanningScene", makePlanningScene<true>},
                                                       {"pcl_msgs/PolygonMesh", makeSingle<readPolygonMesh>},
                                                       {"shape_msgs/Mesh", makeSingle<readShapeMesh>},
                                                       {"visualization_msgs/Marker", makeMarkers},
                                                       {"visualization_msgs/MarkerArray", makeMarkers}};
  return kReaders;
}

}  // namespace

std::unique_ptr<SceneReader> makeSceneReader(const std::string& datatype, const EnvironmentTopic& topic) {
  const auto found = readers().find(datatype);
  if (found != readers().end()) return found->second(topic);
  std::string known;
  for (const auto& [name, make] : readers()) known += (known.empty() ? "" : ", ") + name;
  throw sweep_guard_core::InvalidInput("messages of type " + sweep_guard_core::printable(datatype) +
                                       " describe no workpieces that scene_input knows: it knows " + known);
}

}  // namespace sweep_guard_ros
