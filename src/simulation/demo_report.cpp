#include "simulation/demo_report.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace sweep_guard_simulation {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;

namespace {

constexpr Duration kCycle = std::chrono::nanoseconds(std::chrono::seconds(1)) / 15;

std::string milliseconds(const std::optional<Duration>& duration) {
  if (!duration) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << sweep_guard_core::toSeconds(*duration) * 1e3;
  return text.str();
}

// 4 of 4 contacts, 0.60 s (reflex 0.15 s) in the median
std::string warned(std::vector<WarningLeads::Contact> contacts) {
  std::ostringstream text;
  const auto in_time = [](const WarningLeads::Contact& contact) { return contact.considered > Duration(0); };
  text << std::count_if(contacts.begin(), contacts.end(), in_time) << " of " << contacts.size() << " contacts";
  if (contacts.empty()) return text.str();
  const auto median = [&](Duration WarningLeads::Contact::*lead) {
    const auto middle = contacts.begin() + static_cast<std::ptrdiff_t>(contacts.size() / 2);
    std::nth_element(contacts.begin(), middle, contacts.end(),
                     [lead](const auto& a, const auto& b) { return a.*lead < b.*lead; });
    return sweep_guard_core::toSeconds((*middle).*lead);
  };
  text << std::fixed << std::setprecision(2) << ", by " << median(&WarningLeads::Contact::considered) << " s (reflex "
       << median(&WarningLeads::Contact::reflex) << " s) in the median";
  return text.str();
}

}  // namespace

void DemoReport::addPose(Time stamp, std::uint32_t sequence) {
  ++poses_;
  if (last_sequence_ && sequence > *last_sequence_) sequence_gap_ += sequence - *last_sequence_ - 1;
  last_sequence_ = sequence;
  if (!swept_.cover(stamp)) not_swept_.insert(stamp);
}

void DemoReport::addContacts(Time start, Time stamp, Time arrival, const std::vector<TouchedObject>& objects) {
  std::size_t touched = 0;
  for (const TouchedObject& object : objects) {
    touched += object.triangles.size();
    for (const std::uint32_t triangle : object.triangles) triangles_.emplace(object.mesh_id, triangle);
  }
  if (!objects.empty()) ++contacts_;
  latencies_.push_back({stamp, arrival - stamp, touched});
  swept_.add(start, stamp);
  not_swept_.erase(stamp);
  not_swept_.erase(not_swept_.upper_bound(start), not_swept_.lower_bound(stamp));
}

bool DemoReport::awaits(Time start, Time stamp) const {
  const auto pose = not_swept_.upper_bound(start);
  return not_swept_.count(stamp) > 0 || (pose != not_swept_.end() && *pose < stamp);
}

std::size_t DemoReport::missedCycles() const {
  const auto missed = [](const Latency& latency) { return latency.delay > kCycle; };
  return static_cast<std::size_t>(std::count_if(latencies_.begin(), latencies_.end(), missed));
}

std::optional<Duration> DemoReport::latency(double fraction) const {
  assert(fraction >= 0.0 && fraction <= 1.0);
  if (latencies_.empty()) return std::nullopt;
  std::vector<Duration> delays;
  delays.reserve(latencies_.size());
  for (const Latency& latency : latencies_) delays.push_back(latency.delay);
  const double rank = std::ceil(fraction * static_cast<double>(delays.size()));
  const auto nth = delays.begin() + std::max(static_cast<std::ptrdiff_t>(rank) - 1, std::ptrdiff_t{0});
  std::nth_element(delays.begin(), nth, delays.end());
  return *nth;
}

std::string DemoReport::liveLine(Duration elapsed, const std::string& level) const {
  std::ostringstream line;
  line << std::fixed << std::setprecision(1) << sweep_guard_core::toSeconds(elapsed) << " s  poses " << poses_
       << "  contacts " << contacts_ << "  level " << level << "  latency p50 " << milliseconds(latency(0.5)) << " ms";
  return line.str();
}

std::string DemoReport::summary() const {
  std::ostringstream text;
  text << "poses in              " << poses_ << "\n"
       << "mesh updates          " << mesh_updates_ << "\n"
       << "sweeps tested         " << sweeps() << "\n"
       << "contacts              " << contacts_ << "\n"
       << "triangles touched     " << trianglesTouched() << "\n"
       << "pose to contact [ms]  p50 " << milliseconds(latency(0.5)) << "  p99 " << milliseconds(latency(0.99))
       << "  max " << milliseconds(latency(1.0)) << "\n"
       << "warned ahead of       " << warned(leads_.contacts()) << "\n"
       << "missed cycles         " << missedCycles() << "\n"
       << "poses lost            " << posesNotSwept() + posesNeverReceived();
  return text.str();
}

std::optional<std::string> DemoReport::fault() const {
  if (poses_ == 0) return "no tool pose arrived: the operator did not move";
  if (mesh_updates_ == 0) return "no mesh update arrived: the workpiece did not deform";
  if (posesNeverReceived() > 0)
    return std::to_string(posesNeverReceived()) + " poses were lost before the monitor got them";
  if (posesNotSwept() > 0) return std::to_string(posesNotSwept()) + " poses were not swept by the guard";
  return std::nullopt;
}

}  // namespace sweep_guard_simulation
