#include "latency/latencies.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace sweep_guard_benchmark {
namespace {

constexpr double kClasses = 20.0;  // per decade
constexpr double kMin = 1e-3;      // [ms]

double milliseconds(Nanoseconds duration) { return 1e-6 * static_cast<double>(duration); }

}  // namespace

std::vector<double> latencies(const std::vector<Nanoseconds>& poses, const std::vector<ReceivedMessage>& messages) {
  std::vector<double> latencies;
  auto covering = messages.begin();
  for (const Nanoseconds pose : poses) {
    covering = std::find_if(covering, messages.end(), [&](const ReceivedMessage& one) { return one.stamp >= pose; });
    if (covering == messages.end()) break;
    if (covering->begin < pose || covering->stamp == pose) {
      latencies.push_back(milliseconds(covering->received - pose));
    }
  }
  return latencies;
}

std::vector<double> ages(const std::vector<ReceivedMessage>& messages) {
  std::vector<double> ages;
  for (auto one = messages.begin(); one != messages.end(); ++one) {
    const bool repeats = one != messages.begin() && one->stamp == std::prev(one)->stamp;
    if (!repeats) ages.push_back(milliseconds(one->received - one->stamp));
  }
  return ages;
}

std::vector<HistogramClass> histogram(const std::vector<double>& milliseconds) {
  std::map<int, double> counts;
  for (const double value : milliseconds) {
    counts[static_cast<int>(std::floor(kClasses * std::log10(std::max(value, kMin))))] += 1.0;
  }
  std::vector<HistogramClass> classes;
  if (counts.empty()) return classes;
  for (int number = counts.begin()->first; number <= counts.rbegin()->first; ++number) {
    classes.push_back(
        {std::pow(10.0, (number + 0.5) / kClasses), counts[number] / static_cast<double>(milliseconds.size())});
  }
  return classes;
}

std::size_t holes(const std::vector<ReceivedMessage>& messages) {
  std::size_t holes = 0;
  for (std::size_t i = 1; i < messages.size(); ++i) holes += messages[i].begin > messages[i - 1].stamp ? 1 : 0;
  return holes;
}

std::vector<ReceivedMessage> within(const std::vector<ReceivedMessage>& messages, Nanoseconds begin, Nanoseconds end) {
  std::vector<ReceivedMessage> inside;
  std::copy_if(messages.begin(), messages.end(), std::back_inserter(inside),
               [&](const ReceivedMessage& one) { return one.stamp >= begin && one.stamp < end; });
  return inside;
}

}  // namespace sweep_guard_benchmark
