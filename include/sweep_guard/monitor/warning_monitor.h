#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sweep_guard/common/mutex.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/monitor/reason.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_core {

class Faults;
class Refusals;
class SweptWorkpieces;
class Tool;
class WorkpieceWarnings;
struct SampledQuery;

/// Collects the inputs of the warning: received poses and workpieces, refusals, and sweeps.
/// Any thread may call any function at any time. The warning may be computed at any time, so a silent input is noticed,
/// too.
class WarningMonitor {
 public:
  /// State of the monitor when a pose was received. A sweep to that pose clears only faults reported before it.
  struct Checkpoint {
    /// Counts restarts: restart(), timeJumped(), end(), disable() and enable() that change something, and a test of the
    /// detector that is passed after one that failed.
    std::uint64_t epoch = 0;
    std::uint64_t faults = 0;  ///< number of faults reported before

    /// Returns whether the monitor was not restarted between the two checkpoints.
    bool continues(const Checkpoint& previous) const { return epoch == previous.epoch; }
  };

  /// @param limits    in the ranges of WarningLimits; not checked
  /// @param on_fault  called after every fault, refusal, loss, drop, test of the detector and restart, except where a
  ///     function says otherwise, in the reporting thread, so maybe in several at once; may call the monitor; not empty
  /// @param waiting_since  returns when the oldest pose that is not yet swept was received; empty: none waits. Called
  ///     by warning(), disableBelow() and acknowledge(), maybe by several at once; not empty
  /// @param hung  returns the name of a thread that makes no progress, a text that outlives the monitor; null: none.
  ///     Called as the one before, and by meshProblems()
  explicit WarningMonitor(
      const WarningLimits& limits, std::function<void()> on_fault = [] {},
      std::function<std::optional<SteadyTime>()> waiting_since = [] { return std::nullopt; },
      std::function<const char*()> hung = [] { return nullptr; });
  ~WarningMonitor();
  WarningMonitor(const WarningMonitor&) = delete;
  WarningMonitor& operator=(const WarningMonitor&) = delete;

  /// Sets the ids of the workpieces without which the warning is not clear.
  void require(const std::set<std::string>& ids);

  /// Sets the tool whose links the text names.
  void setTool(const Tool& tool);

  /// Sets the guards of other tools: the warning is not clear while one of them is silent for longer than `pose_timeout`.
  /// @param names  each once; not checked
  void requireTools(const std::vector<std::string>& names);

  /// Reports a pose of another tool that counts. Does nothing if there is no such tool.
  void toolHeard(const std::string& name, const Timestamps& pose);

  /// Reports why poses of another tool do not count. The warning is not clear until toolHeard(). Does nothing if there is no
  /// such tool.
  void toolUnknown(const std::string& name, const std::string& problem);

  /// Returns what is known of the other tools, in the order of requireTools().
  std::vector<WarningInputs::OtherTool> otherTools() const;

  /// Reports the newest transform of a frame of workpieces that moves: the warning is not clear while it is late. A
  /// transform is late if it is older than `pose_timeout` and the period of the frame, which counts up to
  /// `pose_timeout` and is the median of its last 16 intervals; that ends 1 s after it was last late. Does not call
  /// on_fault.
  void frameHeard(const std::string& frame, Time stamp, const Instant& now);
  /// Sets of which frames frameHeard() counts; the others are forgotten.
  void setMovingFrames(const std::set<std::string>& frames);

  Checkpoint checkpoint() const;

  /// Reports that an input was refused or failed. The warning is not clear until a pose received later has been swept.
  /// @param reason  not of kDegraded, which does not change the level, and not kMeshInvalid, kSelftest or kCrosscheck:
  ///     that sweep would also end what other functions report under these. Not checked
  void fault(Reason reason, const std::string& message);

  /// Reports an exception that ended a piece of work, as a fault. It ends at a restart, or when a pose received later
  /// is swept, 0.1 s after `now` at the earliest, so that it is seen. It replaces the failure before, and is lasting if
  /// that one was. Needs no memory from the heap and does not call on_fault.
  /// @param message  not null; cut after 159 bytes
  /// @param lasting  ends at restart() only: a later pose does not make up for it
  void failed(Reason reason, const char* message, SteadyTime now, bool lasting = false) noexcept;

