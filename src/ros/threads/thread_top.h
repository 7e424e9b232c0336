#pragma once

#include <atomic>
#include <exception>
#include <optional>

#include "common/heartbeat.h"
#include "common/stage_clock.h"
#include "ros/threads/kernel_thread.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

class Supervisor;

struct ThreadTraits {
  const char* name;                                                 ///< at most 15 bytes; lives as long as the process
  sweep_guard_core::Stage stage = sweep_guard_core::Stage::kOther;  ///< in which its pieces of work begin
  bool watched = true;         ///< counts as hung if it makes no progress; false: its work may take any time
  bool loses_latched = false;  ///< work that fails may be a latched message, which is not sent again
};

/// Thrown instead of a std::exception where roscpp would catch that and only log it.
struct PassesRoscpp {
  const char* what;  ///< lives as long as the process
};

/// The top of one thread: runs its pieces of work, and catches what they throw.
class ThreadTop {
 public:
  ThreadTop(Supervisor& supervisor, const ThreadTraits& traits) : supervisor_(supervisor), traits_(traits) {}

  void enter();  ///< called by the thread first: names it

  /// A piece of work of this thread, while it lives. What the work throws is for caught().
  class Piece {
   public:
    /// @param allowance  time that the work may take beyond the usual limit before it counts as hung
    explicit Piece(ThreadTop& top, sweep_guard_core::Duration allowance = {}) : top_(top) {
      top.allowance_ = allowance;
      top.heartbeat_.begin();
      top.stage_clock_.begin(top.traits_.stage);
    }
    ~Piece() {
      top_.stage_clock_.end();
      top_.heartbeat_.end();
    }
    Piece(const Piece&) = delete;
    Piece& operator=(const Piece&) = delete;

   private:
    ThreadTop& top_;
  };

  /// Runs a piece of work. The supervisor hears of exceptions.
  template <typename Work>
  void run(const Work& work, sweep_guard_core::Duration allowance = {}) noexcept {
    const Piece piece(*this, allowance);
    attempt(work);
  }

  /// Runs a part of a piece of work that must not end the rest.
  template <typename Work>
  void attempt(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      caught();
    }
  }

  /// Tells the supervisor of the exception that is being handled.
  void caught() noexcept;

  const ThreadTraits& traits() const { return traits_; }
  std::optional<std::uint64_t> steps() const { return heartbeat_.steps(); }  ///< as Heartbeat::steps()
  sweep_guard_core::StageTimes stageTimes() const { return stage_clock_.read(); }
  sweep_guard_core::Duration allowance() const { return allowance_; }
  const std::optional<KernelThread>& thread() const { return thread_; }  ///< after the first step

 private:
  void failed(const char* what) noexcept;

  Supervisor& supervisor_;
  const ThreadTraits traits_;
  sweep_guard_core::Heartbeat heartbeat_;
  sweep_guard_core::StageClock stage_clock_;
  std::atomic<sweep_guard_core::Duration> allowance_{};
  std::optional<KernelThread> thread_;
};

}  // namespace sweep_guard_ros
