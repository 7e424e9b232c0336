#include "session/session_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "recording/level_trace.h"
#include "sound/earcon.h"

namespace sweep_guard_session {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;

namespace {

constexpr double kUnknownDepth = std::numeric_limits<double>::quiet_NaN();

void extend(Contact& contact, const SweepContact& sweep_contact) {
  if (contact.triangles.empty() && contact.mesh_id.empty()) {
    contact.begin = sweep_contact.first;
    contact.mesh_id = sweep_contact.mesh_id;
    contact.tool_link = sweep_contact.tool_link;
  }
  if (sweep_contact.mesh_id != contact.mesh_id) return;
  contact.triangles.insert(sweep_contact.triangles.begin(), sweep_contact.triangles.end());
  contact.depth = std::fmax(contact.depth, sweep_contact.depth);  // fmax() ignores NaN
}

// A sweep belongs to the contact in which its pose lies, or to the next one.
void assign(const std::vector<SweepContact>& sweep_contacts, std::vector<Contact>& contacts) {
  auto contact = contacts.begin();
  for (const SweepContact& sweep_contact : sweep_contacts) {
    while (contact != contacts.end() && sweep_contact.stamp > contact->end) ++contact;
    if (contact == contacts.end()) return;
    extend(*contact, sweep_contact);
  }
}

}  // namespace

void SessionLog::add(const LoggedWarning& warning) {
  warnings_.push_back(warning);
  end_ = warning.received;
}

void SessionLog::end(Time time) { end_ = std::max(end_, time); }

std::vector<Segment> SessionLog::segments() const {
  std::vector<Segment> segments;
  Duration longest{0};
  for (std::size_t i = 0; i < warnings_.size(); ++i) {
    const LoggedWarning& warning = warnings_[i];
    const Time until = i + 1 < warnings_.size() ? warnings_[i + 1].received : end_;
    const Duration lasted = until - warning.received;
    if (lasted == Duration(0)) continue;
    if (segments.empty() || segments.back().level != warning.level) {
      segments.push_back({warning.level, warning.received, until, warning.text});
      longest = lasted;
    }
    segments.back().end = until;
    if (lasted > longest) segments.back().text = warning.text;
    longest = std::max(longest, lasted);
  }
  return segments;
}

std::vector<Contact> SessionLog::contacts() const {
  sweep_guard_recording::LevelTrace trace;
  for (const Segment& segment : segments()) {
    trace.add(segment.begin, segment.level);
    trace.add(segment.end, segment.level);
  }
  const std::vector<sweep_guard_recording::WarnedContact> warned = trace.contacts();
  std::vector<Contact> contacts;
  contacts.reserve(warned.size());
  for (const auto& [contact, considered, reflex] : warned) {
    contacts.push_back({contact.begin, contact.end, "", "", {}, kUnknownDepth, {}, {}});
  }
  assign(sweep_contacts_, contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contacts[i].considered_lead = std::max(contacts[i].begin - warned[i].considered_since, Duration(0));
    contacts[i].reflex_lead = std::max(contacts[i].begin - warned[i].reflex_since, Duration(0));
  }
  return contacts;
}

Duration SessionLog::duration(sweep_guard_core::WarningLevel level) const {
  Duration sum{0};
  for (const Segment& segment : segments()) {
    if (segment.level == level) sum += segment.end - segment.begin;
  }
  return sum;
}

std::vector<std::int16_t> soundOf(const SessionLog& log, double rate) {
  std::vector<std::int16_t> samples;
  if (log.warnings().empty()) return samples;
  sweep_guard_core::Synthesizer synthesizer(rate);
  const sweep_guard_core::Time begin = log.warnings().front().received;
  for (size_t i = 0; i < log.warnings().size(); ++i) {
    const LoggedWarning& warning = log.warnings()[i];
    const bool last = i + 1 == log.warnings().size();
    const sweep_guard_core::Time end =
        last ? std::max(log.endTime(), warning.received) : log.warnings()[i + 1].received;
    const auto until = static_cast<size_t>(sweep_guard_core::toSeconds(end - begin) * rate);
    sweep_guard_core::MergedWarning said;
    said.level = warning.level;
    said.time_to_collision = warning.time_to_collision;
    synthesizer.render(earconOf(said, /*clear_tick=*/true), until - std::min(until, samples.size()), samples);
  }
  return samples;
}

}  // namespace sweep_guard_session