  /// Reports that a whole mesh was refused. The warning is not clear until meshAccepted(), because the workpiece that
  /// the mesh describes is unknown. Refusals of 1024 ids are kept, of meshes and of vertices each. That of another id
  /// lasts as long as the monitor.
  /// @param received  when the message was received: meshes are accepted later than they are refused
  void meshRefused(const std::string& id, const std::string& message, SteadyTime received);

  /// Reports that a good mesh came, or that the workpiece was removed. Clears the refusals of messages of this id that
  /// were received no later.
  /// @returns whether a mesh was refused until then
  bool meshAccepted(const std::string& id, SteadyTime received);

  /// Reports that vertices were refused. The warning is not clear until verticesAccepted() or meshAccepted().
  void verticesRefused(const std::string& id, const std::string& message, SteadyTime received);

  /// Reports accepted vertices. Clears refusals of vertices of this id that were received no later; a refused mesh
  /// stays until meshAccepted().
  void verticesAccepted(const std::string& id, SteadyTime received);

  /// Reports that a workpiece is still as it was: its age begins anew. Does not call on_fault.
  void confirmed(const std::string& id, const Timestamps& timestamps);

  /// Returns when the workpieces that age were last heard of, ascending by id.
  std::vector<std::pair<std::string, Timestamps>> heard() const;

  /// Reports a message on a mesh topic that belongs to no workpiece: its id is unknown, or it cannot be read. The
  /// warning is not clear until 1 s after the last of these.
  void meshUnread(const std::string& message, SteadyTime now);

  /// Reports that an update of a workpiece was dropped unread. The warning is not clear until that workpiece is swept
  /// with an update that was received later, or is removed. Does nothing if there is no such workpiece.
  /// @param received  when the dropped update was received
  void updateDropped(const std::string& id, SteadyTime received);

  /// Reports what a test of the detector found. The warning is not clear while it says something. A test that is passed
  /// after one that failed restarts: what was swept before does not count. This restart() keeps contacts, lasting
  /// failures and a disagreement of the detectors.
  /// @param failure  empty: the detector has passed
  void detectorTested(const std::string& failure);

  /// Reports that a second detector disagreed about a query. The warning is not clear until restart(). Does nothing if
  /// the monitor was restarted since the query's epoch. Does not call on_fault: its thread may be a slow one.
  /// @param missed  triangles that only the second detector found: ascending. They count as a contact that is over if
  ///     the query was about a measured sweep, and the workpiece still has these triangles and this frame. While a
  ///     contact lasts, they are added to it if it is with this workpiece, and are not reported if it is with another
  void detectorsDisagree(const std::string& message, const SampledQuery& query,
                         const std::vector<std::uint32_t>& missed, SteadyTime now);

  /// Reports that poses were sent and did not arrive. The warning says so for the hold time; its level stays.
  void posesLost(const std::string& message, SteadyTime now);

  /// Sets the newest snapshots of all workpieces, ascending by id (not checked). Where triangles replace others in the same
  /// frame, what was swept and predicted with those counts until these are swept and predicted, for up to 50 ms.
  /// @param now  when they came; empty: each when it was received
  void setWorkpieces(const Workpieces& workpieces, std::optional<SteadyTime> now = {});

  /// Reports a sweep to a pose, and clears the faults from before the pose's checkpoint. Does nothing if the monitor
  /// was restarted since the checkpoint; if that was by timeJumped(), a contact counts as one that is over. Each
  /// failure in the report becomes a new fault, kDetectorFault. The warning reports jumps for the hold time; its level
  /// stays.
  /// @param checkpoint  taken when the pose was received
  void swept(const SweepReport& report, const Timestamps& pose, const Checkpoint& checkpoint, SteadyTime now);

