#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/verdict.h"

namespace sweep_guard {

/// Keeps the evidence that a verdict rests on: which poses and workpieces came, which were refused, what has been
/// swept. Each input reports from its own thread; the verdict may be asked for at any time, so that it also tells when
/// an input is silent.
class Ledger {
 public:
  explicit Ledger(const VerdictLimits& limits);

  /// Something was refused or failed: the verdict is not clear until it is mended.
  void fault(Reason reason, const std::string& story);
  /// Number of faults so far: what mend() can be bounded by.
  std::uint64_t faultCount() const;
  /// Takes back the faults of these reasons, bits of Reason, that were reported when faultCount() was at most `up_to`.
  void mend(std::uint32_t reasons, std::uint64_t up_to);

  /// A mesh message was refused. In force until meshAccepted(), or for a second if no such workpiece is known.
  void meshRefused(const std::string& id, const std::string& story, SteadyTime now);
  void meshAccepted(const std::string& id);

  /// The workpieces there are now, newest snapshots.
  void setWorkpieces(const Workpieces& workpieces);

  /// A pose has been swept. Nothing of the evidence before is lost: a contact stays for its hold time.
  /// @param pose  the pose at the end of the report's interval
  void swept(const SweepReport& report, const Seen& pose, SteadyTime now);

  /// Time went back: poses, contact and faults are forgotten; kTimeJump is in force until it is mended.
  void timeJumped(const std::string& story);

  Verdict verdict(const Instant& now) const;

 private:
  struct Fault {
    std::string story;
    std::uint64_t number;
  };
  struct MeshFault {
    std::string story;
    SteadyTime reported;
  };

  void forgetUnknownMeshes();
  bool known(const std::string& id) const;

  const VerdictLimits limits_;
  mutable std::mutex mutex_;
  std::optional<Seen> pose_;
  std::optional<Evidence::Contact> contact_;
  std::map<std::string, std::uint32_t> swept_revisions_;  // by id, at the newest pose
  Workpieces workpieces_;
  std::map<Reason, Fault> faults_;
  std::map<std::string, MeshFault> mesh_faults_;  // by id
  std::uint64_t fault_count_ = 0;
};

}  // namespace sweep_guard
