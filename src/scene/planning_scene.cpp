#include "scene/planning_scene.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "common/frame_name.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_core {
namespace {

using Operation = CollisionObject::Operation;

constexpr size_t kMaxProblems = 10000;  // that are remembered
static_assert(PlanningScene::kMaxObjects == 1000);
constexpr auto kFull = "the planning scene has 1000 objects already: remove some";
constexpr auto kUnknown = "the whole planning scene is not known";
constexpr auto kDetached = "detached, and where it is now is not known";

bool hasShapes(const CollisionObject& object) {
  const auto has_triangles = [](const TriangleSurface& surface) { return !surface.triangles.empty(); };
  return std::any_of(object.shapes.begin(), object.shapes.end(), [&has_triangles](const CollisionShapes& kind) {
    return std::any_of(kind.surfaces_S.begin(), kind.surfaces_S.end(), has_triangles);
  });
}

// MoveIt before 1.1 wants a pose for each shape, later the last ones may be missing.
bool posesFit(const CollisionObject& object) {
  return std::all_of(object.shapes.begin(), object.shapes.end(), [&object](const CollisionShapes& kind) {
    return kind.X_OS.size() <= kind.surfaces_S.size() && (object.X_FO || kind.X_OS.size() == kind.surfaces_S.size());
  });
}

std::string misfit(const CollisionObject& object) {
  return object.X_FO ? "it has more poses than shapes" : "it has not one pose for each shape";
}

void reserve(const std::vector<TriangleSurface>& parts, TriangleSurface& whole) {
  size_t vertices = 0;
  size_t triangles = 0;
  for (const TriangleSurface& part : parts) {
    vertices += part.vertices.size();
    triangles += part.triangles.size();
  }
  whole.vertices.reserve(vertices);
  whole.triangles.reserve(triangles);
}

CollisionShapes joined(std::array<CollisionShapes, 3> kinds) {
  CollisionShapes all;
  for (CollisionShapes& kind : kinds) {
    std::move(kind.surfaces_S.begin(), kind.surfaces_S.end(), std::back_inserter(all.surfaces_S));
    std::move(kind.X_OS.begin(), kind.X_OS.end(), std::back_inserter(all.X_OS));
  }
  return all;
}

}  // namespace

PlanningScene::Body PlanningScene::bodyOf(CollisionObject object) {
  Eigen::Isometry3d X_FO = object.X_FO.value_or(Eigen::Isometry3d::Identity());
  for (auto& [surfaces_S, X_OS] : object.shapes) X_OS.resize(surfaces_S.size(), Eigen::Isometry3d::Identity());
  CollisionShapes shapes = joined(std::move(object.shapes));
  if (object.is_pose_unset && shapes.X_OS.size() == 1) std::swap(X_FO, shapes.X_OS.front());
  return {std::move(object.frame), object.stamp, X_FO, std::move(shapes), ""};
}

SceneObject PlanningScene::placed(const std::string& id, const Body& body) {
  SceneObject object{id, body.frame, body.stamp, {}};
  auto& [vertices, triangles] = object.surface_M;
  reserve(body.shapes.surfaces_S, object.surface_M);
  for (size_t i = 0; i < body.shapes.X_OS.size(); ++i) {
    const Eigen::Isometry3d X_FS = body.X_FO * body.shapes.X_OS[i];
    const TriangleSurface& surface_S = body.shapes.surfaces_S[i];
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Eigen::Vector3d& vertex_S : surface_S.vertices) vertices.emplace_back(X_FS * vertex_S);
    for (const auto& [a, b, c] : surface_S.triangles) triangles.push_back({first + a, first + b, first + c});
  }
  return object;
}

SceneUpdate PlanningScene::apply(PlanningSceneMessage message) {
  if (!message.is_diff) {
    if (std::exchange(awaits_full_scene_, false)) touch(attached_);
    clear(problems_);
  }
  if (!message.is_state_diff && message.names_joints) clear(attached_);
  for (AttachedObject& attached : message.attached) {
    if (message.is_state_diff || attached.object.operation == Operation::kAdd) {
      follow(std::move(attached));
    } else {
      note(attached.object.id, "an attached object changes in a robot_state that is no diff: set is_diff there");
    }
  }
  if (!message.is_diff) clear(world_);
  for (CollisionObject& object : message.objects) follow(std::move(object));
  return update();
}

SceneUpdate PlanningScene::awaitFullScene() {
  awaits_full_scene_ = true;
  touch(world_);
  touch(attached_);
  return update();
}

void PlanningScene::follow(CollisionObject object) {
  const std::string id = object.id;
  if (object.operation == Operation::kRemove && id.empty()) {
    clear(world_);
    clear(problems_);
  } else if (object.operation == Operation::kRemove) {
    world_.erase(id);
    note(id, "");
  } else if (!object.problem.empty()) {
    world_.erase(id);
    note(id, object.problem);
  } else {
    note(id, object.operation == Operation::kMove ? move(std::move(object)) : add(std::move(object)));
  }
}

std::string PlanningScene::add(CollisionObject object) {
  if (!hasShapes(object)) return "it has no shapes";
  const auto found = world_.find(object.id);
  if (object.operation == Operation::kAppend && found != world_.end()) return append(std::move(object), found->second);
  lacks_base_ |= object.operation == Operation::kAppend;
  world_.erase(object.id);
  if (!posesFit(object)) return misfit(object);
  if (isFull()) return kFull;
  const std::string id = object.id;
  world_.emplace(id, bodyOf(std::move(object)));
  return "";
}

