#include "monitor/swept_workpieces.h"

#include <algorithm>

#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

std::optional<size_t> firstPiece(const SweepResult& result) {
  const auto sooner = [](const TriangleContact& a, const TriangleContact& b) {
    return a.impact.time_of_impact < b.impact.time_of_impact;
  };
  const TriangleContact* first = nullptr;
  for (const TriangleContact& contact : result.in_contact) {
    if (!contact.intended && (first == nullptr || sooner(contact, *first))) first = &contact;
  }
  return first == nullptr ? std::nullopt : std::optional(first->piece);
}

const SweptObject* firstMet(const std::vector<SweptObject>& objects) {
  const auto meets = [](const SweptObject& object) { return object.result.unintendedContact(); };
  const auto met = std::find_if(objects.begin(), objects.end(), meets);
  return met == objects.end() ? nullptr : &*met;
}

bool notSwept(const SweepReport& report, const std::string& id) {
  const auto unplaced = [&](const auto& workpiece) { return workpiece->id == id; };
  const auto failed = [&](const SweepFailure& failure) { return failure.workpiece->id == id; };
  return std::any_of(report.unplaced.begin(), report.unplaced.end(), unplaced) ||
         std::any_of(report.failures.begin(), report.failures.end(), failed);
}

// Both are ascending by id.
template <typename Entry>
void forgetGone(const Workpieces& newest, std::map<std::string, Entry>& by_id) {
  auto workpiece = newest.begin();
  for (auto entry = by_id.begin(); entry != by_id.end();) {
    while (workpiece != newest.end() && (*workpiece)->id < entry->first) ++workpiece;
    const bool known = workpiece != newest.end() && (*workpiece)->id == entry->first;
    entry = known ? std::next(entry) : by_id.erase(entry);
  }
}

}  // namespace

const Workpiece* findWorkpiece(const Workpieces& workpieces, const std::string& id) {
  const auto same = [&](const auto& one) { return one->id == id; };
  const auto found = std::find_if(workpieces.begin(), workpieces.end(), same);
  return found == workpieces.end() ? nullptr : found->get();
}

bool holds(const Workpieces& workpieces, const Workpiece& workpiece) {
  const Workpiece* const one = findWorkpiece(workpieces, workpiece.id);
  return one != nullptr && one->frame == workpiece.frame && &one->mesh_M.triangles() == &workpiece.mesh_M.triangles();
}

void SweptWorkpieces::set(const Workpieces& newest, std::optional<SteadyTime> now) {
  updateStandIns(newest_, newest, now, replaced_);
  newest_ = newest;
  forgetGone(newest_, dropped_);
  forgetGone(newest_, confirmed_);
  updateObjects();
}

bool SweptWorkpieces::allCount(const Workpieces& tested, SteadyTime now) const {
  const auto counts = [&](const auto& workpiece) {
    return holds(tested, *workpiece) || now <= standInUntil(replaced_, tested, *workpiece).value_or(SteadyTime::min());
  };
  return std::all_of(newest_.begin(), newest_.end(), counts);
}

WarningInputs::Object* SweptWorkpieces::findObject(const std::string& id) const {
  const auto before = [](const WarningInputs::Object& object, const std::string& of) { return object.id < of; };
  const auto found = std::lower_bound(inputs_.objects.begin(), inputs_.objects.end(), id, before);
  return found == inputs_.objects.end() || found->id != id ? nullptr : &*found;
}

void SweptWorkpieces::confirm(const std::string& id, const Timestamps& timestamps) {
  WarningInputs::Object* const object = findObject(id);
  if (object == nullptr) return;
  object->timestamps = confirmed_[id] = timestamps;
}

bool SweptWorkpieces::drop(const std::string& id, SteadyTime received) {
  if (findObject(id) == nullptr) return false;
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
  confirmed_.clear();
  updateObjects();
}

void SweptWorkpieces::updateObjects() {
  inputs_.objects.resize(newest_.size());
  for (size_t i = 0; i < newest_.size(); ++i) {
    const Workpiece& workpiece = *newest_[i];
    WarningInputs::Object& object = inputs_.objects[i];
    if (object.id != workpiece.id) object.behind = {};
    object.id = workpiece.id;
    const auto confirmed = confirmed_.find(workpiece.id);
    const bool is_newer = confirmed != confirmed_.end() && confirmed->second.received > workpiece.received;
    object.timestamps = is_newer ? confirmed->second : Timestamps{workpiece.stamp, workpiece.received};
    object.ages = !workpiece.of_other_tool;
    object.open_edges = workpiece.mesh_M.openEdges();
    object.swept = holds(swept_, workpiece);
    object.stands_in_until = object.swept ? std::nullopt : standInUntil(replaced_, swept_, workpiece);
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

bool updateContact(const SweepReport& report, SteadyTime now, std::optional<WarningInputs::Contact>& contact) {
  if (contact) contact->lasting = contact->lasting && notSwept(report, contact->id);
  const SweptObject* met = firstMet(report.objects);
  if (met == nullptr) met = firstMet(report.replaced);
  if (met == nullptr) return false;
  if (!contact) contact = WarningInputs::Contact{};
  contact->id = met->workpiece->id;
  contact->triangles = met->result.not_ruled_out;
  remove(contact->triangles, met->result.intended);
  contact->found = now;
  contact->lasting = true;
  contact->inside = met->result.inside;
  contact->tool_piece = firstPiece(met->result);
  return true;
}

void updateIntended(const SweepReport& report, std::vector<std::string>& ids) {
  ids.clear();
  for (const SweptObject& object : report.objects) {
    if (!object.result.intended.empty()) ids.push_back(object.workpiece->id);
  }
}

void addToContact(const Workpiece& workpiece, const std::vector<std::uint32_t>& triangles, SteadyTime now,
                  std::optional<WarningInputs::Contact>& contact) {
  if (!contact || (contact->id != workpiece.id && !contact->lasting)) {
    contact = WarningInputs::Contact{workpiece.id, {}, now};
  }
  contact->found = now;
  if (contact->id == workpiece.id) unite(contact->triangles, triangles);
}

}  // namespace sweep_guard_core
