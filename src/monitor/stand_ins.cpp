#include "monitor/stand_ins.h"

#include <algorithm>
#include <utility>

#include "monitor/swept_workpieces.h"

namespace sweep_guard_core {

namespace {

template <typename Predicate>
void erase(std::vector<ReplacedTriangles>& replaced, const Predicate& predicate) {
  replaced.erase(std::remove_if(replaced.begin(), replaced.end(), predicate), replaced.end());
}

// Triangles that come back and are replaced again count from then on.
void replace(ReplacedTriangles old, std::vector<ReplacedTriangles>& replaced) {
  erase(replaced,
        [&](const ReplacedTriangles& one) { return one.id == old.id && one.triangles.lock() == old.triangles.lock(); });
  replaced.push_back(std::move(old));
}

}  // namespace

void updateStandIns(const Workpieces& before, const Workpieces& newest, std::optional<SteadyTime> now,
                    std::vector<ReplacedTriangles>& replaced) {
  auto next = newest.begin();
  for (const auto& old : before) {
    next = std::find_if(next, newest.end(), [&](const auto& one) { return one->id >= old->id; });
    if (next == newest.end() || (*next)->id != old->id || (*next)->frame != old->frame) {
      erase(replaced, [&](const ReplacedTriangles& one) { return one.id == old->id; });
    } else if (&(*next)->mesh_M.triangles() != &old->mesh_M.triangles()) {
      replace({old->id, old->mesh_M.sharedTriangles(), now.value_or((*next)->received)}, replaced);
    }
  }
  erase(replaced, [](const ReplacedTriangles& one) { return one.triangles.expired(); });
}

std::optional<SteadyTime> standInUntil(const std::vector<ReplacedTriangles>& replaced, const Workpieces& tested,
                                       const Workpiece& newest) {
  const Workpiece* const one = findWorkpiece(tested, newest.id);
  if (one == nullptr || one->frame != newest.frame) return std::nullopt;
  const auto same = [&](const ReplacedTriangles& old) {
    return old.id == newest.id && old.triangles.lock().get() == &one->mesh_M.triangles();
  };
  const auto old = std::find_if(replaced.begin(), replaced.end(), same);
  return old == replaced.end() ? std::nullopt : std::optional(old->at + kStandInTime);
}

}  // namespace sweep_guard_core
