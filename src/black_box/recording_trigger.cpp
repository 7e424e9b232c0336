#include "black_box/recording_trigger.h"

#include <array>
#include <utility>

namespace sweep_guard_core {

const char* nameOf(RecordingCause cause) {
  constexpr std::array kNames = {"save", "reflex", "contact"};
  return kNames[static_cast<std::size_t>(cause)];
}

void RecordingTrigger::warned(WarningLevel level, const Instant& now) {
  const WarningLevel before = std::exchange(newest_, level);
  if (level <= before) return;
  if (level == WarningLevel::kContact && options_.on_contact) happened(RecordingCause::kContact, now);
  if (level == WarningLevel::kReflex && options_.on_reflex) happened(RecordingCause::kReflex, now);
}

bool RecordingTrigger::due(const Instant& now) const {
  if (!waiting_) return false;
  const Instant& begin = waiting_->begin;
  const bool stamped = begin.stamp != Time();
  return now.steady - begin.steady >= options_.after || (stamped && now.stamp - begin.stamp >= options_.after);
}

std::optional<RecordingTrigger::Event> RecordingTrigger::take() { return std::exchange(waiting_, std::nullopt); }

void RecordingTrigger::happened(RecordingCause cause, const Instant& now) {
  if (!waiting_ || cause > waiting_->cause) waiting_ = Event{cause, now};
}

}  // namespace sweep_guard_core
