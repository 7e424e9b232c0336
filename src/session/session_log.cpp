#include "session/session_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_session {

using sweep_guard::Duration;
using sweep_guard::Level;
using sweep_guard::Time;

namespace {

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
  auto touch = touches_.begin();
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    if (stretches[i].level != Level::kContact) continue;
    Contact contact{stretches[i].begin, stretches[i].end, "", "", {}, std::numeric_limits<double>::quiet_NaN(), {}, {}};
    const Time before = contacts.empty() ? Time::min() : contacts.back().end;  // what came late belongs there
    for (; touch != touches_.end() && touch->heard <= contact.end; ++touch) {
      if (touch->first >= before) take(contact, *touch);
    }
    const auto lead = [&](Level least) { return std::max(contact.begin - onSince(stretches, i, least), Duration(0)); };
    contact.considered_lead = lead(Level::kConsidered);
    contact.reflex_lead = lead(Level::kReflex);
    contacts.push_back(contact);
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
