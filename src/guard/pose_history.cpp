#include "guard/pose_history.h"

#include <algorithm>
#include <cassert>

namespace sweep_guard_core {
namespace {

template <typename Key, typename KeyOf>
size_t lastUpToKey(const PoseSample* first, const PoseSample* end, const Key& key, const KeyOf& key_of) {
  const auto* beyond =
      std::upper_bound(first, end, key, [&](const Key& a, const PoseSample& sample) { return a < key_of(sample); });
  return static_cast<size_t>(std::max<std::ptrdiff_t>(beyond - first, 1) - 1);
}

}  // namespace

size_t PoseHistory::lastUpTo(std::uint64_t number) const {
  return lastUpToKey(all_.begin(), all_.end(), number, [](const PoseSample& sample) { return sample.number; });
}

size_t PoseHistory::lastUpTo(Time stamp) const {
  return lastUpToKey(all_.begin(), all_.end(), stamp, [](const PoseSample& sample) { return sample.stamp; });
}

double PoseHistory::share(size_t from, size_t i, Time end) const {
  if (i <= from) return 0.0;
  const double time = toSeconds(end - (*this)[from].stamp);
  return time > 0.0 ? toSeconds((*this)[i].stamp - (*this)[from].stamp) / time : 1.0;
}

void PoseHistory::path_M(size_t first, size_t last, double tool_radius, Path& path_M) const {
  assert(first <= last && last < size());
  path_M.clear();
  for (size_t i = first; i <= last; ++i) {
    const PoseSample& to = (*this)[i];
    const PoseSample& from = (*this)[std::max(i, first + 1) - 1];
    const double turn = chordError({{from.X_WT, to.X_WT}, {from.X_WM, to.X_WM}}, tool_radius);
    const double deviation = i == first ? 0.0 : turn + to.deviation_bound;
    path_M.push_back({to.stamp - (*this)[first].stamp, to.X_WM.inverse() * to.X_WT, deviation});
  }
}

}  // namespace sweep_guard_core
