#pragma once

#include <optional>

#include "sweep_guard/common/time.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_core {

/// Why a recording is written, the least important first.
enum class RecordingCause { kSave, kReflex, kContact };

/// Returns the cause as a word in lower case.
const char* nameOf(RecordingCause cause);

/// Decides when a recording is written: some time after an event, so that what followed is in it. An event is that the level
/// of the warning becomes CONTACT, that it becomes REFLEX, or a request. Events that come while one waits share its
/// recording; a more important one gives it its name and its time. Not thread-safe.
///
/// The time after an event is over when it is over on one of both clocks: a simulation may run faster than the steady clock,
/// or stand still.
class RecordingTrigger {
 public:
  struct Options {
    Duration after = std::chrono::seconds(5);  ///< from the event to its recording, at least 0
    bool on_contact = true;
    bool on_reflex = false;
  };

  struct Event {
    RecordingCause cause;
    Instant begin;  ///< without a stamp, the steady clock alone counts
  };

  explicit RecordingTrigger(const Options& options) : options_(options) {}

  void warned(WarningLevel level, const Instant& now);
  void requested(const Instant& now) { happened(RecordingCause::kSave, now); }

  const std::optional<Event>& waiting() const { return waiting_; }
  bool due(const Instant& now) const;
  /// Takes the event that waits; empty if there is none.
  std::optional<Event> take();

 private:
  void happened(RecordingCause cause, const Instant& now);

  const Options options_;
  WarningLevel newest_ = WarningLevel::kUnknown;
  std::optional<Event> waiting_;
};

}  // namespace sweep_guard_core
