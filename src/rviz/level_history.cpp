#include "rviz/level_history.h"

#include <algorithm>

namespace sweep_guard_rviz {

void LevelHistory::add(Sample sample) {
  if (!samples_.empty()) sample.since = std::max(sample.since, samples_.back().since);
  samples_.push_back(sample);
  while (samples_.size() > 1 && samples_[1].since + kHistory < sample.since) samples_.pop_front();
}

double LevelHistory::longestTime() const {
  double longest = 0.0;
  for (const Sample& sample : samples_) longest = std::max(longest, sample.time.value_or(0.0));
  return longest;
}

}  // namespace sweep_guard_rviz
