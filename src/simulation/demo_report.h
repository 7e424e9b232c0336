#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "recording/swept_intervals.h"
#include "simulation/warning_leads.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_simulation {

/// A workpiece that was touched.
struct TouchedObject {
  std::string mesh_id;
  std::vector<std::uint32_t> triangles;  ///< none: the tool is inside of it
};

/// Time between a pose and the answer to it.
struct Latency {
  sweep_guard_core::Time stamp;      ///< of the pose
  sweep_guard_core::Duration delay;  ///< arrival of its Contacts minus its stamp
  std::size_t triangles;             ///< touched
};

/// Counts what went into the guard and what came out: which poses were swept or swept through, how fast, and which were
/// left out. Poses and the intervals swept are matched by their stamps; either may come first.
class DemoReport {
 public:
  /// @param sequence  header.seq, counted by the publisher
  void addPose(sweep_guard_core::Time stamp, std::uint32_t sequence);
  void addMeshUpdate() { ++mesh_updates_; }
  /// @param start, stamp  of the interval swept
  void addContacts(sweep_guard_core::Time start, sweep_guard_core::Time stamp, sweep_guard_core::Time arrival,
                   const std::vector<TouchedObject>& objects);

  /// @param arrival  not before that of the warning before
  void addWarning(sweep_guard_core::Time arrival, sweep_guard_core::WarningLevel level) { leads_.add(arrival, level); }

  bool awaits(sweep_guard_core::Time start,
              sweep_guard_core::Time stamp) const;  ///< an interval with a pose not swept so far
  std::size_t poses() const { return poses_; }
  std::size_t meshUpdates() const { return mesh_updates_; }
  std::size_t sweeps() const { return latencies_.size(); }              ///< Contacts messages
  std::size_t contacts() const { return contacts_; }                    ///< those with a workpiece touched
  std::size_t trianglesTouched() const { return triangles_.size(); }    ///< distinct ones
  std::size_t posesNotSwept() const { return not_swept_.size(); }       ///< so far
  std::size_t posesNeverReceived() const { return sequence_gap_; }      ///< missing in header.seq
  std::size_t missedCycles() const;                                     ///< answers later than 1/15 s
  const std::vector<Latency>& latencies() const { return latencies_; }  ///< in order of arrival

  /// The delay that `fraction` in [0, 1] of the answers did not exceed (nearest rank): 0.5 the median, 1 the largest.
  /// Empty without an answer.
  std::optional<sweep_guard_core::Duration> latency(double fraction) const;

  /// One line: 12.5 s  poses 1250  contacts 31  level CONTACT  latency p50 0.4 ms
  std::string liveLine(sweep_guard_core::Duration elapsed, const std::string& level) const;
  std::string summary() const;               ///< several lines, the last without a line feed
  std::optional<std::string> fault() const;  ///< why the demo did not do what it should; empty if it did

 private:
  std::size_t poses_ = 0;
  std::size_t mesh_updates_ = 0;
  std::size_t contacts_ = 0;
  std::size_t sequence_gap_ = 0;
  std::optional<std::uint32_t> last_sequence_;
  sweep_guard_recording::SweptIntervals swept_;
  std::multiset<sweep_guard_core::Time> not_swept_;
  std::vector<Latency> latencies_;
  std::set<std::pair<std::string, std::uint32_t>> triangles_;
  WarningLeads leads_;
};

}  // namespace sweep_guard_simulation
