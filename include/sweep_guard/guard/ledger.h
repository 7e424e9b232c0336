#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/verdict.h"

namespace sweep_guard {

/// Keeps the evidence that a verdict rests on: which poses and workpieces came, which were refused, what has been
/// swept. Each input reports from its own thread; the verdict may be asked for at any time, so that it also tells when
/// an input is silent.
class Ledger {
 public:
  /// Where in the ledger an input stood when it came: what it can vouch for.
  struct Mark {
    std::uint64_t epoch = 0;   ///< counts new beginnings: jumps of time, restarts, and where it was disabled or enabled
    std::uint64_t faults = 0;  ///< faults reported before
  };

  /// @param on_fault  called after every fault and every new beginning, in the thread that reports it, so that none
  /// goes
  ///                  unseen
  explicit Ledger(
      const VerdictLimits& limits, std::function<void()> on_fault = [] {});

  Mark mark() const;

  /// Something was refused or failed: the verdict is not clear until a later input mends it.
  void fault(Reason reason, const std::string& story);

  /// A whole mesh was refused: the verdict is not clear until meshAccepted(), for there is a workpiece that cannot be
  /// seen.
  void meshRefused(const std::string& id, const std::string& story);
  /// A good mesh of that workpiece came, or it was removed: nothing of it counts as refused any more.
  void meshAccepted(const std::string& id);
  /// New vertices of a mesh were refused: the verdict is not clear until verticesAccepted() or meshAccepted().
  void verticesRefused(const std::string& id, const std::string& story);
  /// Good vertices came. They are those of the mesh before: one that was refused since stays so.
  void verticesAccepted(const std::string& id);

  /// The workpieces there are now, newest snapshots.
  void setWorkpieces(const Workpieces& workpieces);

  /// A pose has been swept to. Mends the faults from before the pose came. Does nothing if there was a new beginning
  /// since.
  void swept(const SweepReport& report, const Seen& pose, const Mark& pose_came, SteadyTime now);

  /// The path from a pose that has been swept to was tested. Does nothing if there was a new beginning since the
  /// pose came.
  /// @param pose  that the path begins at
  void predicted(const Outlook& outlook, const Seen& pose, const Mark& pose_came, const Instant& now);

  /// Time went back: poses, predictions and faults are forgotten; kTimeJump is in force until a pose of the new time is
  /// swept.
  void timeJumped(const std::string& story);

  /// Everything but the workpieces, and those refused, is forgotten: what is to be told comes from poses that come from
  /// now on.
  void restart();

  /// Nothing is promised until enable(), whatever comes in: the verdict is unknown. Does nothing if it is disabled.
  /// @param asked_by  for people
  void disable(const std::string& asked_by);
  /// What moved while it was disabled was not swept and does not count: as restart(). Does nothing if it is enabled.
  void enable();
  std::optional<std::string> disabledBy() const;  ///< empty: it is enabled

  /// What came in at that mark is still to be swept: there was no new beginning since, and the guard is enabled.
  bool counts(const Mark& came) const;

  /// From the next verdict on.
  void setLimits(const VerdictLimits& limits);

  /// @param[out] verdict  what was in it is replaced; one that is handed in again and again ceases to allocate
  void verdict(const Instant& now, Verdict& verdict) const;
  Verdict verdict(const Instant& now) const;

 private:
  struct Prediction {
    Seen pose;           // that it began at
    Time covered_until;  // the workpieces tested
    Workpieces tested;
  };

  using Stories = std::map<std::string, std::string>;  // by id

  void beginAnew();
  void note(Reason reason, const std::string& story);
  void refused(Stories& refusals, const std::string& id, const std::string& story);
  void noteRefusals();
  void noteObjects();
  void noteContact(const SweepReport& report, SteadyTime now);
  void noteExpected(const Outlook& outlook, const Seen& pose, const Instant& now);
  void noteAlarm(const Instant& now);
  Time coveredUntil(const Instant& now) const;

  const std::function<void()> on_fault_;
  mutable std::mutex mutex_;
  VerdictLimits limits_;
  Mark mark_;
  mutable Evidence evidence_;  // what it covers is as of the last verdict
  Time swept_until_;           // every workpiece
  Workpieces swept_;           // at the newest pose
  std::optional<Prediction> prediction_;
  std::optional<ExpectedContact> next_;  // of the newest prediction
  Workpieces workpieces_;
  std::map<Reason, std::uint64_t> fault_numbers_;
  Stories refused_meshes_;
  Stories refused_vertices_;
};

}  // namespace sweep_guard
