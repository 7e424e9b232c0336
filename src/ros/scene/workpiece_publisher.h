#pragma once

#include <ros/node_handle.h>
#include <sweep_guard/DeformableMesh.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "common/guarded_by.h"
#include "scene/scene_object.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Publishes workpieces on `mesh` and `mesh_vertices`: a mesh where triangles or frame are new, otherwise new positions, and
/// soon after the last of these the mesh again. So what confirm() says of a workpiece is said of a mesh. A guard that starts
/// later gets all workpieces as they are. Any thread.
class WorkpiecePublisher {
 public:
  /// @param on_guard  called when somebody subscribes to `mesh`, in the queue of the node handle
  WorkpiecePublisher(ros::NodeHandle node, std::function<void()> on_guard);
  WorkpiecePublisher(const WorkpiecePublisher&) = delete;
  WorkpiecePublisher& operator=(const WorkpiecePublisher&) = delete;

  using Object = std::shared_ptr<const sweep_guard_core::SceneObject>;

  /// @param object   not null
  /// @param as_mesh  publishes no positions alone
  void show(const Object& object, bool as_mesh = false);
  void remove(const std::string& id);  ///< also of a workpiece that is not known here
  /// The same, and tells guards that start later, too: they may know it from a process before this one.
  void withdraw(const std::string& id);
  /// Says why a workpiece cannot be given as it is: the guard is UNKNOWN until show() or remove().
  void refuse(const std::string& id, const std::string& why);
  /// Says that those workpieces are as they were for which `rests` returns true. To be called 10 times a second.
  void confirm(const std::function<bool(const std::string& id)>& rests);

  std::string meshTopic() const { return mesh_.getTopic(); }  ///< resolved

 private:
  struct Published {
    Object object;                              // null: none yet, or withdrawn
    std::uint32_t revision = 0;                 // of the newest mesh; 0: none
    std::string refused = {};                   // why; empty: it is as `object` says
    sweep_guard_core::SteadyTime mesh_at = {};  // when the newest mesh was published
    bool has_moved = false;                     // positions are newer than the mesh
    bool moves = false;                         // positions were published since the last confirm()
  };

  static sweep_guard::DeformableMesh messageOf(const std::string& id, const Published& published);
  void publishMesh(Published& published) REQUIRES(mutex_);
  void publishPositions(Published& published) REQUIRES(mutex_);

  sweep_guard_core::Mutex mutex_;
  std::map<std::string, Published> published_ GUARDED_BY(mutex_);  // by id
  std::uint32_t revision_ GUARDED_BY(mutex_);                      // of the newest mesh of all
  ros::Publisher vertices_;
  ros::Publisher mesh_;  // after what its callback uses
};

}  // namespace sweep_guard_ros
