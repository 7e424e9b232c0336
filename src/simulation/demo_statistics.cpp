#include "simulation/demo_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "recording/object_contacts.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_simulation {

using sweep_guard_core::Duration;
using sweep_guard_core::quantile;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;

namespace {

constexpr Duration kCycle = std::chrono::nanoseconds(std::chrono::seconds(1)) / 15;

std::string oneDecimal(double value) { return std::isnan(value) ? "-" : fmt::format("{:.1f}", value); }

// 4 of 4 contacts, by 0.60 s (reflex 0.15 s) in the median
std::string warned(const std::vector<sweep_guard_recording::WarnedContact>& contacts) {
  std::vector<double> considered;
  std::vector<double> reflex;
  for (const auto& [contact, considered_since, reflex_since] : contacts) {
    considered.push_back(toSeconds(contact.begin - considered_since));
    reflex.push_back(toSeconds(contact.begin - reflex_since));
  }
  const auto ahead = std::count_if(considered.begin(), considered.end(), [](double lead) { return lead > 0.0; });
  std::string text = fmt::format("{} of {} contacts", ahead, contacts.size());
  if (contacts.empty()) return text;
  return text +
         fmt::format(", by {:.2f} s (reflex {:.2f} s) in the median", quantile(considered, 0.5), quantile(reflex, 0.5));
}

std::string byLink(const std::map<std::string, std::size_t>& contacts) {
  std::string lines;
  for (const auto& [link, count] : contacts) lines += fmt::format("  of {:<17} {}\n", link, count);
  return lines;
}

}  // namespace

void DemoStatistics::addPose(Time stamp, std::uint32_t sequence) {
  ++poses_;
  if (last_sequence_ && sequence > *last_sequence_) sequence_gap_ += sequence - *last_sequence_ - 1;
  last_sequence_ = sequence;
  if (!swept_.covers(stamp)) not_swept_.insert(stamp);
}

void DemoStatistics::addMeshUpdate(Time stamp) {
  if (mesh_updates_ == 0) first_update_ = stamp;
  last_update_ = stamp;
  ++mesh_updates_;
}

double DemoStatistics::meshRate() const {
  if (mesh_updates_ < 2) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(mesh_updates_ - 1) / toSeconds(last_update_ - first_update_);
}

void DemoStatistics::addContacts(Time start, Time stamp, Time arrival,
                                 const std::vector<sweep_guard::ObjectContacts>& objects) {
  bool any = false;
  std::size_t triangles = 0;
  std::set<std::string> links;
  for (const sweep_guard::ObjectContacts& object : objects) {
    if (!sweep_guard_recording::isInContact(object)) continue;
    any = true;
    links.merge(sweep_guard_recording::linksInContact(object));
    const std::vector<std::uint32_t> met = sweep_guard_recording::trianglesInContact(object);
    triangles += met.size();
    for (const std::uint32_t triangle : met) triangles_.emplace(object.mesh_id, triangle);
  }
  if (any) ++contacts_;
  for (const std::string& link : links) ++contacts_by_link_[link];
  latencies_.push_back({stamp, arrival - stamp, triangles});
  swept_.add(start, stamp);
  not_swept_.erase(stamp);
  not_swept_.erase(not_swept_.upper_bound(start), not_swept_.lower_bound(stamp));
}

bool DemoStatistics::expects(Time start, Time stamp) const {
  const auto pose = not_swept_.upper_bound(start);
  return not_swept_.count(stamp) > 0 || (pose != not_swept_.end() && *pose < stamp);
}

std::size_t DemoStatistics::missedCycles() const {
  const auto missed = [](const Latency& latency) { return latency.delay > kCycle; };
  return static_cast<std::size_t>(std::count_if(latencies_.begin(), latencies_.end(), missed));
}

double DemoStatistics::latency(double fraction) const {
  std::vector<double> delays;
  delays.reserve(latencies_.size());
  for (const Latency& latency : latencies_) delays.push_back(1e3 * toSeconds(latency.delay));
  return quantile(delays, fraction);
}

std::string DemoStatistics::liveLine(Duration elapsed, const std::string& level) const {
  return fmt::format("{:.1f} s  poses {}  contacts {}  level {}  latency p50 {} ms", toSeconds(elapsed), poses_,
                     contacts_, level, oneDecimal(latency(0.5)));
}

std::string DemoStatistics::summary() const {
  std::string elastic;
  if (largest_dent_) {
    elastic = fmt::format(
        "mesh updates [Hz]     {}\n"
        "largest dent [mm]     {:.1f}\n"
        "largest force [N]     {:.2f}\n",
        oneDecimal(meshRate()), 1e3 * *largest_dent_, largest_force_.value_or(0.0));
  }
  return fmt::format(
      "poses in              {}\n"
      "{}{}\n"
      "sweeps tested         {}\n"
      "contacts              {}\n"
      "{}"
      "triangles touched     {}\n"
      "{}"
      "pose to contact [ms]  p50 {}  p99 {}  max {}\n"
      "warned ahead of       {}\n"
      "missed cycles         {}\n"
      "poses lost            {}",
      poses_, images_ ? "depth images          " : "mesh updates          ", images_.value_or(mesh_updates_), sweeps(),
      contacts_, byLink(contacts_by_link_), trianglesInContact(), elastic, oneDecimal(latency(0.5)),
      oneDecimal(latency(0.99)), oneDecimal(latency(1.0)), warned(levels_.contacts()), missedCycles(),
      posesNotSwept() + posesNeverReceived());
}

std::optional<std::string> DemoStatistics::fault() const {
  if (poses_ == 0) return "no tool pose arrived: the operator did not move";
  if (images_ && *images_ == 0) return "no depth image arrived: see the log of the camera";
  if (!images_ && mesh_updates_ == 0) return "no mesh update arrived: the workpiece did not deform";
  if (posesNeverReceived() > 0) return fmt::format("{} poses were lost before the monitor", posesNeverReceived());
  if (posesNotSwept() > 0) return fmt::format("{} poses were not swept by the guard", posesNotSwept());
  if (largest_dent_ && contacts_ > 0 && !(*largest_dent_ > 0.0)) return "the workpiece did not give way to the tool";
  if (largest_dent_ && contacts_ > 0 && !(largest_force_ > 0.0)) return "the guard measured no force";
  return std::nullopt;
}

}  // namespace sweep_guard_simulation
