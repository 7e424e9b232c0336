#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/guarded_by.h"
#include "common/pool.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// New vertex positions of a workpiece whose triangles stay.
struct Deformation {
  const std::string& id;
  std::uint32_t revision;  ///< must equal that of the workpiece
  Time stamp;
  SteadyTime received;
  const std::string& frame;               ///< name of the mesh's frame M
  const std::vector<float>& positions_M;  ///< x0 y0 z0 x1 ... [m]; empty: as they were
};

/// What became of an update.
enum class UpdateOutcome {
  kStored,
  kConfirmed,         ///< the workpiece is as it was: nothing is stored
  kIgnored,           ///< it is older than what is known already, and says nothing new
  kUnknownWorkpiece,  ///< there is no workpiece of this id
};

/// Keeps the newest snapshot of every workpiece. Snapshots do not change while they are shared. Unshared
/// snapshots are reused for deformations, which then allocate nothing. One thread calls set(), deform() and
/// remove(), one show(); any thread may call the others. A call that throws keeps the old snapshot.
///
/// An attached workpiece is part of the tool: it has no snapshot, but its shape is watched. While it keeps its shape, to
/// kRigid, set() and deform() return kStored and change nothing; otherwise they throw InvalidInput. remove() finds nothing.
class WorkpieceStore {
 public:
  static constexpr double kRigid =
      1e-3;  ///< distance of a vertex from the shape that an attached workpiece keeps [m], rounding apart

  /// Returns how far a vertex may be from a shape that is kept [m]. Where the shape is found to be is rounded, too.
  /// @param rounding  of the positions of both [m]
  static double rigidWithin(double rounding) { return kRigid + 2.0 * rounding; }

  using OnChange = std::function<void(const Workpieces&)>;

  /// @param on_change  called after every change with all snapshots. Under the lock of the store, which it must not call:
  ///     who takes a snapshot finds that it has been told. A mesh that is swept before it is known what contact with it is
  ///     intended would cause a false warning
  explicit WorkpieceStore(OnChange on_change = [](const Workpieces&) {});

  /// Adds or replaces a workpiece, and sets `updates` and `path_length`: they continue if frame and triangles stay.
  /// @param latest  latest plausible stamp, as a rule now. A snapshot stamped later is from before time went back; any
  ///                stamp may replace it
  /// @returns kIgnored for an older copy of the same revision: latched messages may be delivered again
  /// @throws InvalidInput if the stamp is older than the snapshot's, or if there are 1000 workpieces already
  UpdateOutcome set(Workpiece next, Time latest);

  /// Replaces vertices, times and frame of a workpiece. `updates` and `path_length` continue, even in another frame.
  /// @param latest  as for set()
  /// Without positions it says that the workpiece is still as it was, and confirms the snapshot of its revision and frame.
  /// @returns kIgnored if the workpiece was removed, see remove(), and for what confirms nothing
  /// @throws InvalidInput if the revision differs, if the stamp is older than the snapshot's, or if
  ///     TriangleMesh::deform() refuses the positions
  UpdateOutcome deform(const Deformation& deformation, Time latest);

  /// Adds what a camera sees, or puts it in place of the image before. One thread, which may be another than that of set().
  /// @param image  Workpiece::of_camera
  /// @param latest  as for set()
  /// @throws InvalidInput if the stamp is older than that of the image before, the workpiece of the id is none of a camera, or
  ///     there are 1000 workpieces already
  void show(const std::shared_ptr<const Workpiece>& image, Time latest);

  /// Removes a workpiece.
  /// @param stamp  vertices of this workpiece that are stamped no later than this, or than its snapshot, are ignored; not after
  ///     clearStamps() or 64 more removals
  /// @returns false if there is no such workpiece
  /// @throws InvalidInput if it is what a camera sees
  bool remove(const std::string& id, Time stamp);

  /// A workpiece that is part of the tool, and where the tool's body B holds it.
  struct Attached {
    std::shared_ptr<const Workpiece> workpiece;
    Eigen::Isometry3d X_BM;  ///< [m]
  };

  /// Takes a workpiece out of the snapshots: it is part of the tool.
  /// @param workpiece  a snapshot of this store
  /// @throws InvalidInput if its triangles or its frame are no longer the newest
  void attach(const std::shared_ptr<const Workpiece>& workpiece, const Eigen::Isometry3d& X_BM);
  /// Puts an attached workpiece back.
  /// @param workpiece  of an attached id; not checked
  void detach(Workpiece workpiece);
  std::optional<Attached> attached(const std::string& id) const;  ///< empty: it is not

  bool contains(const std::string& id) const;
  Workpieces snapshot() const;  ///< ascending by id
  /// Returns the snapshots for a tool that has these workpieces as parts.
  /// @throws Error if others are attached meanwhile
  Workpieces snapshotBeside(const std::set<std::string>& attached) const;
  std::shared_ptr<const std::set<std::string>> frames() const;  ///< frames of all workpieces

  /// Clears the stamps of all snapshots, after time went back.
  void clearStamps();

 private:
  struct Buffers {
    Pool<Workpiece> snapshots;
    std::vector<float> positions_M;
  };

  void requireRoom() const;
  std::shared_ptr<const Workpiece> find(const std::string& id) const;
  std::shared_ptr<Workpiece> unusedSnapshot(const Workpiece& current);
  void replace(std::shared_ptr<const Workpiece> snapshot);
  void replaceLocked(std::shared_ptr<const Workpiece> snapshot) REQUIRES(mutex_);
  void updateFrames() REQUIRES(mutex_);
  UpdateOutcome confirm(const Deformation& deformation) const;
  bool wasRemoved(const Deformation& deformation) const;

  const OnChange on_change_;
  mutable Mutex mutex_;
  Workpieces workpieces_ GUARDED_BY(mutex_);
  std::map<std::string, Attached> attached_ GUARDED_BY(mutex_);  // by id
  std::shared_ptr<const std::set<std::string>> frames_ GUARDED_BY(mutex_) =
      std::make_shared<const std::set<std::string>>();
  std::map<std::string, Buffers> buffers_;  // by id, for the triangles of the snapshot; not locked
  std::deque<std::pair<std::string, Time>> removed_ GUARDED_BY(mutex_);  // ids and stamps, the newest last
};

}  // namespace sweep_guard_core
