#include "guard/closest_approach.h"

#include <algorithm>

#include "common/floating_point.h"

namespace sweep_guard_core {

void ClosestApproach::add(Duration from, double deviations) {
  if (deviations >= upTo(from)) return;
  const auto first = std::lower_bound(falls_.begin(), falls_.end(), from,
                                      [](const auto& fall, Duration time) { return fall.first < time; });
  const auto last = std::find_if(first, falls_.end(), [=](const auto& fall) { return fall.second < deviations; });
  falls_.insert(falls_.erase(first, last), {from, deviations});
}

double ClosestApproach::upTo(Duration from) const {
  const auto next = std::upper_bound(falls_.begin(), falls_.end(), from,
                                     [](Duration time, const auto& fall) { return time < fall.first; });
  return next == falls_.begin() ? kInfinity : std::prev(next)->second;
}

ClosestApproach& ClosestApproaches::to(const Workpiece& workpiece) {
  const auto end = approaches_.begin() + static_cast<std::ptrdiff_t>(used_);
  const auto known = std::find_if(approaches_.begin(), end, [&](const auto& one) { return one.first == &workpiece; });
  if (known != end) return known->second;
  if (used_ == approaches_.size()) approaches_.emplace_back();
  auto& [whose, approach] = approaches_[used_++];
  whose = &workpiece;
  approach.clear();
  return approach;
}

}  // namespace sweep_guard_core
