#pragma once

#include <memory>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// One workpiece that was swept, and the result.
struct SweptObject {
  std::shared_ptr<const Workpiece> workpiece;
  /// Stamp of the pose that the sweep began at. Times of impact are fractions of the interval from this stamp to the
  /// stamp of the newest pose. A contact that a mesh update caused before this stamp has time 0.
  Time interval_start;
  /// Time by which the pose that the sweep began at is older than the oldest update of the workpiece still kept: the
  /// sweep leaves out how the workpiece moved in between. 0: nothing is left out.
  Duration behind{};
  /// Bodies of several that stay out of reach of the workpiece have no volumes, nor a margin.
  SweepResult result;
};

/// Reports one step of the guard: the sweeps up to one pose.
struct SweepReport {
  Time start;          ///< earliest `interval_start` of `objects`; `end` at the first pose and if there are none
  Time end;            ///< stamp of the pose
  Duration backlog{};  ///< time from the first pose given to Guard::pass() since the last sweep to `end`; 0: none
  std::vector<SweptObject> objects;  ///< every workpiece swept, in the order given to sweep() unless a sweep failed
  Workpieces unplaced;               ///< workpieces that were not swept because their frame is unknown at `end`
  /// Workpieces whose sweep failed, for one body of the tool at least; `objects` has what the others met.
  std::vector<SweepFailure> failures;

  double margin() const;           ///< largest margin of all objects [m]; 0 if there are none
  bool contact() const;            ///< the tool met an object, or it is not ruled out that it did
  bool unintendedContact() const;  ///< the same, but for contacts as intended (Intention)
  bool complete() const;  ///< there is at least one workpiece, and every workpiece was swept with all its updates
};

}  // namespace sweep_guard_core
