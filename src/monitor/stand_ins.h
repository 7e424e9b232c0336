#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Remembers which triangles were replaced a moment ago. Until the new ones are tested, tests of the old ones count for
/// them, so that a mesh whose triangles change with each message is not unknown each time. Keeps no triangles in
/// memory.
class StandIns {
 public:
  /// How long triangles stand in for those that replaced them.
  static constexpr Duration kTime = std::chrono::milliseconds(50);

  /// Takes over what was replaced. A workpiece that is removed, or comes in another frame, has no stand-in.
  /// @param before, newest  snapshots of all workpieces, each ascending by id
  /// @param now             when the newest came; empty: each when it was received
  void update(const Workpieces& before, const Workpieces& newest, std::optional<SteadyTime> now);

  /// Returns until when the triangles that were tested stand in for those of a newest snapshot; empty: they never did.
  std::optional<SteadyTime> until(const Workpieces& tested, const Workpiece& newest) const;

 private:
  struct Replaced {
    std::string id;
    std::weak_ptr<const std::vector<Triangle>> triangles;
    SteadyTime at;
  };

  void replace(Replaced old);
  void forget(const std::string& id);

  std::vector<Replaced> replaced_;  // those that somebody still uses
};

}  // namespace sweep_guard_core
