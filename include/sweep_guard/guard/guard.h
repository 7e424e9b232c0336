#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/sweep_test.h"

namespace sweep_guard {

/// One workpiece as it was at a moment. Handed around as a shared snapshot, so that a new deformation never waits for a
/// sweep.
struct Workpiece {
  std::string id;
  std::uint32_t revision = 0;  ///< counts changes of the triangles
  Time stamp;                  ///< of the vertex positions
  SteadyTime received;
  std::string frame;  ///< name of the mesh's frame M
  TriangleMesh mesh_M;
};
using Workpieces = std::vector<std::shared_ptr<const Workpiece>>;

/// Where the tool is at a moment, seen from every frame that a workpiece lives in.
struct ToolPose {
  Time stamp;
  SteadyTime received;
  std::map<std::string, Eigen::Isometry3d> X_MT;  ///< by name of M; a frame whose transform is missing is left out
};

/// One workpiece that was swept, and what was found.
struct SweptObject {
  std::shared_ptr<const Workpiece> workpiece;
  Time interval_start;  ///< stamp of the pose that the sweep began at
  SweepFindings findings;
};

/// One step of the guard: everything that happened up to a pose.
struct SweepReport {
  Time start;                        ///< earliest begin of a sweep; equal to `end` at the first pose
  Time end;                          ///< stamp of the pose
  std::vector<SweptObject> objects;  ///< every workpiece swept, in the order they came; not found: empty triangles
  Workpieces unswept;                ///< workpieces whose frame the pose is not known in

  double margin() const;  ///< largest of the objects [m]
  bool contact() const;   ///< some object was met
};

/// Sweeps the tool from pose to pose, so that no motion goes untested: for each frame from the last pose that was known
/// there. A workpiece's first sweep is a test of the pose alone. One thread.
class Guard {
 public:
  Guard(Tool tool, std::unique_ptr<Detector> detector, const SweepOptions& options);

  /// @param pose  its stamp must not lie before that of the pose before
  /// @throws DeviceError if the detector fails; the next call then sweeps this interval too
  SweepReport sweep(const ToolPose& pose, const Workpieces& workpieces);

  /// Begins anew, as if no pose had come.
  void forget() { last_.clear(); }

  const Tool& tool() const { return tool_; }

 private:
  struct Placed {
    Time stamp;
    Eigen::Isometry3d X_MT;
  };

  void remember(const ToolPose& pose, const Workpieces& workpieces);

  Tool tool_;
  std::unique_ptr<Detector> detector_;
  SweepOptions options_;
  std::map<std::string, Placed> last_;  // by frame
};

}  // namespace sweep_guard
