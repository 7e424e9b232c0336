#include "sweep_guard/monitor/warning_monitor.h"

#include <algorithm>

#include "monitor/faults.h"
#include "monitor/swept_workpieces.h"
#include "monitor/workpiece_warnings.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core {

WarningMonitor::WarningMonitor(const WarningLimits& limits, std::function<void()> on_fault,
                               std::function<std::optional<SteadyTime>()> waiting_since,
                               std::function<const char*()> hung)
    : on_fault_(std::move(on_fault)),
      waiting_since_(std::move(waiting_since)),
      hung_(std::move(hung)),
      limits_(limits),
      faults_(std::make_unique<Faults>(inputs_)),
      workpieces_(std::make_unique<SweptWorkpieces>(inputs_)),
      warnings_(std::make_unique<WorkpieceWarnings>(inputs_, limits_)),
      refused_meshes_(std::make_unique<Refusals>()),
      refused_vertices_(std::make_unique<Refusals>()) {}

WarningMonitor::~WarningMonitor() = default;

WarningMonitor::Checkpoint WarningMonitor::checkpoint() const {
  const Lock lock(mutex_);
  return {epoch_, faults_->count()};
}

void WarningMonitor::timeJumped(const std::string& message) {
  {
    const Lock lock(mutex_);
    const std::uint64_t first_epoch = first_epoch_;
    restartLocked();
    first_epoch_ = first_epoch;
    if (inputs_.contact) inputs_.contact->lasting = false;
    faults_->add(kTimeJump, message);
  }
  on_fault_();
}

void WarningMonitor::placedAnew(const std::string& message) {
  {
    const Lock lock(mutex_);
    faults_->add(kTimeJump, message);
    placed_anew_ = faults_->count();
    coverage_.reset();
  }
  on_fault_();
}

void WarningMonitor::restartLocked() {
  first_epoch_ = ++epoch_;
  inputs_.pose.reset();
  inputs_.overload.reset();
  inputs_.pose_loss.reset();
  inputs_.jump.reset();
  inputs_.intended.clear();
  warnings_->restart();
  faults_->restart();
  workpieces_->restart();
  swept_until_ = {};
  coverage_.reset();
  inputs_.seen.reset();
  inputs_.unseen.reset();
  for (WarningInputs::OtherTool& tool : inputs_.other_tools) tool.newest.reset();
}

void WarningMonitor::restart() {
  {
    const Lock lock(mutex_);
    faults_->set(kCrosscheck, {});
    restartLocked();
    inputs_.contact.reset();
    inputs_.failure.reset();
  }
  on_fault_();
}

void WarningMonitor::disable(const std::string& asked_by) {
  {
    const Lock lock(mutex_);
    disableLocked(asked_by);
  }
  on_fault_();
}

void WarningMonitor::disableLocked(const std::string& asked_by) {
  if (inputs_.disabled_by) return;
  restartLocked();
  inputs_.contact.reset();
  inputs_.disabled_by = asked_by;
}

std::string WarningMonitor::disableBelow(WarningLevel level, const Instant& now, const std::string& asked_by) {
  {
    const Progress progress = readProgress();
    const Lock lock(mutex_);
    Warning warning;
    computeLocked(now, progress, warning);
    if (warning.level >= level) return warning.text;
    disableLocked(asked_by);
  }
  on_fault_();
  return {};
}

void WarningMonitor::enable() {
  {
    const Lock lock(mutex_);
    if (!inputs_.disabled_by) return;
    restartLocked();
    inputs_.disabled_by.reset();
  }
  on_fault_();
}

void WarningMonitor::end() {
  {
    const Lock lock(mutex_);
    restartLocked();
    inputs_.ended = true;
  }
  on_fault_();
}

std::optional<std::string> WarningMonitor::disabledBy() const {
  const Lock lock(mutex_);
  return inputs_.disabled_by;
}

bool WarningMonitor::counts(const Checkpoint& checkpoint) const {
  const Lock lock(mutex_);
  return epoch_ == checkpoint.epoch && !inputs_.disabled_by && !inputs_.ended;
}

bool WarningMonitor::isToBeSwept(const Checkpoint& checkpoint) const {
  const Lock lock(mutex_);
  return isToBeSweptLocked(checkpoint);
}

bool WarningMonitor::isToBeSweptLocked(const Checkpoint& checkpoint) const {
  return checkpoint.epoch >= first_epoch_ && !inputs_.disabled_by && !inputs_.ended;
}

void WarningMonitor::setTool(const Tool& tool) {
  std::vector<std::string> links;
  for (const ConvexPiece& piece : tool.pieces()) links.push_back(printable(piece.link));
  const Lock lock(mutex_);
  inputs_.links.swap(links);
}

void WarningMonitor::setLimits(const WarningLimits& limits) {
  const Lock lock(mutex_);
  limits_ = limits;
}

void WarningMonitor::warning(const Instant& now, Warning& warning) const {
  const Progress progress = readProgress();
  const Lock lock(mutex_);
  computeLocked(now, progress, warning);
}

void WarningMonitor::computeLocked(const Instant& now, const Progress& progress, Warning& warning) const {
  inputs_.covered_until = coveredUntil(now);
  inputs_.waiting_since = progress.waiting_since;
  inputs_.hung = progress.hung;
  computeWarning(inputs_, now, limits_, warning);
}

std::string WarningMonitor::meshProblems(const Instant& now, const std::vector<std::string>& ids) const {
  const char* const hung = hung_();
  const Lock lock(mutex_);
  return sweep_guard_core::meshProblems(inputsAbout(ids, hung), now, limits_);
}

WarningInputs WarningMonitor::inputsAbout(const std::vector<std::string>& ids, const char* hung) const {
  const auto asked = [&](const std::string& id) {
    return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  const auto asked_object = [&](const WarningInputs::Object& object) { return asked(object.id); };
  WarningInputs about;
  std::copy_if(inputs_.objects.begin(), inputs_.objects.end(), std::back_inserter(about.objects), asked_object);
  std::copy_if(inputs_.required.begin(), inputs_.required.end(), std::back_inserter(about.required), asked);
  const auto asked_tool = [&](const WarningInputs::OtherTool& tool) {
    const auto is_link = [&](const std::string& id) {
      return id.compare(0, tool.name.size() + 1, tool.name + "/") == 0;
    };
    return ids.empty() || std::any_of(ids.begin(), ids.end(), is_link);
  };
  std::copy_if(inputs_.other_tools.begin(), inputs_.other_tools.end(), std::back_inserter(about.other_tools),
               asked_tool);
  const auto tell = [&](Reason reason, const std::string& message) {
    if (!message.empty()) about.faults[reason] = message;
  };
  tell(kMeshInvalid, refusal(ids));
  tell(kSelftest, faults_->get(kSelftest));
  tell(kCrosscheck, faults_->get(kCrosscheck));
  about.unread = inputs_.unread;
  if (inputs_.failure && inputs_.failure->lasting) about.failure = inputs_.failure;
  about.hung = hung;
  return about;
}

}  // namespace sweep_guard_core
