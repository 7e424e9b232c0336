#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "recording/swept_intervals.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_session {

/// What a warning told.
struct Told {
  sweep_guard_core::Time at;  ///< when it was heard, on the session's clock; not before that of the warning before
  sweep_guard_core::WarningLevel level = sweep_guard_core::WarningLevel::kUnknown;
  std::string text;                                               ///< level and reasons in words
  std::optional<sweep_guard_core::Duration> time_to_collision{};  ///< empty: none, or not known
};

/// A segment of the session through which the level stayed the same.
struct Segment {
  sweep_guard_core::WarningLevel level;
  sweep_guard_core::Time begin;
  sweep_guard_core::Time end;
  std::string text;  ///< of the warning that lasted longest in it
};

/// What one sweep met of one workpiece.
struct Touch {
  sweep_guard_core::Time heard;  ///< on the session's clock
  /// Moment of the first touch between the two poses, or the first pose's where that is unknown.
  sweep_guard_core::Time first;
  sweep_guard_core::Time stamp;  ///< of the pose that was swept to
  std::string mesh_id;
  std::string tool_link;  ///< that touched first; empty: not known
  std::vector<std::uint32_t> triangles;
  double depth = std::numeric_limits<double>::quiet_NaN();  ///< [m], NaN: not known
};

/// A contact as the operator saw it: one segment of level CONTACT. The guard holds a contact for a while, so that a
/// tool that bounces is one.
struct Contact {
  sweep_guard_core::Time begin;  ///< first touch
  sweep_guard_core::Time end;    ///< of the level
  std::string mesh_id;           ///< that was touched first, as the tool's link
  std::string tool_link;
  std::set<std::uint32_t> triangles;  ///< of that workpiece
  double depth;                       ///< greatest [m], NaN: not known
  /// How long before the first touch that level or a higher one came on and stayed; 0: not before it.
  sweep_guard_core::Duration considered_lead;
  sweep_guard_core::Duration reflex_lead;
};

/// What a guard told of a session, in the order in which it was heard.
class SessionLog {
 public:
  void add(const Told& told);
  void add(Touch touch) { touches_.push_back(std::move(touch)); }
  void addSweep(sweep_guard_core::Time start, sweep_guard_core::Time stamp) { swept_.add(start, stamp); }
  void end(sweep_guard_core::Time at);  ///< what was told last holds until then

  const std::vector<Told>& told() const { return told_; }
  std::vector<Segment> segments() const;  ///< one after the other, none without duration
  std::vector<Contact> contacts() const;
  sweep_guard_core::Duration duration(sweep_guard_core::WarningLevel level) const;  ///< of all segments of that level
  const sweep_guard_recording::SweptIntervals& swept() const { return swept_; }

 private:
  std::vector<Told> told_;
  std::vector<Touch> touches_;
  sweep_guard_core::Time end_;
  sweep_guard_recording::SweptIntervals swept_;
};

}  // namespace sweep_guard_session
