#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Triangles that were replaced. Until the new ones are tested, tests of these count for them for a moment, so that a mesh
/// whose triangles change with each message is not unknown each time. Keeps no triangles in memory.
struct ReplacedTriangles {
  std::string id;
  std::weak_ptr<const std::vector<Triangle>> triangles;
  SteadyTime at;
};

/// How long triangles stand in for those that replaced them.
constexpr Duration kStandInTime = std::chrono::milliseconds(50);

/// Takes over what was replaced. A workpiece that is removed, or comes in another frame, has no stand-in.
/// @param before, newest  snapshots of all workpieces, each ascending by id
/// @param now             when the newest came; empty: each when it was received
/// @param replaced        those that somebody still uses
void updateStandIns(const Workpieces& before, const Workpieces& newest, std::optional<SteadyTime> now,
                    std::vector<ReplacedTriangles>& replaced);

/// Returns until when the triangles that were tested stand in for those of a newest snapshot; empty: they never did.
std::optional<SteadyTime> standInUntil(const std::vector<ReplacedTriangles>& replaced, const Workpieces& tested,
                                       const Workpiece& newest);

}  // namespace sweep_guard_core
