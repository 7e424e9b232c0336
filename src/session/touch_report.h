#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/Touches.h>

#include <map>
#include <string>

#include "session/session_bag.h"
#include "session/session_files.h"
#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_session {

/// Keeps the touches that a guard counted in a session, and the newest shape of each workpiece.
class TouchLog {
 public:
  void take(const sweep_guard::DeformableMesh::ConstPtr& mesh) {
    if (mesh->refused.empty()) meshes_[mesh->id] = mesh;
  }
  void take(const sweep_guard::MeshVertices::ConstPtr& vertices) {
    if (!vertices->positions.empty()) vertices_[vertices->id] = vertices;
  }
  void take(const sweep_guard::Touches::ConstPtr& touches) { touches_ = *touches; }
  void readShapes(const SessionFiles& files, const SessionTopics& topics);  ///< takes the newest of each workpiece

  const sweep_guard::Touches& touches() const { return touches_; }

  /// Returns the shape that the touches of a workpiece belong to, in its frame [m]; without triangles it is not known, or lacks
  /// touched ones.
  sweep_guard_core::TriangleSurface surfaceOf(const sweep_guard::ObjectTouches& touches) const;

 private:
  std::map<std::string, sweep_guard::DeformableMesh::ConstPtr> meshes_;  // by id
  std::map<std::string, sweep_guard::MeshVertices::ConstPtr> vertices_;  // by id
  sweep_guard::Touches touches_;
};

/// Returns a CSV file with one line for each touched triangle. The columns are mesh,revision,triangle,sweeps,depth_mm.
std::string touchesCsv(const sweep_guard::Touches& touches);

/// Returns a CSV file with one line for each triangle of the first 4 touched workpieces, as they were at the end; of a
/// workpiece of more than 30 000 triangles only for those touched. The columns are mesh,triangle and the corners
/// x1,y1,z1,...,z3 [m] in the workpiece's frame, counterclockwise from outside if the surface is closed.
std::string surfacesCsv(const TouchLog& log);

}  // namespace sweep_guard_session
