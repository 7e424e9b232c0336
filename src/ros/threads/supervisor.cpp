#include "ros/threads/supervisor.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::SteadyTime;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSlower = 20;  // what a sanitizer makes of the same work
#else
constexpr int kSlower = 1;
#endif
constexpr Duration kPeriod = std::chrono::milliseconds(10);
constexpr Duration kHung = kSlower * std::chrono::milliseconds(140);  // told one period and one publication later
constexpr Duration kDead = kSlower * std::chrono::seconds(2);
constexpr Duration kRepeated = std::chrono::seconds(10);

// The log may allocate or lock.
void say(const char* thread, const char* what) noexcept {
  char line[300];
  const int length = std::snprintf(line, sizeof line, "sweep_guard: thread '%s' %s\n", thread, what);
  const ssize_t written = write(STDERR_FILENO, line, std::min<size_t>(static_cast<size_t>(length), sizeof line - 1));
  static_cast<void>(written);
}

}  // namespace

Supervisor::Supervisor(Process process, Failed failed) : process_(process), failed_(std::move(failed)) {}

Supervisor::~Supervisor() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

ThreadTop& Supervisor::add(const ThreadTraits& thread) { return threads_.emplace_back(*this, thread).top; }

void Supervisor::start() {
  started_ = true;
  thread_ = std::thread([this] { watch(); });
}

sweep_guard_core::StageTimes Supervisor::stageTimes() const {
  sweep_guard_core::StageTimes all{};
  if (!started_) return all;  // threads are still added
  for (const Watched& watched : threads_) {
    const sweep_guard_core::StageTimes times = watched.top.stageTimes();
    std::transform(all.begin(), all.end(), times.begin(), all.begin(), std::plus<>());
  }
  return all;
}

// Needs no memory from the heap until all is reported that counts.
void Supervisor::failed(const ThreadTraits& thread, const char* what) noexcept {
  char text[160];
  std::snprintf(text, sizeof text, "thread '%s' failed: %s", thread.name, what);
  try {
    failed_(text, thread);
    log_.error(thread.name, text);
  } catch (...) {  // no memory for it: the next one reports
  }
  if (!repeated() || process_ != Process::kOwn) return;
  say(thread.name, "is the third to fail within 10 s: the guard ends");
  std::_Exit(kFailedStatus);
}

bool Supervisor::repeated() noexcept {
  const sweep_guard_core::Lock lock(failures_mutex_);
  const SteadyTime now = std::chrono::steady_clock::now();
  const bool third = failures_[1] != SteadyTime() && now - failures_[1] <= kRepeated;
  failures_ = {now, failures_[0]};
  return third;
}

void Supervisor::watch() {
  pthread_setname_np(pthread_self(), "supervisor");
  SteadyTime last = std::chrono::steady_clock::now();
  while (!stopping_) {
    std::this_thread::sleep_for(kPeriod);
    const SteadyTime now = std::chrono::steady_clock::now();
    check(now - std::exchange(last, now));
  }
}

// A blocked thread may wait for one that runs, or for one that hangs longer.
bool Supervisor::blames(const Watched& one, const Watched& other) {
  const auto runs = [](const Watched& thread) { return thread.state.activity == ThreadState::Activity::kRunnable; };
  if (runs(one) != runs(other)) return runs(one);
  return one.stall.stalled() > other.stall.stalled();
}

void Supervisor::check(Duration since_last) {
  bool starving = false;
  for (Watched& one : threads_) {
    one.steps = one.top.steps();
    if (one.steps) one.state = one.top.thread()->state();
    starving = (one.stall.starves(one.steps, one.state) && one.top.traits().watched) || starving;
  }
  const Watched* hung = nullptr;
  bool dead = false;
  for (Watched& one : threads_) {
    one.stall.check(one.steps, one.state, since_last, starving);
    const Duration stalled = one.stall.stalled() - one.top.allowance();
    if (!one.top.traits().watched || stalled < kHung) continue;
    if (hung == nullptr || blames(one, *hung)) hung = &one;
    dead = dead || stalled >= kDead;
  }
  hung_ = hung == nullptr ? nullptr : hung->top.traits().name;
  if (!dead || process_ != Process::kOwn) return;
  say(hung_, "makes no progress: the guard aborts");
  std::abort();
}

}  // namespace sweep_guard_ros
