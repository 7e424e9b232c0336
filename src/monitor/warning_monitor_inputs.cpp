#include "sweep_guard/monitor/warning_monitor.h"

#include <algorithm>

#include "guard/cross_check.h"
#include "monitor/faults.h"
#include "monitor/late_frames.h"
#include "monitor/swept_workpieces.h"
#include "monitor/workpiece_warnings.h"

namespace sweep_guard_core {

void WarningMonitor::require(const std::set<std::string>& ids) {
  const Lock lock(mutex_);
  inputs_.required.assign(ids.begin(), ids.end());
}

void WarningMonitor::requireTools(const std::vector<std::string>& names) {
  const Lock lock(mutex_);
  inputs_.other_tools.clear();
  for (const std::string& name : names) inputs_.other_tools.push_back({name, {}, {}});
}

WarningInputs::OtherTool* WarningMonitor::findTool(const std::string& name) {
  const auto same = [&](const WarningInputs::OtherTool& tool) { return tool.name == name; };
  const auto found = std::find_if(inputs_.other_tools.begin(), inputs_.other_tools.end(), same);
  return found == inputs_.other_tools.end() ? nullptr : &*found;
}

void WarningMonitor::toolHeard(const std::string& name, const Timestamps& pose) {
  const Lock lock(mutex_);
  WarningInputs::OtherTool* const tool = findTool(name);
  if (tool == nullptr) return;
  tool->newest = pose;
  tool->problem.clear();
}

void WarningMonitor::toolUnknown(const std::string& name, const std::string& problem) {
  {
    const Lock lock(mutex_);
    WarningInputs::OtherTool* const tool = findTool(name);
    if (tool == nullptr) return;
    tool->problem = problem;
  }
  on_fault_();
}

std::vector<WarningInputs::OtherTool> WarningMonitor::otherTools() const {
  const Lock lock(mutex_);
  return inputs_.other_tools;
}

void WarningMonitor::frameHeard(const std::string& frame, Time stamp, const Instant& now) {
  const Lock lock(mutex_);
  addTransform(inputs_.frames, frame, stamp, now, limits_.pose_timeout);
}

void WarningMonitor::setMovingFrames(const std::set<std::string>& frames) {
  const Lock lock(mutex_);
  keepOnly(frames, inputs_.frames);
}

void WarningMonitor::fault(Reason reason, const std::string& message) {
  {
    const Lock lock(mutex_);
    faults_->add(reason, message);
  }
  on_fault_();
}

void WarningMonitor::failed(Reason reason, const char* message, SteadyTime now, bool lasting) noexcept {
  const Lock lock(mutex_);
  faults_->addFailure(reason, message, now, lasting);
}

void WarningMonitor::meshRefused(const std::string& id, const std::string& message, SteadyTime received) {
  {
    const Lock lock(mutex_);
    refused_meshes_->add(id, {message, received});
    faults_->set(kMeshInvalid, refusal());
  }
  on_fault_();
}

void WarningMonitor::verticesRefused(const std::string& id, const std::string& message, SteadyTime received) {
  {
    const Lock lock(mutex_);
    refused_vertices_->add(id, {message, received});
    faults_->set(kMeshInvalid, refusal());
  }
  on_fault_();
}

bool WarningMonitor::meshAccepted(const std::string& id, SteadyTime received) {
  const Lock lock(mutex_);
  const bool was_refused = refused_meshes_->accept(id, received);
  refused_vertices_->accept(id, received);
  faults_->set(kMeshInvalid, refusal());
  return was_refused;
}

void WarningMonitor::verticesAccepted(const std::string& id, SteadyTime received) {
  const Lock lock(mutex_);
  refused_vertices_->accept(id, received);
  faults_->set(kMeshInvalid, refusal());
}

void WarningMonitor::confirmed(const std::string& id, const Timestamps& timestamps) {
  const Lock lock(mutex_);
  workpieces_->confirm(id, timestamps);
}

std::vector<std::pair<std::string, Timestamps>> WarningMonitor::heard() const {
  const Lock lock(mutex_);
  std::vector<std::pair<std::string, Timestamps>> heard;
  for (const WarningInputs::Object& object : inputs_.objects) {
    if (object.ages) heard.emplace_back(object.id, object.timestamps);
  }
  return heard;
}

std::string WarningMonitor::refusal(const std::vector<std::string>& ids) const {
  const std::string of_mesh = refused_meshes_->message(ids);
  return of_mesh.empty() ? refused_vertices_->message(ids) : of_mesh;
}

void WarningMonitor::meshUnread(const std::string& message, SteadyTime now) {
  {
    const Lock lock(mutex_);
    inputs_.unread = WarningInputs::Event{message, now};
  }
  on_fault_();
}

void WarningMonitor::updateDropped(const std::string& id, SteadyTime received) {
  {
    const Lock lock(mutex_);
    if (!workpieces_->drop(id, received)) return;
  }
  on_fault_();
}

void WarningMonitor::detectorTested(const std::string& failure) {
  {
    const Lock lock(mutex_);
    const bool exchanged = failure.empty() && !faults_->get(kSelftest).empty();
    faults_->set(kSelftest, failure);
    if (exchanged) restartLocked();
  }
  on_fault_();
}

void WarningMonitor::detectorsDisagree(const std::string& message, const SampledQuery& query,
                                       const std::vector<std::uint32_t>& missed, SteadyTime now) {
  const Lock lock(mutex_);
  if (query.origin.epoch != epoch_) return;
  faults_->set(kCrosscheck, message);
  if (query.origin.measured && holds(workpieces_->newest(), *query.workpiece)) meets(*query.workpiece, missed, now);
}

void WarningMonitor::meets(const Workpiece& workpiece, const std::vector<std::uint32_t>& triangles, SteadyTime now) {
  if (triangles.empty() || inputs_.disabled_by) return;
  addToContact(workpiece, triangles, now, inputs_.contact);
  warnings_->endAcknowledgements();
}

void WarningMonitor::posesLost(const std::string& message, SteadyTime now) {
  {
    const Lock lock(mutex_);
    inputs_.pose_loss = WarningInputs::Event{message, now};
  }
  on_fault_();
}

void WarningMonitor::setWorkpieces(const Workpieces& workpieces, std::optional<SteadyTime> now) {
  const Lock lock(mutex_);
  workpieces_->set(workpieces, now);
  warnings_->endAcknowledgementsOfGone(workpieces);
}

}  // namespace sweep_guard_core
