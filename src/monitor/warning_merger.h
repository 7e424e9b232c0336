#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_core {

/// What one guard says, with the names of msg/Warning.msg.
struct HeardWarning {
  WarningLevel level = WarningLevel::kUnknown;
  std::uint32_t reasons = 0;
  Time stamp = {};  ///< of the pose that it rests on; 0: none
  std::optional<Duration> time_to_collision = {};
  Time covered_until = {};  ///< 0: never
  Time valid_until = {};
  bool held = false;
  bool acknowledged = false;
  bool intended = false;
  std::optional<double> seen = {};
  std::string text = {};
  Instant received = {};
};

/// What several guards say together, with the same names.
struct MergedWarning {
  WarningLevel level = WarningLevel::kUnknown;
  std::uint32_t reasons = 0;
  std::optional<Duration> time_to_collision = {};
  Time covered_until = {};  ///< 0: never
  Time valid_until = {};
  bool acknowledged = false;
  bool intended = false;
  std::optional<double> seen = {};  ///< the smallest
  std::string text = {};
  /// Index of the guard whose warning is shown. Empty: only silent guards make the level.
  std::optional<size_t> leader = {};
};

/// Merges the newest warnings of guards. The worst level counts, in the order in which it does within one guard: CONTACT,
/// REFLEX, CONSIDERED, UNKNOWN, CLEAR. So CLEAR needs that every guard says so and none is silent. A guard is silent, which
/// is UNKNOWN, before its first warning, `timeout` after its newest was received, and after that one's `valid_until`.
class WarningMerger {
 public:
  static constexpr Duration kMaxLead = std::chrono::milliseconds(100);  ///< that the clock of a guard may be ahead

  /// @param guards   names, for the text; at least one (asserted)
  /// @param timeout  > 0
  explicit WarningMerger(std::vector<std::string> guards, Duration timeout = kWarningValid);

  /// Takes the newest warning of a guard. @param guard  index of its name
  void hear(size_t guard, HeardWarning warning);

  /// Returns why a guard counts as silent; empty: it does not.
  std::string silence(size_t guard, const Instant& now) const;

  /// Returns the warning of all guards: the reasons of all, kNotCovered for one that is silent; the earliest times,
  /// `valid_until` of the guards that count and at most kWarningValid from now, and `covered_until` 0 if one is silent;
  /// `acknowledged` of the leader, `intended` of any, the smallest `seen`; the level, and what each guard says that is not
  /// CLEAR. The leader is of this level, rather one that lasts than one that is held, rather one that is not acknowledged,
  /// with the earliest collision, with the oldest pose.
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
