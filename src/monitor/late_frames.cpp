#include "monitor/late_frames.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr size_t kKeptIntervals = 16;
constexpr Duration kLateTime = std::chrono::seconds(1);

Duration median(std::vector<Duration> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool isTooOld(const WarningInputs::Frame& frame, const Instant& now, Duration pose_timeout) {
  return stale(frame.newest, now, pose_timeout + std::min(frame.period, pose_timeout));
}

// Before there are two transforms, the period is not known: as long as it may be.
WarningInputs::Frame& findFrame(std::vector<WarningInputs::Frame>& frames, const std::string& name,
                                const Timestamps& newest) {
  const auto is_before = [](const WarningInputs::Frame& frame, const std::string& key) { return frame.name < key; };
  const auto place = std::lower_bound(frames.begin(), frames.end(), name, is_before);
  if (place != frames.end() && place->name == name) return *place;
  return *frames.insert(place, {name, newest, Duration::max(), {}, {}, {}});
}

}  // namespace

void addTransform(std::vector<WarningInputs::Frame>& frames, const std::string& name, Time stamp, const Instant& now,
                  Duration pose_timeout) {
  WarningInputs::Frame& frame = findFrame(frames, name, {stamp, now.steady});
  if (stamp == frame.newest.stamp) return;
  if (stamp < frame.newest.stamp) {
    frame = {name, {stamp, now.steady}, Duration::max(), {}, {}, {}};
    return;
  }
  if (isTooOld(frame, now, pose_timeout)) {
    frame.late = age(frame.newest, now);
    frame.found = now.steady;
  }
  if (frame.intervals.size() == kKeptIntervals) frame.intervals.erase(frame.intervals.begin());
  frame.intervals.push_back(stamp - frame.newest.stamp);
  frame.period = median(frame.intervals);
  frame.newest = {stamp, now.steady};
}

void keepOnly(const std::set<std::string>& names, std::vector<WarningInputs::Frame>& frames) {
  const auto is_gone = [&](const WarningInputs::Frame& frame) { return names.count(frame.name) == 0; };
  frames.erase(std::remove_if(frames.begin(), frames.end(), is_gone), frames.end());
}

std::optional<Duration> lateAge(const WarningInputs::Frame& frame, const Instant& now, Duration pose_timeout) {
  const bool was_late = frame.found && now.steady - *frame.found <= kLateTime;
  if (!was_late && !isTooOld(frame, now, pose_timeout)) return std::nullopt;
  return std::max(age(frame.newest, now), was_late ? frame.late : Duration::zero());
}

}  // namespace sweep_guard_core
