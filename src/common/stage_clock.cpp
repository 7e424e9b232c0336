#include "common/stage_clock.h"

#include <algorithm>
#include <utility>

namespace sweep_guard_core {
namespace {

thread_local StageClock* clock_of_thread = nullptr;

}  // namespace

void StageClock::begin(Stage stage) {
  clock_of_thread = stage == Stage::kOther ? nullptr : this;
  stage_ = stage;
  since_ = std::chrono::steady_clock::now();
}

void StageClock::end() {
  change(Stage::kOther);
  clock_of_thread = nullptr;
}

StageTimes StageClock::read() const {
  StageTimes times;
  std::transform(nanoseconds_.begin(), nanoseconds_.end(), times.begin(),
                 [](const auto& time) { return Duration(time.load(std::memory_order_relaxed)); });
  return times;
}

// No other thread writes.
Stage StageClock::change(Stage to) {
  const SteadyTime now = std::chrono::steady_clock::now();
  if (stage_ != Stage::kOther) {
    std::atomic<std::int64_t>& time = nanoseconds_[static_cast<size_t>(stage_)];
    time.store(time.load(std::memory_order_relaxed) + Duration(now - since_).count(), std::memory_order_relaxed);
  }
  since_ = now;
  return std::exchange(stage_, to);
}

InStage::InStage(Stage stage) : clock_(clock_of_thread), before_(stage) {
  if (clock_ != nullptr) before_ = clock_->change(stage);
}

InStage::~InStage() {
  if (clock_ != nullptr) clock_->change(before_);
}

}  // namespace sweep_guard_core
