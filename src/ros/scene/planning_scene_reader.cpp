#include "ros/scene/planning_scene_reader.h"

#include <algorithm>
#include <utility>

#include "common/rotation_between.h"
#include "ros/scene/placed_message.h"
#include "scene/primitives.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::CollisionObject;
using sweep_guard_core::CollisionShapes;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::TriangleSurface;

using ReadSurface = TriangleSurface (*)(const MessageValue& shape);

double dimension(const MessageValue& primitive, size_t index) {
  const auto dimensions = primitive["dimensions"].elements();
  if (index < dimensions.size()) return dimensions[index].number();
  throw InvalidInput("a primitive has " + std::to_string(dimensions.size()) + " dimensions, too few for its type");
}

// The numbers are those of shape_msgs/SolidPrimitive.
TriangleSurface readPrimitive(const MessageValue& primitive) {
  const auto at = [&](size_t index) { return dimension(primitive, index); };
  switch (primitive["type"].integer()) {
    case 1:
      return sweep_guard_core::boxPrimitive({at(0), at(1), at(2)});
    case 2:
      return sweep_guard_core::spherePrimitive(at(0));
    case 3:
      return sweep_guard_core::cylinderPrimitive(/*radius=*/at(1), /*height=*/at(0));
    case 4:
      return sweep_guard_core::conePrimitive(/*radius=*/at(1), /*height=*/at(0));
    default:
      throw InvalidInput("a primitive is neither a box, a sphere, a cylinder nor a cone");
  }
}

// Its indices are checked here, because the surfaces of an object become one.
TriangleSurface readCollisionMesh(const MessageValue& mesh) {
  TriangleSurface surface{mesh["vertices"].positions(), mesh["triangles"].triangles()};
  for (const auto& triangle : surface.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= surface.vertices.size())
      throw InvalidInput("a triangle of a mesh names a vertex that it has not");
  }
  return surface;
}

// The points of a plane (a, b, c, d) are those with ax + by + cz + d = 0; what is below them is solid.
TriangleSurface readPlane(const MessageValue& plane) {
  const auto coef = plane["coef"].elements();
  const Eigen::Vector3d normal(coef.at(0).number(), coef.at(1).number(), coef.at(2).number());
  const double length = normal.norm();
  const double distance = -coef.at(3).number() / length;
  if (!(length > 1e-10) || !std::isfinite(distance)) throw InvalidInput("a plane has no normal, or is not finite");
  const Eigen::Vector3d up = normal / length;
  const Eigen::Quaterniond R = sweep_guard_core::rotationBetween(Eigen::Vector3d::UnitZ(), up);
  TriangleSurface surface = sweep_guard_core::floorPrimitive();
  for (Eigen::Vector3d& vertex : surface.vertices) vertex = R * vertex + distance * up;
  return surface;
}

CollisionShapes readShapes(const MessageValue& object, const char* shapes, const char* poses, bool geometry,
                           ReadSurface read) {
  CollisionShapes found;
  if (geometry) {
    for (const MessageValue& shape : object[shapes].elements()) found.surfaces_S.push_back(read(shape));
  }
  for (const MessageValue& pose : object[poses].elements()) found.X_OS.push_back(poseIn(pose).X);
  return found;
}

void readGeometry(const MessageValue& message, CollisionObject& object) {
  const bool geometry = object.operation != CollisionObject::Operation::kMove;
  object.shapes = {readShapes(message, "primitives", "primitive_poses", geometry, readPrimitive),
                   readShapes(message, "meshes", "mesh_poses", geometry, readCollisionMesh),
                   readShapes(message, "planes", "plane_poses", geometry, readPlane)};
}

CollisionObject readObject(const MessageValue& message, const EnvironmentTopic& topic) {
  CollisionObject object;
  object.id = message["id"].text();
  const std::int64_t operation = message["operation"].integer();
  if (operation < 0 || operation > 3) {
    object.problem = "its operation is none of ADD, REMOVE, APPEND, MOVE";
    return object;
  }
  object.operation = static_cast<CollisionObject::Operation>(operation);
  if (object.operation == CollisionObject::Operation::kRemove) return object;
  try {
    const auto header = objectAt(message["header"], topic.frame);
    object.frame = header.frame;
    object.stamp = header.stamp;
    if (message.has("pose")) {
      const PoseInMessage pose = poseIn(message["pose"]);
      object.X_FO = pose.X;
      object.is_pose_unset = pose.is_unset;
    }
    readGeometry(message, object);
  } catch (const InvalidInput& error) {
    object.problem = error.what();
  }
  return object;
}

sweep_guard_core::PlanningSceneMessage readPlanningScene(const MessageValue& message, const EnvironmentTopic& topic) {
  const MessageValue state = message["robot_state"];
  sweep_guard_core::PlanningSceneMessage scene;
  scene.is_diff = message["is_diff"].flag();
  scene.is_state_diff = state["is_diff"].flag();
  scene.names_joints = state["joint_state"]["name"].size() + state["multi_dof_joint_state"]["joint_names"].size() > 0;
  for (const MessageValue& attached : state["attached_collision_objects"].elements())
    scene.attached.push_back({std::string(attached["link_name"].text()), readObject(attached["object"], topic)});
  for (const MessageValue& object : message["world"]["collision_objects"].elements())
    scene.objects.push_back(readObject(object, topic));
  return scene;
}

}  // namespace

// Only a full scene ends the need for one.
sweep_guard_core::SceneUpdate PlanningSceneReader::apply(sweep_guard_core::PlanningSceneMessage message) {
  if (!message.is_diff) needs_full_scene_ = false;
  sweep_guard_core::SceneUpdate update = scene_.apply(std::move(message));
  needs_full_scene_ |= update.needs_full_scene;
  update.needs_full_scene = needs_full_scene_ && has_full_scenes_;
  return update;
}

sweep_guard_core::SceneUpdate PlanningSceneReader::read(const MessageValue& message, sweep_guard_core::Time /*now*/) {
  if (message.has("world")) {
    has_octomap_ |= message["world"]["octomap"]["octomap"]["data"].size() > 0;
    return apply(readPlanningScene(message, topic_));
  }
  sweep_guard_core::PlanningSceneMessage diff;
  diff.objects.push_back(readObject(message, topic_));
  return apply(std::move(diff));
}

sweep_guard_core::SceneUpdate PlanningSceneReader::restart() {
  if (!has_full_scenes_) return {};
  needs_full_scene_ = true;
  return scene_.awaitFullScene();
}

}  // namespace sweep_guard_ros
