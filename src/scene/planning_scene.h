#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/scene_object.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// Holds the shapes of one kind in a CollisionObject message, and their poses. S is a shape, O the object.
struct CollisionShapes {
  std::vector<TriangleSurface> surfaces_S;  ///< [m]; each has the vertices that it names; need not be read from a MOVE
  std::vector<Eigen::Isometry3d> X_OS;      ///< of the surface at the same index [m]
};

/// Holds a moveit_msgs/CollisionObject message. A quaternion that is not set (all zeros) is the identity.
struct CollisionObject {
  enum class Operation { kAdd, kRemove, kAppend, kMove };  ///< numbered as in the message

  std::string id;     ///< not checked
  std::string frame;  ///< name of the frame F of the message; not checked
  Time stamp;         ///< epoch: not known
  Operation operation = Operation::kAdd;
  std::optional<Eigen::Isometry3d> X_FO;  ///< [m]; empty: a message of MoveIt before 1.1, whose shapes have poses in F
  bool is_pose_unset = false;             ///< the pose is not set (all zeros); X_FO is the identity
  std::array<CollisionShapes, 3> shapes;  ///< primitives, meshes, planes
  std::string problem;                    ///< why the message cannot be followed; empty: it can
};

/// Holds a moveit_msgs/AttachedCollisionObject message.
struct AttachedObject {
  std::string link;  ///< of the robot
  CollisionObject object;
};

/// Holds what a moveit_msgs/PlanningScene message says of objects. A CollisionObject or AttachedCollisionObject message
/// by itself is a diff of one object.
struct PlanningSceneMessage {
  bool is_diff = true;
  bool is_state_diff = true;             ///< robot_state.is_diff
  bool names_joints = false;             ///< robot_state names a joint
  std::vector<AttachedObject> attached;  ///< robot_state.attached_collision_objects
  std::vector<CollisionObject> objects;  ///< world.collision_objects
};

/// Holds what a planning scene has under one id.
struct SceneChange {
  SceneObject object;   ///< as it is now; without triangles, unless `refused`: there is none any more
  std::string refused;  ///< why the object cannot be given; empty: it can
  std::string link;     ///< that the object is attached to, at the place where it is at that moment; empty: none
};

/// Holds what a message changed in a planning scene.
struct SceneUpdate {
  std::vector<SceneChange> changes;  ///< of each id that the message is about, also if it is as before; ascending
  bool needs_full_scene = false;     ///< the message builds on what is not known here: read the full scene
};

/// Holds the objects of a planning scene, in the world and attached, as MoveIt 1.1 (Noetic) has them after the same
/// messages.
///
/// - ADD replaces an object. APPEND adds shapes to it, in its frame and at its pose, or makes it. All shapes of an
///   object are one surface, in the order in which they came.
/// - Shapes move with the pose of their object. If that is not set, the pose of a single shape becomes it.
/// - MOVE sets frame and pose of an object, and the poses of its shapes if it has as many. Triangles stay as they are.
/// - REMOVE removes the object; all of the world, if it has no id.
/// - A full scene replaces all objects of the world; a robot state with joints that is no diff, all that are attached.
/// - An attached object is not in the world. Detached, it is there again, where the link is at that moment, which only
///   MoveIt knows: it is refused until a message says where.
///
/// The id of a message that cannot be followed is refused until one can, a full scene comes, or all objects of the
/// world are removed. Beyond 10 000 such ids, some are forgotten: no later change says that they are no longer refused.
class PlanningScene {
 public:
  static constexpr size_t kMaxObjects = 1000;  ///< more are refused

  /// @param awaits_full_scene  as after awaitFullScene(); false: none will come
  explicit PlanningScene(bool awaits_full_scene) : awaits_full_scene_(awaits_full_scene) {}

  SceneUpdate apply(PlanningSceneMessage message);

  /// Refuses all objects until the next full scene comes: messages may have been lost.
  SceneUpdate awaitFullScene();

 private:
  struct Body {
    std::string frame;
    Time stamp;
    Eigen::Isometry3d X_FO;
    CollisionShapes shapes;  // as many poses as surfaces
    std::string link;        // that holds it, if it is attached
    bool is_place_known = true;
  };

  static Body bodyOf(CollisionObject object);
  static SceneObject placed(const std::string& id, const Body& body);

  void follow(CollisionObject object);
  void follow(AttachedObject attached);
  // These return why the message cannot be followed; empty: it was.
  std::string add(CollisionObject object);
  std::string append(CollisionObject object, Body& body);
  std::string move(CollisionObject object);
  std::string attach(AttachedObject attached);
  void detach(const std::string& id, const std::string& link);

  bool isFull() const { return world_.size() + attached_.size() >= kMaxObjects; }
  std::string withoutBase(std::string problem);
  void note(const std::string& id, const std::string& problem);
  template <typename Map>
  void touch(const Map& map);
  template <typename Map>
  void clear(Map& map);
  std::string refusalOf(const Body& body) const;
  SceneChange changeOf(const std::string& id) const;
  SceneUpdate update();

  std::map<std::string, Body> world_;
  std::map<std::string, Body> attached_;
  std::map<std::string, std::string> problems_;  // of messages that could not be followed
  std::set<std::string> touched_;                // since the last update
  bool lacks_base_ = false;                      // a message since the last update builds on what is not known
  bool awaits_full_scene_;
};

}  // namespace sweep_guard_core
