#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// What a thread works on, from a message to a warning; kOther: anything else, which is not measured.
enum class Stage {
  kReceive,
  kSweep,
  kNarrowPhase,
  kPrediction,
  kProbability,
  kMonitor,
  kProximity,
  kInteraction,
  kPublish,
  kOther
};
constexpr std::array<const char*, 9> kStageNames = {"receive", "sweep",     "narrow phase", "prediction", "probability",
                                                    "monitor", "proximity", "interaction",  "publish"};
using StageTimes = std::array<Duration, kStageNames.size()>;  ///< in the order of Stage

/// Measures how long a thread works in each stage, by the steady clock: also while it waits for a processor. While one
/// stage is within another, only the inner one counts. One thread works, any thread reads.
class StageClock {
 public:
  /// Begins a piece of work of the calling thread, in this stage: its InStage count here until end(), but not in kOther,
  /// so that a service that sweeps does not count as the guard.
  void begin(Stage stage);
  void end();
  StageTimes read() const;  ///< since the construction, without the part of the stage that is not over yet

 private:
  friend class InStage;
  Stage change(Stage to);

  Stage stage_ = Stage::kOther;
  SteadyTime since_;
  std::array<std::atomic<std::int64_t>, kStageNames.size()> nanoseconds_{};
};

/// The calling thread is in a stage during the lifetime of this object, then in the one before. Takes some 50 ns. Does
/// nothing in a thread that has no clock.
class InStage {
 public:
  explicit InStage(Stage stage);
  InStage(const InStage&) = delete;
  InStage& operator=(const InStage&) = delete;
  ~InStage();

 private:
  StageClock* const clock_;
  Stage before_;
};

}  // namespace sweep_guard_core
