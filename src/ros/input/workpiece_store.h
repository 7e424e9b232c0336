#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ros/input/input_record.h"
#include "ros/log_throttle.h"
#include "sweep_guard/common/pool.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// The newest snapshot of every workpiece. Takes the messages in, checked and copied once; hands out what is shared and
/// does not change while anybody holds it: snapshots of deformations that nobody holds any more are used again, so that
/// nothing is allocated for them in the long run. A message that is refused leaves the snapshot before, and tells the
/// monitor. Messages come in by one thread; any thread may ask.
class WorkpieceStore {
 public:
  WorkpieceStore(size_t max_triangles, sweep_guard_core::WarningMonitor& monitor);

  void accept(const sweep_guard::DeformableMesh& msg);
  void accept(const sweep_guard::MeshVertices& msg);

  sweep_guard_core::Workpieces snapshot() const;
  std::shared_ptr<const std::set<std::string>> frames() const;  ///< that the workpieces live in

  /// Time went back: every snapshot counts as without a stamp until a new one comes.
  void timeJumped();

  const InputRecord& meshes() const { return meshes_; }
  const InputRecord& vertices() const { return vertices_; }

 private:
  // Of one workpiece, as long as its triangles stay.
  struct Deformations {
    sweep_guard_core::Pool<sweep_guard_core::Workpiece> snapshots;
    std::vector<float> positions_M;
  };

  template <typename Msg>
  std::optional<std::string> refusalOf(const Msg& msg, InputRecord& record);
  void store(const sweep_guard::DeformableMesh& msg);
  void store(const sweep_guard::MeshVertices& msg);
  std::shared_ptr<const sweep_guard_core::Workpiece> find(const std::string& id) const;
  void checkOrder(const sweep_guard_core::Workpiece& current, sweep_guard_core::Time stamp) const;
  std::shared_ptr<sweep_guard_core::Workpiece> deformed(const sweep_guard_core::Workpiece& current,
                                                        const std::vector<float>& positions_M);
  void replace(std::shared_ptr<const sweep_guard_core::Workpiece> snapshot);
  void remove(const std::string& id);
  void gatherFrames();

  const size_t max_triangles_;
  sweep_guard_core::WarningMonitor& monitor_;
  LogThrottle log_;
  mutable std::mutex mutex_;
  sweep_guard_core::Workpieces workpieces_;  // ascending by id
  std::shared_ptr<const std::set<std::string>> frames_ = std::make_shared<const std::set<std::string>>();
  std::map<std::string, Deformations> deformations_;  // by id; of the thread that accepts
  InputRecord meshes_;
  InputRecord vertices_;
};

}  // namespace sweep_guard_ros
