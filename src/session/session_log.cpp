#include "session/session_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_session {

using sweep_guard::Duration;
using sweep_guard::Level;
using sweep_guard::Time;

namespace {

constexpr double kUnknownDepth = std::numeric_limits<double>::quiet_NaN();

// What is left of a warning after a contact does not warn of the next: the way back ends there.
Time onSince(const std::vector<Stretch>& stretches, std::size_t contact, Level least) {
  std::size_t first = contact;
  while (first > 0 && stretches[first - 1].level >= least && stretches[first - 1].level < Level::kContact) --first;
  return stretches[first].begin;
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

std::vector<Stretch> SessionLog::stretches() const {
  std::vector<Stretch> stretches;
  Duration longest{0};
  for (std::size_t i = 0; i < told_.size(); ++i) {
    const Time until = i + 1 < told_.size() ? told_[i + 1].at : end_;
    const Duration lasted = until - told_[i].at;
    if (lasted == Duration(0)) continue;
    if (stretches.empty() || stretches.back().level != told_[i].level) {
      stretches.push_back({told_[i].level, told_[i].at, until, told_[i].text});
      longest = lasted;
    }
    stretches.back().end = until;
    if (lasted > longest) stretches.back().text = told_[i].text;
    longest = std::max(longest, lasted);
  }
  return stretches;
}

std::vector<Contact> SessionLog::contacts() const {
  const std::vector<Stretch> stretches = this->stretches();
  std::vector<Contact> contacts;
  std::vector<std::size_t> places;  // among the stretches
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    if (stretches[i].level != Level::kContact) continue;
    contacts.push_back({stretches[i].begin, stretches[i].end, "", "", {}, kUnknownDepth, {}, {}});
    places.push_back(i);
  }
  share(touches_, contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto lead = [&](Level least) {
      return std::max(contacts[i].begin - onSince(stretches, places[i], least), Duration(0));
    };
    contacts[i].considered_lead = lead(Level::kConsidered);
    contacts[i].reflex_lead = lead(Level::kReflex);
  }
  return contacts;
}

Duration SessionLog::duration(Level level) const {
  Duration sum{0};
  for (const Stretch& stretch : stretches()) {
    if (stretch.level == level) sum += stretch.end - stretch.begin;
  }
  return sum;
}

}  // namespace sweep_guard_session
