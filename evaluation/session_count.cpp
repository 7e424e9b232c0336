#include "evaluation/session_count.h"

#include <algorithm>

namespace sweep_guard_evaluation {

using std::chrono::milliseconds;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;
using sweep_guard_recording::LevelTrace;

namespace {

constexpr Duration kTouchStep = milliseconds(5);
constexpr Duration kCoarseStep = milliseconds(20);
constexpr double kDistanceTolerance = 1e-3;  // [m]

double share(size_t part, size_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

bool isContact(const RecordedMotion& motion, const std::vector<TimeInterval>& touches, size_t touch) {
  const Time begin = touches[touch].begin;
  const bool again = touch > 0 && begin - touches[touch - 1].end < kSessionWindow;
  return !again && motion.isContinuous(begin - kSessionWindow, begin);
}

bool isOn(const std::vector<TimeInterval>& alarms, Time time) {
  return std::any_of(alarms.begin(), alarms.end(),
                     [&](const TimeInterval& alarm) { return alarm.begin <= time && alarm.end >= time; });
}

Time firstPoseFrom(const RecordedMotion& motion, Time time) {
  const size_t before = motion.newestAt(time);
  return motion.poses()[before].stamp == time ? time : motion.poses()[before + 1].stamp;
}

void countContact(const RecordedMotion& motion, const LevelTrace& levels, Time contact,
                  const std::vector<TimeInterval>& alarms, SessionCount& count) {
  ++count.contacts;
  const auto on = std::find_if(alarms.begin(), alarms.end(), [&](const TimeInterval& alarm) {
    return alarm.begin <= contact && alarm.end >= contact;
  });
  for (size_t i = 0; i < kSessionLeads.size(); ++i) {
    if (on != alarms.end() && contact - on->begin >= sweep_guard_core::fromSeconds(kSessionLeads[i])) ++count.warned[i];
  }
  const Time known = firstPoseFrom(motion, contact);
  if (!isOn(levels.alarms(WarningLevel::kReflex), known)) ++count.late;
}

// The alarm comes from a sweep that began at the pose before it.
TimeInterval judgedInterval(const RecordedMotion& motion, const TimeInterval& alarm) {
  const Time end = std::min(std::max(alarm.end, alarm.begin + kSessionWindow), motion.poses().back().stamp);
  const size_t pose = motion.newestAt(alarm.begin);
  return {motion.poses()[pose == 0 ? 0 : pose - 1].stamp, end};
}

bool isJustified(const std::vector<TimeInterval>& touches, const TimeInterval& judged) {
  return std::any_of(touches.begin(), touches.end(),
                     [&](const TimeInterval& touch) { return touch.begin <= judged.end && touch.end >= judged.begin; });
}

void countAlarm(const RecordedMotion& motion, const TimeInterval& alarm, bool measure_near_misses,
                ObjectSession& object) {
  SessionCount& count = object.count;
  ++count.alarms;
  const TimeInterval judged = judgedInterval(motion, alarm);
  if (isJustified(object.touches, judged)) return;
  ++count.unjustified;
  count.unjustified_time += alarm.end - alarm.begin;
  if (!measure_near_misses) return;
  const double nearest = nearestDistance(motion, object.mesh, judged.begin, judged.end);
  for (size_t i = 0; i < kNearMisses.size(); ++i) {
    if (nearest < kNearMisses[i]) ++count.near_misses[i];
  }
}

}  // namespace

std::vector<TimeInterval> touchesOf(const RecordedMotion& motion, ObstacleMesh& object) {
  const Time last = motion.poses().back().stamp;
  const ClearanceAt clearance = object.clearance();
  std::vector<TimeInterval> touches;
  Time from = motion.poses().front().stamp;
  while (const auto contact = firstContact(motion, object.tool(), clearance, from, last)) {
    Time end = *contact;
    while (end < last && clearance(motion.at(end)) == 0.0) end = std::min(end + kTouchStep, last);
    touches.push_back({*contact, end});
    if (end == last) break;
    from = end;
  }
  return touches;
}

double nearestDistance(const RecordedMotion& motion, ObstacleMesh& object, Time from, Time to) {
  double nearest = object.distance(motion.at(to));
  for (Time time = from; time < to; time += kCoarseStep) nearest = std::min(nearest, object.distance(motion.at(time)));
  for (Time time = from; time < to && nearest > 0.0;) {
    const double distance = object.distance(motion.at(time));
    nearest = std::min(nearest, distance);
    const double left = distance - std::min(nearest, kExactDistance) + kDistanceTolerance;
    time = std::max(earliestArrival(motion, object.tool(), time, to, left), time + Duration(1));
  }
  return nearest;
}

double SessionCount::warnedShare(size_t lead) const { return share(warned[lead], contacts); }

double SessionCount::unjustifiedPerMinute() const { return static_cast<double>(unjustified) / minutes; }

double SessionCount::precision() const { return share(alarms - unjustified, alarms); }

double SessionCount::precisionWithin(size_t near) const {
  return share(alarms - unjustified + near_misses[near], alarms);
}

double SessionCount::falseOnShare() const { return sweep_guard_core::toSeconds(unjustified_time) / 60.0 / minutes; }

SessionCount& SessionCount::operator+=(const SessionCount& other) {
  contacts += other.contacts;
  for (size_t i = 0; i < warned.size(); ++i) warned[i] += other.warned[i];
  late += other.late;
  alarms += other.alarms;
  unjustified += other.unjustified;
  unjustified_time += other.unjustified_time;
  for (size_t i = 0; i < near_misses.size(); ++i) near_misses[i] += other.near_misses[i];
  minutes += other.minutes;
  return *this;
}

void countSession(const RecordedMotion& motion, const LevelTrace& levels, bool measure_near_misses,
                  ObjectSession& object) {
  object.count = {};
  const std::vector<TimeInterval> alarms = levels.alarms(WarningLevel::kConsidered);
  for (size_t i = 0; i < object.touches.size(); ++i) {
    if (isContact(motion, object.touches, i))
      countContact(motion, levels, object.touches[i].begin, alarms, object.count);
  }
  for (const TimeInterval& alarm : alarms) {
    if (!motion.isContinuous(alarm.begin, alarm.begin + kSessionWindow)) continue;
    countAlarm(motion, alarm, measure_near_misses, object);
  }
}

}  // namespace sweep_guard_evaluation
