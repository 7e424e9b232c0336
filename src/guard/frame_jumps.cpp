#include "guard/frame_jumps.h"

#include <utility>

namespace sweep_guard_core {
namespace {

Moved movedInFrame(const PoseSample& from, const PoseSample& to) {
  return movedBetween(from.X_WM.inverse() * from.X_WT, to.X_WM.inverse() * to.X_WT);
}

// A way that is swept once more, where something was placed anew, takes no time.
bool isRepeated(const PoseHistory& history, size_t i) {
  while (i > 0 && !history[i].anew && history[i - 1].stamp == history[i].stamp) --i;
  return history[i].anew;
}

// Returns the newest pose that is older than pose `i` by 20 ms; if there is none, the first that the tool has moved from.
size_t longBefore(const PoseHistory& history, size_t i) {
  size_t before = i - 1;
  while (before > 0 && history[i].stamp - history[before].stamp < kJumpTime && !history[before].anew) --before;
  if (!history[before].anew) return before;
  const Time stamp = history[before].stamp;
  while (before + 1 < i && history[before + 1].stamp == stamp) ++before;
  return before;
}

std::optional<JumpSpeed> jumpTo(size_t i, const PoseHistory& history, const SpeedLimits& limits) {
  const auto since = [&](const PoseSample& from) {
    return std::pair(movedInFrame(from, history[i]), history[i].stamp - from.stamp);
  };
  const auto [step, within] = since(history[i - 1]);
  return jumpOfStep(step, within, limits, [&] { return since(history[longBefore(history, i)]); });
}

}  // namespace

std::optional<JumpSpeed> jumpAfter(std::uint64_t number, const PoseHistory& history, const SpeedLimits& limits) {
  std::optional<JumpSpeed> fastest;
  for (size_t i = history.size() - 1; i > 0 && history[i].number > number; --i) {
    if (isRepeated(history, i)) continue;
    const auto jump = jumpTo(i, history, limits);
    if (jump && (!fastest || jump->speed > fastest->speed)) fastest = jump;
  }
  return fastest;
}

}  // namespace sweep_guard_core
