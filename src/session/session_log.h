#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "recording/swept_intervals.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_session {

/// A warning and the time from which on it counts.
struct LoggedWarning {
  sweep_guard_core::Time received;  ///< on the session's clock; not earlier than that of the previous warning
  sweep_guard_core::WarningLevel level = sweep_guard_core::WarningLevel::kUnknown;
  std::string text;                                               ///< level and reasons in words
  std::optional<sweep_guard_core::Duration> time_to_collision{};  ///< empty: no collision predicted, or not known
};

/// An interval of the session in which the level did not change.
struct Segment {
  sweep_guard_core::WarningLevel level;
  sweep_guard_core::Time begin;
  sweep_guard_core::Time end;
  std::string text;  ///< text that lasted longest in the interval
};

/// The contact of one sweep with one workpiece.
struct SweepContact {
  sweep_guard_core::Time first;  ///< first contact between the two poses, or the stamp of the first pose if not known
  sweep_guard_core::Time stamp;  ///< of the second pose
  std::string mesh_id;
  std::string tool_link;  ///< link that touched first; empty: not known
  std::vector<std::uint32_t> triangles;
  double depth = std::numeric_limits<double>::quiet_NaN();  ///< [m], NaN: not known
};

/// A contact as the operator saw it: one segment of level CONTACT. The guard holds the level for a while, so a tool
/// that bounces makes one contact.
struct Contact {
  sweep_guard_core::Time begin;                ///< first contact of a sweep
  sweep_guard_core::Time end;                  ///< end of the segment
  std::string mesh_id;                         ///< workpiece of the first contact
  std::string tool_link;                       ///< link of the first contact
  std::set<std::uint32_t> triangles;           ///< of this workpiece
  double depth;                                ///< largest depth [m], NaN: not known
  sweep_guard_core::Duration considered_lead;  ///< from the begin of the warning to the first contact; 0: no warning
  sweep_guard_core::Duration reflex_lead;      ///< the same for REFLEX and CONTACT
};

/// Collects the warnings and sweeps of a guard during a session, each in order.
class SessionLog {
 public:
  void add(const LoggedWarning& warning);
  void add(SweepContact contact) { sweep_contacts_.push_back(std::move(contact)); }
  void addSweep(sweep_guard_core::Time start, sweep_guard_core::Time stamp) { swept_.add(start, stamp); }
  void end(sweep_guard_core::Time time);  ///< ends the last warning

  const std::vector<LoggedWarning>& warnings() const { return warnings_; }
  sweep_guard_core::Time endTime() const { return end_; }
  std::vector<Segment> segments() const;  ///< without gaps; none is empty
  std::vector<Contact> contacts() const;
  sweep_guard_core::Duration duration(sweep_guard_core::WarningLevel level) const;  ///< of all segments of a level
  const sweep_guard_recording::SweptIntervals& swept() const { return swept_; }

 private:
  std::vector<LoggedWarning> warnings_;
  std::vector<SweepContact> sweep_contacts_;
  sweep_guard_core::Time end_;
  sweep_guard_recording::SweptIntervals swept_;
};

/// Returns what an operator would have heard from the first warning to the end of the session: signed 16 bits, one channel.
/// @param rate  samples per second, > 0
std::vector<std::int16_t> soundOf(const SessionLog& log, double rate);

}  // namespace sweep_guard_session
