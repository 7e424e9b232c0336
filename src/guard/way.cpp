#include "sweep_guard/guard/way.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard {
namespace {

template <typename Placed, typename Key, typename KeyOf>
size_t lastUpToKey(const Placed* first, const Placed* end, const Key& key, const KeyOf& key_of) {
  const auto* beyond =
      std::upper_bound(first, end, key, [&](const Key& a, const Placed& placed) { return a < key_of(placed); });
  return static_cast<size_t>(std::max<std::ptrdiff_t>(beyond - first, 1) - 1);
}

}  // namespace

void Way::add(const Placed& placed) {
  if (size() >= kLongest) {
    all_[begin_ + 1] = all_[begin_];
    ++begin_;
  }
  if (all_.size() == all_.capacity() && begin_ >= all_.size() / 2) {
    all_.erase(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
  all_.push_back(placed);
}

size_t Way::lastUpTo(std::uint64_t number) const {
  return lastUpToKey(&all_[begin_], &all_[begin_] + size(), number, [](const Placed& placed) { return placed.number; });
}

size_t Way::lastUpTo(Time stamp) const {
  return lastUpToKey(&all_[begin_], &all_[begin_] + size(), stamp, [](const Placed& placed) { return placed.stamp; });
}

double Way::share(size_t from, size_t i) const {
  if (i <= from) return 0.0;
  const double time = toSeconds(newest().stamp - (*this)[from].stamp);
  return time > 0.0 ? toSeconds((*this)[i].stamp - (*this)[from].stamp) / time : 1.0;
}

void Way::waypoints_M(size_t first, size_t last, double tool_extent, Waypoints& waypoints_M) const {
  assert(first <= last && last < size());
  waypoints_M.clear();
  for (size_t i = first; i <= last; ++i) {
    const Placed& to = (*this)[i];
    const Placed& from = (*this)[std::max(i, first + 1) - 1];
    const double off = i == first ? 0.0 : arc({{from.X_WT, to.X_WT}, {from.X_WM, to.X_WM}}, tool_extent);
    waypoints_M.push_back({to.stamp - (*this)[first].stamp, to.X_WM.inverse() * to.X_WT, off});
  }
}

}  // namespace sweep_guard
