#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

struct FreeSpace;

/// A workpiece at one moment. Threads share snapshots, which must not change meanwhile: a new deformation is another
/// snapshot and never waits for a sweep.
struct Workpiece {
  std::string id;
  std::uint32_t revision = 0;  ///< counts changes of the triangles, as given by the sender
  Time stamp;                  ///< of the vertex positions
  SteadyTime received;         ///< when these positions arrived
  std::string frame;           ///< name of the mesh frame M
  TriangleMesh mesh_M;
  /// Number of updates of the vertex positions since the triangles came, or came again in another frame.
  std::uint64_t updates = 0;
  double path_length = 0.0;  ///< upper bound on any vertex's path length in M over these updates [m]
  /// What a camera saw: the mesh is a grid, and `updates` is the number of the image. Whatever was not where its vertices were
  /// before came or went since the image before.
  bool of_camera = false;
  /// What a camera knows to be free, in M; null: nothing.
  std::shared_ptr<const FreeSpace> free_space = nullptr;
  bool of_other_tool = false;  ///< a link of another tool: Guard::follow() moves its frame, and it does not age
};

/// Counts one update: sets `updates` and `path_length` of a workpiece from those before the update.
/// @param before   has the same triangles; not checked
/// @param updated  has its new vertex positions already
void countUpdate(const Workpiece& before, Workpiece& updated);

/// Snapshots of different workpieces: none null, each id once (not checked).
using Workpieces = std::vector<std::shared_ptr<const Workpiece>>;

/// Erases the entries of a map by id whose workpiece is not among these.
template <typename Entry>
void eraseRemoved(const Workpieces& workpieces, std::map<std::string, Entry>& by_id) {
  for (auto entry = by_id.begin(); entry != by_id.end();) {
    const auto same = [&](const auto& workpiece) { return workpiece->id == entry->first; };
    const bool there = std::any_of(workpieces.begin(), workpieces.end(), same);
    entry = there ? std::next(entry) : by_id.erase(entry);
  }
}

/// A workpiece that could not be swept, and why: the detector failed, memory ran out or Guard::stop() was called.
struct SweepFailure {
  std::shared_ptr<const Workpiece> workpiece;
  std::string reason;
};

}  // namespace sweep_guard_core
