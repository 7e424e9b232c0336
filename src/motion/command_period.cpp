#include "sweep_guard/motion/command_period.h"

#include <algorithm>
#include <numeric>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kShortest = std::chrono::milliseconds(1);

}  // namespace

CommandPeriod::CommandPeriod(Duration longest) : bound_(longest) {
  if (longest < kShortest) throw InvalidInput("longest period of commands: must be at least 1 ms");
}

void CommandPeriod::add(SteadyTime received) {
  if (received_) {
    const Duration interval = received - *received_;
    if (interval > bound_) {
      count_ = 0;
    } else {
      intervals_[count_++ % kIntervals] = interval;
    }
  }
  received_ = received;
}

Duration CommandPeriod::longest() const {
  if (count_ == 0) return bound_;
  return bounded(*std::max_element(intervals_.begin(), intervals_.begin() + std::min(count_, kIntervals)));
}

Duration CommandPeriod::mean() const {
  const size_t count = std::min(count_, kIntervals);
  if (count == 0) return bound_;
  const Duration sum = std::accumulate(intervals_.begin(), intervals_.begin() + count, Duration::zero());
  return bounded(sum / static_cast<Duration::rep>(count));
}

Duration CommandPeriod::bounded(Duration period) const { return std::clamp(period, kShortest, bound_); }

}  // namespace sweep_guard_core
