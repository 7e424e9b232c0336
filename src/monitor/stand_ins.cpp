#include "monitor/stand_ins.h"

#include <algorithm>
#include <utility>

#include "monitor/swept_workpieces.h"

namespace sweep_guard_core {

void StandIns::update(const Workpieces& before, const Workpieces& newest, std::optional<SteadyTime> now) {
  auto next = newest.begin();
  for (const auto& old : before) {
    next = std::find_if(next, newest.end(), [&](const auto& one) { return one->id >= old->id; });
    if (next == newest.end() || (*next)->id != old->id || (*next)->frame != old->frame) {
      forget(old->id);
    } else if (&(*next)->mesh_M.triangles() != &old->mesh_M.triangles()) {
      replace({old->id, old->mesh_M.sharedTriangles(), now.value_or((*next)->received)});
    }
  }
  const auto is_unused = [](const Replaced& one) { return one.triangles.expired(); };
  replaced_.erase(std::remove_if(replaced_.begin(), replaced_.end(), is_unused), replaced_.end());
}

// Triangles that come back and are replaced again count from then on.
void StandIns::replace(Replaced old) {
  const auto same = [&](const Replaced& one) {
    return one.id == old.id && one.triangles.lock() == old.triangles.lock();
  };
  const auto known = std::find_if(replaced_.begin(), replaced_.end(), same);
  if (known != replaced_.end()) replaced_.erase(known);
  replaced_.push_back(std::move(old));
}

std::optional<SteadyTime> StandIns::until(const Workpieces& tested, const Workpiece& newest) const {
  const Workpiece* const one = findWorkpiece(tested, newest.id);
  if (one == nullptr || one->frame != newest.frame) return std::nullopt;
  const auto same = [&](const Replaced& old) {
    return old.id == newest.id && old.triangles.lock().get() == &one->mesh_M.triangles();
  };
  const auto old = std::find_if(replaced_.begin(), replaced_.end(), same);
  return old == replaced_.end() ? std::nullopt : std::optional(old->at + kTime);
}

void StandIns::forget(const std::string& id) {
  const auto is_of_id = [&](const Replaced& one) { return one.id == id; };
  replaced_.erase(std::remove_if(replaced_.begin(), replaced_.end(), is_of_id), replaced_.end());
}

}  // namespace sweep_guard_core
