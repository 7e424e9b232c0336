#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "recording/level_trace.h"
#include "recording/swept_intervals.h"
#include "sweep_guard/ObjectContacts.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_simulation {

/// Time from a pose to the answer of the guard.
struct Latency {
  sweep_guard_core::Time stamp;      ///< of the pose
  sweep_guard_core::Duration delay;  ///< arrival of its Contacts minus its stamp
  std::size_t triangles;             ///< number in contact
};

/// Counts the inputs and outputs of the guard: which poses were swept, how fast, and which were left out. Matches poses
/// and swept intervals by their stamps; either may arrive first.
class DemoStatistics {
 public:
  /// @param sequence  header.seq, counted by the publisher
  void addPose(sweep_guard_core::Time stamp, std::uint32_t sequence);
  void addMeshUpdate(sweep_guard_core::Time stamp);
  /// Counts images of a depth camera; 0: they are expected.
  void addImages(std::size_t count) { images_ = images_.value_or(0) + count; }
  /// Records the effect of a tool on an elastic workpiece, for summary() and fault().
  /// @param dent   largest distance of a vertex from its place at rest [m]
  void addDent(double dent) { largest_dent_ = std::max(dent, largest_dent_.value_or(0.0)); }
  /// @param force  on the tool [N]
  void addForce(double force) { largest_force_ = std::max(force, largest_force_.value_or(0.0)); }
  /// @param start, stamp  of the swept interval
  /// @param objects       those that are not in contact do not count
  void addContacts(sweep_guard_core::Time start, sweep_guard_core::Time stamp, sweep_guard_core::Time arrival,
                   const std::vector<sweep_guard::ObjectContacts>& objects);
  /// @param arrival  not earlier than that of the previous warning
  void addWarning(sweep_guard_core::Time arrival, sweep_guard_core::WarningLevel level) { levels_.add(arrival, level); }

  /// Returns whether a pose in this interval is not swept yet.
  bool expects(sweep_guard_core::Time start, sweep_guard_core::Time stamp) const;

  std::size_t poses() const { return poses_; }
  std::size_t sweeps() const { return latencies_.size(); }              ///< Contacts messages
  std::size_t contacts() const { return contacts_; }                    ///< Contacts messages with a workpiece
  std::size_t trianglesInContact() const { return triangles_.size(); }  ///< each counts once
  std::size_t posesNotSwept() const { return not_swept_.size(); }       ///< until now
  std::size_t posesNeverReceived() const { return sequence_gap_; }      ///< gaps in header.seq
  std::size_t missedCycles() const;                                     ///< answers later than 1/15 s
  const std::vector<Latency>& latencies() const { return latencies_; }  ///< in order of arrival

  double meshRate() const;  ///< [Hz] by the stamps; NaN with less than two

  /// Returns a quantile of the delays [ms]; NaN without an answer.
  double latency(double fraction) const;

  /// Returns one line: 12.5 s  poses 1250  contacts 31  level CONTACT  latency p50 0.4 ms
  std::string liveLine(sweep_guard_core::Duration elapsed, const std::string& level) const;
  std::string summary() const;               ///< several lines, without a line feed at the end
  std::optional<std::string> fault() const;  ///< why the demo failed; empty if it worked

 private:
  std::size_t poses_ = 0;
  std::size_t mesh_updates_ = 0;
  std::optional<std::size_t> images_;
  sweep_guard_core::Time first_update_;
  sweep_guard_core::Time last_update_;
  std::optional<double> largest_dent_;   // [m]
  std::optional<double> largest_force_;  // [N]
  std::size_t contacts_ = 0;
  std::map<std::string, std::size_t> contacts_by_link_;
  std::size_t sequence_gap_ = 0;
  std::optional<std::uint32_t> last_sequence_;
  sweep_guard_recording::SweptIntervals swept_;
  std::multiset<sweep_guard_core::Time> not_swept_;
  std::vector<Latency> latencies_;
  std::set<std::pair<std::string, std::uint32_t>> triangles_;
  sweep_guard_recording::LevelTrace levels_;
};

}  // namespace sweep_guard_simulation
