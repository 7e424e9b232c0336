#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "guard/detectors.h"
#include "guard/displacements.h"
#include "guard/moving_mesh.h"
#include "guard/pose_histories.h"
#include "guard/sweep_checker.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

struct SweepSetup {
  const Tool& tool;
  Detectors& detectors;
  const SweepOptions& options;
  DisplacementCache& displacements;
  const AllowedPairs& allowed;
  const Intentions& intentions;
  const FrameMotions& frames;  ///< of those that move on their own
  SpeedLimits limits;          ///< faster motion is a jump
  bool several;                ///< the tool is one of several bodies: where it stays out of reach, it has no volumes
  std::function<void()> before_sweep;  ///< called before every sweep; may throw to give up
};

/// Sweeps one body of the tool along the measured poses; Guard says what is swept. Keeps the poses that may be swept again for
/// every frame, and the last sweep of every workpiece.
class MeasuredSweeps {
 public:
  /// Adds a pose that the next sweep passes through.
  /// @param body    pose of the swept body at that time
  /// @param frames  that move on their own; those of the pose by these names do not count
  void pass(const PoseWithFrames& pose, const BodyPose& body, const FrameMotions& frames);

  /// Sweeps through the poses passed since the last sweep to this pose. Against a workpiece in a frame that moves on its own,
  /// up to the newest measured pose of the frame, if that pose is older. A workpiece that has other triangles is swept with the
  /// new triangles, and for the last time with the replaced ones.
  /// @param arrived      pose of the swept body; empty: it was swept to `pose` already and no pose was passed since, so that
  ///     it is swept on to where the frames that move on their own are known now
  /// @param[out] report  overwritten; its buffers are used again
  void sweep(const SweepSetup& setup, const PoseWithFrames& pose, const std::optional<BodyPose>& arrived,
             const Workpieces& workpieces, SweepReport& report);

  /// Takes the last sweep back: its report was lost. The next one repeats it.
  void takeBack() noexcept;

  /// Forgets all poses, sweeps and contacts.
  void reset();

  /// Forgets the contacts of a tool or a detector that was exchanged, and that the tool was outside.
  void forgetContacts();

 private:
  struct Swept {
    // Newest last. Older ones stay while later poses may have older stamps: stamps of meshes may run ahead.
    Workpieces deformations;
    std::uint64_t pose = 0;  // number of the pose of the last sweep
    SweepCache cache = {};
    bool incomplete = false;   // deformations before the first of these are forgotten
    std::uint64_t before = 0;  // `pose` before the last sweep
    bool grown = false;        // the last sweep has added a deformation
    bool reported = false;     // of triangles that were replaced: by the last sweep
  };

  // How far the sweep of a workpiece has come: poses by their indices. It sweeps meshes_.
  struct Passage {
    const PoseHistory& history;
    size_t begin;  // where the last sweep ended; what is before is swept again
    size_t last;
    size_t next;          // where the next segment begins
    size_t start = next;  // of the segment, which path_M_ holds
    size_t end = next;
    size_t from = next;  // of the motion under test
    size_t to = next;

    size_t beginOfNew() const { return std::clamp(begin, start, end); }
    bool isNew() const { return from >= beginOfNew(); }
  };

  void begin(const SweepSetup& setup, const PoseWithFrames& pose, const std::optional<BodyPose>& arrived,
             const Workpieces& workpieces, SweepReport& report);
  void end(const PoseWithFrames& pose, SweepReport& report);
  void sweepObject(const SweepSetup& setup, const std::shared_ptr<const Workpiece>& workpiece, Swept& swept,
                   SweepReport& report, SweptObject& object);
  void sweepReplaced(const SweepSetup& setup, const PoseWithFrames& pose, SweepReport& report);
  Passage passageTo(const SweepSetup& setup, const std::shared_ptr<const Workpiece>& workpiece, Swept& swept,
                    SweptObject& object);
  void addMeshes(const SweepSetup& setup, Time pose, const std::shared_ptr<const Workpiece>& workpiece, Swept& swept,
                 SweptObject& object);
  static void endPassage(const Passage& passage, const std::shared_ptr<const Workpiece>& workpiece, Swept& swept);
  bool nextMotion(const SweepSetup& setup, const SweepResult& found, Passage& passage);
  bool nextSegment(const SweepSetup& setup, Passage& passage);
  size_t cutMotion(const SweepSetup& setup, const Passage& passage);
  void confirm(const Passage& passage, const SweepResult& found);
  void keep(const Passage& passage, Time end, SweepResult& result, SweptObject& object);
  static const std::shared_ptr<const Workpiece>& deformationAt(Time pose, const Workpiece& newest, Swept& swept);
  Swept firstOf(const std::shared_ptr<const Workpiece>& workpiece, std::uint64_t swept_to) const;
  void replace(Swept& swept, const std::shared_ptr<const Workpiece>& workpiece);
  Swept& lastSwept(const std::shared_ptr<const Workpiece>& workpiece);
  void forgetRemoved(const Workpieces& workpieces);
  std::uint64_t firstUnswept(const std::string& frame, std::uint64_t newest) const;

  PoseHistories poses_;
  std::map<std::string, Swept> swept_;  // by id
  // By id, with the triangles that were replaced, until they are swept to a pose at which the workpiece has the new ones.
  std::map<std::string, Swept> replaced_;
  std::uint64_t swept_to_ = 0;               // number of the pose of the last sweep
  std::optional<SteadyTime> waiting_since_;  // when the first pose passed since then was received
  Path path_M_;                              // of the segment under test
  std::vector<Motion> sub_motions_M_;        // of a motion along the segment
  std::vector<MovingMesh> meshes_;           // that the workpiece under test may have been
  SweepChecker sweep_checker_;
  SweepCache cache_;  // kept apart while the sweep may still fail
};

}  // namespace sweep_guard_core
