#include "sweep_guard/guard/ledger.h"

#include <algorithm>

namespace sweep_guard {
namespace {

constexpr Duration kUnknownMeshFaultLasts = std::chrono::seconds(1);
constexpr size_t kMeshFaultsKept = 64;  // a flood of made-up ids must not grow the ledger

Evidence::Contact contactOf(const SweepReport& report, SteadyTime now) {
  const auto met = std::find_if(report.objects.begin(), report.objects.end(),
                                [](const SweptObject& object) { return !object.findings.triangles.empty(); });
  return {met->workpiece->id, met->findings.triangles, now};
}

}  // namespace

Ledger::Ledger(const VerdictLimits& limits) : limits_(limits) {}

void Ledger::fault(Reason reason, const std::string& story) {
  const std::lock_guard lock(mutex_);
  faults_[reason] = {story, ++fault_count_};
}

std::uint64_t Ledger::faultCount() const {
  const std::lock_guard lock(mutex_);
  return fault_count_;
}

void Ledger::mend(std::uint32_t reasons, std::uint64_t up_to) {
  const std::lock_guard lock(mutex_);
  for (auto fault = faults_.begin(); fault != faults_.end();) {
    const bool mended = (fault->first & reasons) != 0 && fault->second.number <= up_to;
    fault = mended ? faults_.erase(fault) : std::next(fault);
  }
}

void Ledger::meshRefused(const std::string& id, const std::string& story, SteadyTime now) {
  const std::lock_guard lock(mutex_);
  if (mesh_faults_.size() >= kMeshFaultsKept) forgetUnknownMeshes();
  mesh_faults_[id] = {story, now};
}

void Ledger::forgetUnknownMeshes() {
  for (auto fault = mesh_faults_.begin(); fault != mesh_faults_.end();) {
    fault = known(fault->first) ? std::next(fault) : mesh_faults_.erase(fault);
  }
}

void Ledger::meshAccepted(const std::string& id) {
  const std::lock_guard lock(mutex_);
  mesh_faults_.erase(id);
}

void Ledger::setWorkpieces(const Workpieces& workpieces) {
  const std::lock_guard lock(mutex_);
  workpieces_ = workpieces;
}

void Ledger::swept(const SweepReport& report, const Seen& pose, SteadyTime now) {
  const std::lock_guard lock(mutex_);
  pose_ = pose;
  swept_revisions_.clear();
  for (const SweptObject& object : report.objects) swept_revisions_[object.workpiece->id] = object.workpiece->revision;
  if (report.contact()) contact_ = contactOf(report, now);
}

void Ledger::timeJumped(const std::string& story) {
  const std::lock_guard lock(mutex_);
  pose_.reset();
  contact_.reset();
  swept_revisions_.clear();
  faults_.clear();
  mesh_faults_.clear();
  faults_[kTimeJump] = {story, ++fault_count_};
}

Verdict Ledger::verdict(const Instant& now) const {
  const std::lock_guard lock(mutex_);
  Evidence evidence;
  evidence.pose = pose_;
  evidence.contact = contact_;
  for (const auto& workpiece : workpieces_) {
    const auto swept = swept_revisions_.find(workpiece->id);
    evidence.objects.push_back({workpiece->id,
                                {workpiece->stamp, workpiece->received},
                                swept != swept_revisions_.end() && swept->second == workpiece->revision});
  }
  for (const auto& [reason, fault] : faults_) evidence.faults[reason] = fault.story;
  for (const auto& [id, fault] : mesh_faults_) {
    if (known(id) || now.steady - fault.reported <= kUnknownMeshFaultLasts) evidence.faults[kMeshInvalid] = fault.story;
  }
  return assess(evidence, now, limits_);
}

bool Ledger::known(const std::string& id) const {
  return std::any_of(workpieces_.begin(), workpieces_.end(),
                     [&](const auto& workpiece) { return workpiece->id == id; });
}

}  // namespace sweep_guard