  /// Reports that the path predicted from a swept pose was tested. Does nothing if the monitor was restarted since the
  /// checkpoint. Each failure in the prediction becomes a new fault, kDetectorFault.
  /// @param checkpoint  that of the pose
  /// @param took        time that the prediction and its sweeps took
  void predicted(const Prediction& prediction, const Timestamps& pose, const Checkpoint& checkpoint, const Instant& now,
                 Duration took = {});

  /// Acknowledges the considered warning of a workpiece. Level and reasons stay; Warning::acknowledged and the text say
  /// so, unless another workpiece has a considered warning that is not acknowledged: the warning then names that one.
  /// An acknowledgement holds for one mesh of one workpiece. It ends at kReflex and kContact, whatever workpiece is
  /// met; `acknowledge_time` later; when the mesh is replaced or removed; with a restart; and by endAcknowledgement(),
  /// which the caller must call once the tool has left. Does not call on_fault.
  /// @returns why not; empty: acknowledged
  std::string acknowledge(const std::string& id, const Instant& now);
  /// Returns why acknowledge() would refuse; empty: it would not.
  std::string whyNotAcknowledged(const std::string& id, const Instant& now) const;

  /// Ends the acknowledgement of a workpiece, if there is one. Does not call on_fault.
  void endAcknowledgement(const std::string& id);

  /// Returns the workpieces that are acknowledged.
  std::vector<std::string> acknowledged(SteadyTime now) const;

  /// Reports that earlier sweeps no longer count, because time went back, or the machine was suspended. Restarts, and
  /// keeps contacts, lasting failures and a disagreement of the detectors. kTimeJump lasts until a pose received later
  /// is swept. A contact is shown for the hold time after it was found last.
  void timeJumped(const std::string& message);

  /// Reports that a static transform that counts has changed: kTimeJump lasts until a pose received later is swept, and
  /// predictions from earlier ones cover nothing.
  void placedAnew(const std::string& message);

  /// Forgets poses, predictions, contacts, faults, lasting failures and a disagreement of the detectors. Keeps what
  /// concerns meshes (workpieces; refused, unread and dropped messages), a failed test of the detector, required ids
  /// and limits. A disabled guard stays disabled.
  void restart();

  /// Makes the warning unknown until enable(), whatever is reported, with a restart() that keeps lasting failures and a
  /// disagreement of the detectors. Changes nothing if disabled already.
  /// @param asked_by  name of the caller, for the text
  void disable(const std::string& asked_by);

  /// Disables only if the number of the warning's level is below that of `level`, so also if it is unknown. No report
  /// comes between the test of the level and disable().
  /// @returns the text of the warning that forbids it; empty: disabled
  std::string disableBelow(WarningLevel level, const Instant& now, const std::string& asked_by);

  /// Ends disable() with such a restart(): motion while disabled was not swept. Changes nothing if enabled already.
  void enable();

  /// Makes the warning unknown for good: the guard is shutting down. No pose counts any more.
  void end();

  std::optional<std::string> disabledBy() const;  ///< empty: enabled

  /// Returns whether a sweep to a pose received at this checkpoint, or a prediction from it, counts: the guard is enabled,
  /// was not restarted since, and does not end.
  bool counts(const Checkpoint& checkpoint) const;

  /// Returns whether a pose received at this checkpoint is still to be swept: it counts(), or nothing but timeJumped() has
  /// restarted the monitor since. In the second case only a contact is taken from the report.
  bool isToBeSwept(const Checkpoint& checkpoint) const;

  /// Sets the limits of later warnings; does not check them.
  void setLimits(const WarningLimits& limits);

  /// Computes the warning as of now.
  /// @param[out] warning  overwritten; its buffers are used again
  void warning(const Instant& now, Warning& warning) const;

  /// Returns why these workpieces, the detectors or the threads are not as good as CLEAR needs them, in words; empty if
  /// they are. Does not ask whether the workpieces were swept, and leaves out what fault() reports, failures in reports
  /// and predictions, and those of failed() that do not last. Does not name an id that is unknown, not required and not
  /// refused; says that there is no workpiece if every id is unknown and not required. Refusals beyond those of 1024
  /// ids concern every id.
  /// @param ids  empty: all workpieces, and those that are required
  std::string meshProblems(const Instant& now, const std::vector<std::string>& ids) const;

