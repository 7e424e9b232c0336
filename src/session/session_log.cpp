#include "session/session_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

namespace {

constexpr double kUnknownDepth = std::numeric_limits<double>::quiet_NaN();

// What is left of a warning after a contact does not warn of the next: the way back ends there.
Time onSince(const std::vector<Segment>& segments, std::size_t contact, WarningLevel least) {
  std::size_t first = contact;
  while (first > 0 && segments[first - 1].level >= least && segments[first - 1].level < WarningLevel::kContact) --first;
  return segments[first].begin;
}

void take(Contact& contact, const Touch& touch) {
  if (contact.triangles.empty() && contact.mesh_id.empty()) {
    contact.begin = touch.first;
    contact.mesh_id = touch.mesh_id;
    contact.tool_link = touch.tool_link;
  }
  if (touch.mesh_id != contact.mesh_id) return;
  contact.triangles.insert(touch.triangles.begin(), touch.triangles.end());
  contact.depth = std::fmax(contact.depth, touch.depth);  // of a number and NaN, the number
}

// To each contact the touches heard in it, and those heard later of poses within it.
void share(const std::vector<Touch>& touches, std::vector<Contact>& contacts) {
  std::size_t i = 0;
  for (const Touch& touch : touches) {
    while (i < contacts.size() && touch.heard > contacts[i].end) ++i;
    const bool late = i > 0 && touch.stamp <= contacts[i - 1].end;
    if (late || i < contacts.size()) take(contacts[late ? i - 1 : i], touch);
  }
}

}  // namespace

void SessionLog::add(const Told& told) {
  told_.push_back(told);
  end_ = told.at;
}

void SessionLog::end(Time at) { end_ = std::max(end_, at); }

std::vector<Segment> SessionLog::segments() const {
  std::vector<Segment> segments;
  Duration longest{0};
  for (std::size_t i = 0; i < told_.size(); ++i) {
    const Time until = i + 1 < told_.size() ? told_[i + 1].at : end_;
    const Duration lasted = until - told_[i].at;
    if (lasted == Duration(0)) continue;
    if (segments.empty() || segments.back().level != told_[i].level) {
      segments.push_back({told_[i].level, told_[i].at, until, told_[i].text});
      longest = lasted;
    }
    segments.back().end = until;
    if (lasted > longest) segments.back().text = told_[i].text;
    longest = std::max(longest, lasted);
  }
  return segments;
}

std::vector<Contact> SessionLog::contacts() const {
  const std::vector<Segment> segments = this->segments();
  std::vector<Contact> contacts;
  std::vector<std::size_t> places;  // among the segments
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].level != WarningLevel::kContact) continue;
    contacts.push_back({segments[i].begin, segments[i].end, "", "", {}, kUnknownDepth, {}, {}});
    places.push_back(i);
  }
  share(touches_, contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto lead = [&](WarningLevel least) {
      return std::max(contacts[i].begin - onSince(segments, places[i], least), Duration(0));
    };
    contacts[i].considered_lead = lead(WarningLevel::kConsidered);
    contacts[i].reflex_lead = lead(WarningLevel::kReflex);
  }
  return contacts;
}

Duration SessionLog::duration(WarningLevel level) const {
  Duration sum{0};
  for (const Segment& segment : segments()) {
    if (segment.level == level) sum += segment.end - segment.begin;
  }
  return sum;
}

}  // namespace sweep_guard_session
