#include "rviz/volume_history.h"

#include <algorithm>
#include <iterator>

#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::TestedVolume;

// Nearer than half the least width.
bool isNear(const TestedVolume& volume, const TestedVolume& other) {
  const auto& half = volume.half_extents;
  const auto reach = static_cast<float>(std::min({half.x, half.y, half.z}));
  return toOgre(volume.pose.position).distance(toOgre(other.pose.position)) < reach;
}

template <typename Volumes>
bool isNearAny(const TestedVolume& volume, const Volumes& others) {
  return std::any_of(others.begin(), others.end(), [&](const TestedVolume& other) { return isNear(volume, other); });
}

}  // namespace

void VolumeHistory::add(const Volumes& volumes, size_t max_count) {
  for (const TestedVolume& volume : volumes) {
    if (!isNearAny(volume, kept_)) kept_.push_back(volume);
  }
  while (kept_.size() > max_count) kept_.pop_front();
}

VolumeHistory::Volumes VolumeHistory::beside(const Volumes& newest) const {
  Volumes shown;
  std::copy_if(kept_.begin(), kept_.end(), std::back_inserter(shown),
               [&](const TestedVolume& volume) { return !isNearAny(volume, newest); });
  return shown;
}

}  // namespace sweep_guard_rviz