 private:
  struct Progress {  // of the threads
    std::optional<SteadyTime> waiting_since;
    const char* hung;
  };
  struct Coverage {
    Timestamps pose;     // where the prediction began
    Time covered_until;  // for the workpieces tested
    Workpieces tested;
  };

  void restartLocked() SWEEP_GUARD_REQUIRES(mutex_);
  void sweptBeforeJump(const SweepReport& report, const Checkpoint& checkpoint, SteadyTime now)
      SWEEP_GUARD_REQUIRES(mutex_);
  bool isToBeSweptLocked(const Checkpoint& checkpoint) const SWEEP_GUARD_REQUIRES(mutex_);
  void disableLocked(const std::string& asked_by) SWEEP_GUARD_REQUIRES(mutex_);
  Progress readProgress() const { return {waiting_since_(), hung_()}; }  // before the lock: these are call-backs
  void computeLocked(const Instant& now, const Progress& progress, Warning& warning) const SWEEP_GUARD_REQUIRES(mutex_);
  std::string whyNotAcknowledgedLocked(const std::string& id, const Instant& now, const Progress& progress) const
      SWEEP_GUARD_REQUIRES(mutex_);
  std::string refusal(const std::vector<std::string>& ids = {}) const SWEEP_GUARD_REQUIRES(mutex_);
  void meets(const Workpiece& workpiece, const std::vector<std::uint32_t>& triangles, SteadyTime now)
      SWEEP_GUARD_REQUIRES(mutex_);
  void noteJump(const SweepReport& report, SteadyTime now) SWEEP_GUARD_REQUIRES(mutex_);
  void addFailures(const std::vector<SweepFailure>& failures, const char* what) SWEEP_GUARD_REQUIRES(mutex_);
  void beginCoverage(const Prediction& prediction) SWEEP_GUARD_REQUIRES(mutex_);
  WarningInputs inputsAbout(const std::vector<std::string>& ids, const char* hung) const SWEEP_GUARD_REQUIRES(mutex_);
  Time coveredUntil(const Instant& now) const SWEEP_GUARD_REQUIRES(mutex_);
  WarningInputs::OtherTool* findTool(const std::string& name) SWEEP_GUARD_REQUIRES(mutex_);

  const std::function<void()> on_fault_;
  const std::function<std::optional<SteadyTime>()> waiting_since_;
  const std::function<const char*()> hung_;
  mutable Mutex mutex_;
  WarningLimits limits_ SWEEP_GUARD_GUARDED_BY(mutex_);
  std::uint64_t epoch_ SWEEP_GUARD_GUARDED_BY(mutex_) = 0;
  std::uint64_t first_epoch_ SWEEP_GUARD_GUARDED_BY(mutex_) = 0;  // from here on, time has jumped between the epochs
  std::uint64_t placed_anew_ SWEEP_GUARD_GUARDED_BY(mutex_) = 0;  // number of the newest fault of placedAnew()
  mutable WarningInputs inputs_
      SWEEP_GUARD_GUARDED_BY(mutex_);  // covered_until, waiting_since and hung are those of the last warning
  const std::unique_ptr<Faults> faults_ SWEEP_GUARD_PT_GUARDED_BY(mutex_);  // these keep their part of the inputs
  const std::unique_ptr<SweptWorkpieces> workpieces_ SWEEP_GUARD_PT_GUARDED_BY(mutex_);
  const std::unique_ptr<WorkpieceWarnings> warnings_ SWEEP_GUARD_PT_GUARDED_BY(mutex_);
  const std::unique_ptr<Refusals> refused_meshes_ SWEEP_GUARD_PT_GUARDED_BY(mutex_);
  const std::unique_ptr<Refusals> refused_vertices_ SWEEP_GUARD_PT_GUARDED_BY(mutex_);
  Time swept_until_ SWEEP_GUARD_GUARDED_BY(mutex_);  // every workpiece
  std::optional<Coverage> coverage_ SWEEP_GUARD_GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_core
