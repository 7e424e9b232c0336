#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_core {

/// What one guard says, with the names of msg/Warning.msg.
struct HeardWarning {
  WarningLevel level = WarningLevel::kUnknown;
  std::uint32_t reasons = 0;
  Time stamp;  ///< of the pose that it rests on; 0: none
  std::optional<Duration> time_to_collision;
  Time covered_until;  ///< 0: never
  Time valid_until;
  bool held = false;
  bool acknowledged = false;
  bool intended = false;
  std::string text;
  Instant received;
};

/// The merged warning of several guards.
struct MergedWarning {
  WarningLevel level = WarningLevel::kUnknown;
  std::uint32_t reasons = 0;  ///< those of all guards; kNotCovered for one that is silent
  /// Index of the guard whose warning is shown: of this level, rather one that lasts than one that is held, rather one that
  /// is not acknowledged, the earliest collision, the oldest pose. Empty: only silent guards make the level.
  std::optional<size_t> leader;
  std::optional<Duration> time_to_collision;  ///< the earliest
  Time covered_until;                         ///< the earliest; 0 if a guard is silent
  Time valid_until;                           ///< the earliest of the guards that count, at most kValid from now
  bool acknowledged = false;                  ///< of the leader
  bool intended = false;                      ///< of any guard
  std::string text;                           ///< level, and what each guard says that is not CLEAR
};

/// Merges the newest warnings of guards. The worst level counts, in the order in which it does within one guard: CONTACT,
/// REFLEX, CONSIDERED, UNKNOWN, CLEAR. So CLEAR needs that every guard says so and none is silent. A guard is silent, which
/// is UNKNOWN, before its first warning, `timeout` after its newest was received, and after that one's `valid_until`.
class WarningMerger {
 public:
  static constexpr Duration kValid = std::chrono::milliseconds(200);    ///< of a guard's warning, as it publishes it
  static constexpr Duration kMaxLead = std::chrono::milliseconds(100);  ///< that the clock of a guard may be ahead

  /// @param guards   names, for the text; at least one (asserted)
  /// @param timeout  > 0
  explicit WarningMerger(std::vector<std::string> guards, Duration timeout = kValid);

  /// Takes the newest warning of a guard. @param guard  index of its name
  void hear(size_t guard, HeardWarning warning);

  /// Returns why a guard counts as silent; empty: it does not.
  std::string silence(size_t guard, const Instant& now) const;
  MergedWarning merged(const Instant& now) const;

  const std::vector<std::string>& guards() const { return guards_; }

 private:
  void addTo(MergedWarning& all, size_t guard) const;
  bool leads(size_t guard, size_t other) const;

  std::vector<std::string> guards_;
  Duration timeout_;
  std::vector<std::optional<HeardWarning>> newest_;  // by guard
};

}  // namespace sweep_guard_core
