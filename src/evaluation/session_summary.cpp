#include "evaluation/session_summary.h"

#include <algorithm>
#include <cmath>

#include "evaluation/random.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;

namespace {

constexpr size_t kDraws = 1000;

double share(size_t part, size_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

}  // namespace

double minutesOf(std::vector<Alarm> intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Alarm& a, const Alarm& b) { return a.begin < b.begin; });
  Duration on{0};
  sweep_guard_core::Time until = sweep_guard_core::Time::min();
  for (const Alarm& interval : intervals) {
    const auto begin = std::max(interval.begin, until);
    if (interval.end <= begin) continue;
    on += interval.end - begin;
    until = interval.end;
  }
  return sweep_guard_core::toSeconds(on) / 60.0;
}

double SessionFigures::warned(size_t lead) const { return share(count.warned[lead], count.contacts); }

double SessionFigures::unjustifiedPerMinute() const { return static_cast<double>(count.unjustified) / minutes; }

double SessionFigures::precision() const { return share(count.alarms - count.unjustified, count.alarms); }

double SessionFigures::precisionWithin(size_t near) const {
  return share(count.alarms - count.unjustified + count.near_misses[near], count.alarms);
}

double SessionFigures::falseOnShare() const { return false_on_minutes / minutes; }

SessionFigures& SessionFigures::operator+=(const SessionFigures& other) {
  minutes += other.minutes;
  count += other.count;
  false_on_minutes += other.false_on_minutes;
  return *this;
}

SessionFigures figuresOf(const RecordingSessions& sessions) {
  SessionFigures figures;
  for (const std::vector<ObjectCount>& objects : sessions.objects) {
    figures.minutes += sessions.minutes;
    std::vector<Alarm> unjustified;
    for (const ObjectCount& object : objects) {
      figures.count += object.count;
      unjustified.insert(unjustified.end(), object.unjustified.begin(), object.unjustified.end());
    }
    figures.false_on_minutes += minutesOf(std::move(unjustified));
  }
  return figures;
}

SessionFigures figuresOf(const std::vector<RecordingSessions>& recordings) {
  SessionFigures all;
  for (const RecordingSessions& recording : recordings) all += figuresOf(recording);
  return all;
}

std::vector<RecordingSessions> resampled(const std::vector<RecordingSessions>& recordings, size_t draw) {
  Random random(draw);
  const auto choose = [&](const auto& list) -> const auto& {
    return list[static_cast<size_t>(random.uniform(0.0, static_cast<double>(list.size())))];
  };
  std::vector<RecordingSessions> drawn = recordings;
  for (size_t i = 0; i < recordings.size(); ++i) {
    for (std::vector<ObjectCount>& objects : drawn[i].objects) {
      for (ObjectCount& object : objects) object = choose(choose(recordings[i].objects));
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
  for (const std::vector<double>& sample : samples) {
    intervals.push_back({sweep_guard_core::quantile(sample, 0.025), sweep_guard_core::quantile(sample, 0.975)});
  }
  return intervals;
}

}  // namespace sweep_guard_evaluation
