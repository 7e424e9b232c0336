#include "latency/figures.h"

#include <algorithm>
#include <iterator>

namespace sweep_guard_benchmark {
namespace {

double milliseconds(Nanoseconds duration) { return 1e-6 * static_cast<double>(duration); }

}  // namespace

std::vector<double> latencies(const std::vector<Nanoseconds>& poses, const std::vector<Heard>& heard) {
  std::vector<double> latencies;
  auto covering = heard.begin();
  for (const Nanoseconds pose : poses) {
    covering = std::find_if(covering, heard.end(), [&](const Heard& one) { return one.stamp >= pose; });
    if (covering == heard.end()) break;
    if (covering->begin < pose || covering->stamp == pose) {
      latencies.push_back(milliseconds(covering->received - pose));
    }
  }
  return latencies;
}

std::vector<double> ages(const std::vector<Heard>& heard) {
  std::vector<double> ages;
  for (auto one = heard.begin(); one != heard.end(); ++one) {
    const bool repeats = one != heard.begin() && one->stamp == std::prev(one)->stamp;
    if (!repeats) ages.push_back(milliseconds(one->received - one->stamp));
  }
  return ages;
}

std::size_t holes(const std::vector<Heard>& heard) {
  std::size_t holes = 0;
  for (std::size_t i = 1; i < heard.size(); ++i) holes += heard[i].begin > heard[i - 1].stamp ? 1 : 0;
  return holes;
}

std::vector<Heard> within(const std::vector<Heard>& heard, Nanoseconds begin, Nanoseconds end) {
  std::vector<Heard> inside;
  std::copy_if(heard.begin(), heard.end(), std::back_inserter(inside),
               [&](const Heard& one) { return one.stamp >= begin && one.stamp < end; });
  return inside;
}

}  // namespace sweep_guard_benchmark
