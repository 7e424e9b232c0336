#include "ros/scene/marker_reader.h"

#include <algorithm>
#include <utility>

#include "ros/scene/placed_message.h"
#include "scene/primitives.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::SceneChange;
using sweep_guard_core::SceneUpdate;
using sweep_guard_core::Time;
using sweep_guard_core::TriangleSurface;

// Of visualization_msgs/Marker.
constexpr std::int64_t kDelete = 2;
constexpr std::int64_t kDeleteAll = 3;
constexpr std::int64_t kCube = 1;
constexpr std::int64_t kSphere = 2;
constexpr std::int64_t kCylinder = 3;
constexpr std::int64_t kMeshResource = 10;
constexpr std::int64_t kTriangleList = 11;

bool isWorkpiece(std::int64_t type) {
  return type == kCube || type == kSphere || type == kCylinder || type == kMeshResource || type == kTriangleList;
}

// In the frame of the pose, of the size that the marker's scale multiplies.
TriangleSurface unitPrimitive(std::int64_t type) {
  if (type == kCube) return sweep_guard_core::boxPrimitive({1.0, 1.0, 1.0});
  return type == kSphere ? sweep_guard_core::spherePrimitive(0.5) : sweep_guard_core::cylinderPrimitive(0.5, 1.0);
}

Eigen::Vector3d scaleOf(const MessageValue& marker) {
  const MessageValue scale = marker["scale"];
  Eigen::Vector3d xyz(scale["x"].number(), scale["y"].number(), scale["z"].number());
  if (xyz.allFinite() && (xyz.array() != 0.0).all()) return xyz;
  throw InvalidInput("its scale has a component that is 0, NaN or infinite");
}

void placeMarker(const MessageValue& marker, TriangleSurface& surface) {
  const Eigen::Vector3d scale = scaleOf(marker);
  const Eigen::Isometry3d X_FM = poseIn(marker["pose"]).X;
  for (Eigen::Vector3d& vertex : surface.vertices) vertex = X_FM * scale.cwiseProduct(vertex);
}

SceneChange gone(const std::string& id) {
  SceneChange change;
  change.object.id = id;
  return change;
}

}  // namespace

SceneUpdate MarkerReader::read(const MessageValue& message, Time now) {
  SceneUpdate update;
  if (!message.has("markers")) {
    follow(message, now, update);
  } else {
    for (const MessageValue& marker : message["markers"].elements()) follow(marker, now, update);
  }
  return update;
}

void MarkerReader::follow(const MessageValue& marker, Time now, SceneUpdate& update) {
  const std::int64_t action = marker["action"].integer();
  const std::int64_t type = marker["type"].integer();
  const std::string space(marker["ns"].text());
  if (action == kDeleteAll) return clear(update);
  if (!topic_.namespaces.empty() && topic_.namespaces.count(space) == 0) return;
  const std::string id = (space.empty() ? topic_.id : space) + "/" + std::to_string(marker["id"].integer());
  if (action != kDelete && !isWorkpiece(type)) ++others_;
  if (action == kDelete || !isWorkpiece(type)) {
    if (markers_.erase(id) > 0) update.changes.push_back(gone(id));
    return;
  }
  if (markers_.count(id) == 0 && markers_.size() >= sweep_guard_core::PlanningScene::kMaxObjects) {
    if (!too_many_) update.changes.push_back(tooMany());
    return;
  }
  Marker& known = markers_[id];
  const auto lifetime = marker["lifetime"].duration();
  known.expires = lifetime == lifetime.zero() ? Time() : now + lifetime;
  SceneChange change = gone(id);
  try {
    sweep_guard_core::SceneObject object = objectAt(marker["header"], topic_.frame);
    object.id = id;
    object.surface_M = surfaceOf(marker, type, known);
    placeMarker(marker, object.surface_M);
    change.object = std::move(object);
  } catch (const InvalidInput& error) {
    change.refused = error.what();
  }
  update.changes.push_back(std::move(change));
}

TriangleSurface MarkerReader::surfaceOf(const MessageValue& marker, std::int64_t type, Marker& known) {
  if (type == kTriangleList) return known.welding.weld(marker["points"].positions());
  if (type == kMeshResource) return surfaceOfResource(std::string(marker["mesh_resource"].text()), known);
  return unitPrimitive(type);
}

// A file is read once for each marker, also one that cannot be read.
TriangleSurface MarkerReader::surfaceOfResource(const std::string& uri, Marker& known) {
  if (known.resource != uri) {
    known.resource = uri;
    known.unread.clear();
    try {
      known.surface_R = readMesh(locateMesh(uri, {"/"}), /*follow_link=*/true);
    } catch (const InvalidInput& error) {
      known.unread = error.what();
    }
  }
  if (!known.unread.empty()) throw InvalidInput(known.unread);
  return known.surface_R;
}

std::string MarkerReader::leftOut() const {
  return others_ == 0 ? std::string()
                      : std::to_string(others_) +
                            " markers of other types are left out: lists of shapes, lines, points, arrows, texts";
}

void MarkerReader::clear(SceneUpdate& update) {
  for (const auto& [id, marker] : markers_) update.changes.push_back(gone(id));
  if (too_many_) update.changes.push_back(gone(tooMany().object.id));
  too_many_ = false;
  markers_.clear();
}

SceneChange MarkerReader::tooMany() {
  too_many_ = true;
  SceneChange change = gone(topic_.id + "/too many");
  change.refused = "more than 1000 markers that are workpieces: choose some by `namespaces`. DELETEALL ends this";
  return change;
}

SceneUpdate MarkerReader::expire(Time now) {
  SceneUpdate update;
  for (auto marker = markers_.begin(); marker != markers_.end();) {
    if (marker->second.expires == Time() || now < marker->second.expires) {
      ++marker;
    } else {
      update.changes.push_back(gone(marker->first));
      marker = markers_.erase(marker);
    }
  }
  return update;
}

}  // namespace sweep_guard_ros
