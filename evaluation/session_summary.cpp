#include "evaluation/session_summary.h"

#include <cmath>

#include "evaluation/random.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_evaluation {

namespace {

constexpr size_t kDraws = 1000;

}  // namespace

SessionCount sumOf(const RecordingSessions& sessions) {
  SessionCount sum;
  for (const std::vector<SessionCount>& objects : sessions.objects) {
    for (const SessionCount& object : objects) {
      sum.minutes += sessions.minutes;
      sum += object;
    }
  }
  return sum;
}

SessionCount sumOf(const std::vector<RecordingSessions>& recordings) {
  SessionCount all;
  for (const RecordingSessions& recording : recordings) all += sumOf(recording);
  return all;
}

std::vector<RecordingSessions> resampled(const std::vector<RecordingSessions>& recordings, size_t draw) {
  Random random(draw);
  const auto choose = [&](const auto& list) -> const auto& {
    return list[static_cast<size_t>(random.uniform(0.0, static_cast<double>(list.size())))];
  };
  std::vector<RecordingSessions> drawn = recordings;
  for (size_t i = 0; i < recordings.size(); ++i) {
    for (std::vector<SessionCount>& objects : drawn[i].objects) {
      for (SessionCount& object : objects) object = choose(choose(recordings[i].objects));
    }
  }
  return drawn;
}

std::vector<Interval> bootstrap(const std::function<std::vector<double>(size_t draw)>& figures) {
  std::vector<std::vector<double>> samples;
  for (size_t draw = 0; draw < kDraws; ++draw) {
    const std::vector<double> drawn = figures(draw);
    samples.resize(drawn.size());
    for (size_t i = 0; i < drawn.size(); ++i) {
      if (!std::isnan(drawn[i])) samples[i].push_back(drawn[i]);
    }
  }
  std::vector<Interval> intervals;
  intervals.reserve(samples.size());
  for (const std::vector<double>& sample : samples) {
    intervals.push_back({sweep_guard_core::quantile(sample, 0.025), sweep_guard_core::quantile(sample, 0.975)});
  }
  return intervals;
}

}  // namespace sweep_guard_evaluation