std::string PlanningScene::append(CollisionObject object, Body& body) {
  if (!posesFit(object)) return misfit(object);
  if (!object.X_FO && !isSameFrame(object.frame, body.frame)) return "APPEND in another frame than that of the object";
  body.stamp = object.stamp;
  body.shapes = joined({std::move(body.shapes), bodyOf(std::move(object)).shapes, {}});
  return "";
}

std::string PlanningScene::move(CollisionObject object) {
  const auto found = world_.find(object.id);
  if (found == world_.end()) return withoutBase("MOVE of an object that is not in the planning scene");
  Body& body = found->second;
  std::vector<Eigen::Isometry3d> X_OS = joined(std::move(object.shapes)).X_OS;
  const size_t poses = X_OS.size();
  const size_t shapes = body.shapes.X_OS.size();
  const bool fits = poses == shapes;
  const Eigen::Isometry3d X_FO = object.X_FO.value_or(Eigen::Isometry3d::Identity());
  if (fits) body.shapes.X_OS = std::move(X_OS);
  if (fits || object.X_FO) body = {std::move(object.frame), object.stamp, X_FO, std::move(body.shapes), ""};
  if (fits || (object.X_FO && poses == 0)) return "";
  return "MOVE with " + std::to_string(poses) + " poses of " + std::to_string(shapes) + " shapes";
}

void PlanningScene::follow(AttachedObject attached) {
  const std::string id = attached.object.id;
  if (attached.object.operation == Operation::kRemove) {
    detach(id, attached.link);
  } else if (!attached.object.problem.empty()) {
    world_.erase(id);
    attached_.erase(id);
    note(id, attached.object.problem);
  } else {
    note(id, attach(std::move(attached)));
  }
}

std::string PlanningScene::attach(AttachedObject attached) {
  const CollisionObject& object = attached.object;
  const std::string id = object.id;
  const auto found = world_.find(id);
  const bool adds = object.operation == Operation::kAdd;
  const bool takes = adds && found != world_.end() && !hasShapes(object);
  if (object.operation == Operation::kMove) return "MOVE of an attached object: send ADD";
  if (attached.link.empty()) return "attached to a link without name";
  if (!takes && !hasShapes(object)) return withoutBase("attached without shapes, and not in the planning scene");
  if (!takes && !posesFit(object)) return misfit(object);
  if (!adds && attached_.count(id) > 0) return withoutBase("APPEND to an attached object: send ADD");
  Body body = takes ? std::move(found->second) : bodyOf(std::move(attached.object));
  world_.erase(id);
  attached_.erase(id);
  if (isFull()) return kFull;
  body.link = std::move(attached.link);
  attached_.emplace(id, std::move(body));
  return "";
}

void PlanningScene::detach(const std::string& id, const std::string& link) {
  for (auto at = attached_.begin(); at != attached_.end();) {
    auto& [name, body] = *at;
    const bool is_meant = (id.empty() || name == id) && (link.empty() || body.link == link);
    if (is_meant) {
      body.is_place_known = false;
      world_.emplace(name, std::move(body));
      note(name, "");
    }
    at = is_meant ? attached_.erase(at) : std::next(at);
  }
}

std::string PlanningScene::withoutBase(std::string problem) {
  lacks_base_ = true;
  return problem;
}

void PlanningScene::note(const std::string& id, const std::string& problem) {
  touched_.insert(id);
  problems_.erase(id);
  if (!problem.empty()) problems_.emplace(id, problem);
}

template <typename Map>
void PlanningScene::touch(const Map& map) {
  for (const auto& entry : map) touched_.insert(entry.first);
}

template <typename Map>
void PlanningScene::clear(Map& map) {
  touch(map);
  map.clear();
}

std::string PlanningScene::refusalOf(const Body& body) const {
  if (awaits_full_scene_) return kUnknown;
  return body.is_place_known ? "" : kDetached;
}

SceneChange PlanningScene::changeOf(const std::string& id) const {
  const auto problem = problems_.find(id);
  const auto in_world = world_.find(id);
  const auto attached = attached_.find(id);
  SceneChange change;
  change.object.id = id;
  if (attached != attached_.end()) change.link = attached->second.link;
  if (problem != problems_.end()) {
    change.refused = awaits_full_scene_ ? kUnknown : problem->second;
  } else if (in_world != world_.end() && attached != attached_.end()) {
    change.refused = "both in the world and attached to '" + printable(change.link) + "': give one of them another id";
  } else if (in_world != world_.end() || attached != attached_.end()) {
    const Body& body = in_world != world_.end() ? in_world->second : attached->second;
    change.refused = refusalOf(body);
    if (change.refused.empty()) change.object = placed(id, body);
  }
  return change;
}

SceneUpdate PlanningScene::update() {
  SceneUpdate told;
  told.needs_full_scene = std::exchange(lacks_base_, false) || awaits_full_scene_;
  for (const std::string& id : touched_) {
    told.changes.push_back(changeOf(id));
    told.needs_full_scene |= told.changes.back().refused == kDetached;
  }
  touched_.clear();
  while (problems_.size() > kMaxProblems) problems_.erase(problems_.begin());
  return told;
}

}  // namespace sweep_guard_core
