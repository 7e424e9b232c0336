#include "monitor/swept_workpieces.h"

#include <algorithm>

namespace sweep_guard_core {

const Workpiece* findWorkpiece(const Workpieces& workpieces, const std::string& id) {
  const auto same = [&](const auto& one) { return one->id == id; };
  const auto found = std::find_if(workpieces.begin(), workpieces.end(), same);
  return found == workpieces.end() ? nullptr : found->get();
}

bool holds(const Workpieces& workpieces, const Workpiece& workpiece) {
  const Workpiece* const one = findWorkpiece(workpieces, workpiece.id);
  return one != nullptr && one->frame == workpiece.frame && &one->mesh_M.triangles() == &workpiece.mesh_M.triangles();
}

void SweptWorkpieces::set(const Workpieces& newest) {
  newest_ = newest;
  forgetDroppedOfGone();
  updateObjects();
}

bool SweptWorkpieces::drop(const std::string& id, SteadyTime received) {
  if (findWorkpiece(newest_, id) == nullptr) return false;
  SteadyTime& newest = dropped_[id];
  newest = std::max(newest, received);
  updateObjects();
  return true;
}

void SweptWorkpieces::swept(const SweepReport& report) {
  swept_.clear();
  for (const SweptObject& object : report.objects) {
    if (object.behind == Duration::zero()) swept_.push_back(object.workpiece);
    const auto dropped = dropped_.find(object.workpiece->id);
    if (dropped != dropped_.end() && object.workpiece->received > dropped->second) dropped_.erase(dropped);
  }
  updateObjects();
  updateBehind(report);
}

void SweptWorkpieces::restart() {
  swept_.clear();
  updateObjects();
}

void SweptWorkpieces::forgetDroppedOfGone() {
  for (auto dropped = dropped_.begin(); dropped != dropped_.end();) {
    const bool known = findWorkpiece(newest_, dropped->first) != nullptr;
    dropped = known ? std::next(dropped) : dropped_.erase(dropped);
  }
}

void SweptWorkpieces::updateObjects() {
  inputs_.objects.resize(newest_.size());
  for (size_t i = 0; i < newest_.size(); ++i) {
    const Workpiece& workpiece = *newest_[i];
    WarningInputs::Object& object = inputs_.objects[i];
    if (object.id != workpiece.id) object.behind = {};
    object.id = workpiece.id;
    object.timestamps = {workpiece.stamp, workpiece.received};
    object.ages = !workpiece.of_other_tool;
    object.swept = holds(swept_, workpiece);
    object.dropped = dropped_.count(workpiece.id) != 0;
  }
}

void SweptWorkpieces::updateBehind(const SweepReport& report) {
  for (WarningInputs::Object& object : inputs_.objects) {
    const auto same = [&](const SweptObject& swept) { return swept.workpiece->id == object.id; };
    const auto swept = std::find_if(report.objects.begin(), report.objects.end(), same);
    object.behind = swept == report.objects.end() ? Duration::zero() : swept->behind;
  }
}

}  // namespace sweep_guard_core
