#include "ros/threads/supervisor.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <condition_variable>
#include <csignal>
#include <future>
#include <mutex>
#include <string>
#include <vector>

#include "refusal.h"
#include "ros/threads/queue_thread.h"

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

// A thread named `busy` that does what it is given.
class SupervisedThread {
 public:
  explicit SupervisedThread(Process process, const ThreadTraits& traits = {"busy"})
      : supervisor_(process, [this](const char* what, const ThreadTraits&) { keep(what); }) {
    thread_.start(supervisor_, traits);
    supervisor_.start();
  }

  void work(std::function<void()> function) { thread_.post(std::move(function)); }
  void finish() {
    std::promise<void> done;
    work([&] { done.set_value(); });
    done.get_future().wait();
  }
  const Supervisor& supervisor() const { return supervisor_; }
  std::vector<std::string> failures() const {
    const std::lock_guard lock(mutex_);
    return failures_;
  }

 private:
  void keep(const char* what) {
    const std::lock_guard lock(mutex_);
    failures_.emplace_back(what);
  }

  mutable std::mutex mutex_;
  std::vector<std::string> failures_;
  Supervisor supervisor_;
  QueueThread thread_;
};

// It waits until it is released.
struct BlockedThread : SupervisedThread {
  BlockedThread() : SupervisedThread(Process::kShared) {
    work([this] { go_on.get_future().wait(); });
  }
  std::promise<void> go_on;
};

// @returns whether the thread comes to hang, or ceases to, within this time
bool comesToHang(const SupervisedThread& thread, bool hangs, std::chrono::milliseconds limit) {
  const auto end = SteadyClock::now() + limit;
  while ((thread.supervisor().hung() != nullptr) != hangs) {
    if (SteadyClock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

void burn(const std::atomic<bool>& go_on) {
  while (go_on) continue;
}

TEST(SupervisorTest, AThreadGoesOnAfterAnExceptionOfAnyType) {
  SupervisedThread thread(Process::kOwn);
  thread.work([] { throw std::runtime_error("a fault"); });
  thread.work([] { throw 1; });
  thread.finish();
  const auto failures = thread.failures();
  ASSERT_EQ(failures.size(), 2U);
  EXPECT_EQ(failures[0], "thread 'busy' failed: a fault");
  EXPECT_EQ(failures[1], "thread 'busy' failed: unknown exception");
}

TEST(SupervisorTest, AThreadOfASharedProcessGoesOnAfterAnyNumberOfExceptions) {
  SupervisedThread thread(Process::kShared);
  for (int i = 0; i < 10; ++i) thread.work([] { throw std::bad_alloc(); });
  thread.finish();
  EXPECT_EQ(thread.failures().size(), 10U);
}

TEST(SupervisorDeathTest, TheThirdExceptionEndsTheGuardsOwnProcess) {
  const auto fail = [] {
    SupervisedThread thread(Process::kOwn);
    for (int i = 0; i < 3; ++i) thread.work([] { throw std::bad_alloc(); });
    thread.finish();
  };
  EXPECT_EXIT(fail(), testing::ExitedWithCode(kFailedStatus), "thread 'busy' is the third to fail within 10 s");
}

TEST(SupervisorTest, ABlockedThreadHangsUntilItGoesOn) {
  BlockedThread thread;
  EXPECT_FALSE(comesToHang(thread, true, 100ms));
  ASSERT_TRUE(comesToHang(thread, true, 5s));
  EXPECT_STREQ(thread.supervisor().hung(), "busy");
  thread.go_on.set_value();
  EXPECT_TRUE(comesToHang(thread, false, 5s));
}

TEST(SupervisorTest, AThreadThatTurnsInCirclesHangs) {
  SupervisedThread thread(Process::kShared);
  std::atomic<bool> go_on = true;
  thread.work([&] { burn(go_on); });
  EXPECT_TRUE(comesToHang(thread, true, 10s));
  go_on = false;
  EXPECT_TRUE(comesToHang(thread, false, 5s));
}

TEST(SupervisorTest, AThreadThatMakesProgressOrHasNoWorkDoesNotHang) {
  SupervisedThread thread(Process::kShared);
  EXPECT_FALSE(comesToHang(thread, true, 300ms));
  thread.work([] {
    for (const auto end = SteadyClock::now() + 500ms; SteadyClock::now() < end;) {
      std::this_thread::sleep_for(1ms);
      sweep_guard_core::beat();
    }
  });
  EXPECT_FALSE(comesToHang(thread, true, 400ms));
  thread.finish();
}

TEST(SupervisorTest, AThreadThatIsNotWatchedDoesNotHang) {
  SupervisedThread thread(Process::kOwn, {"service", sweep_guard_core::Stage::kOther, /*watched=*/false});
  thread.work([] { std::this_thread::sleep_for(500ms); });
  EXPECT_FALSE(comesToHang(thread, true, 400ms));
  thread.finish();
}

TEST(SupervisorDeathTest, AHungThreadAbortsTheGuardsOwnProcessAfterTwoSeconds) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const auto hang = [] {
    SupervisedThread thread(Process::kOwn);
    thread.work([] { std::this_thread::sleep_for(10s); });
    std::this_thread::sleep_for(1900ms);
    std::fputs("alive; ", stderr);
    thread.finish();
  };
  EXPECT_EXIT(hang(), testing::KilledBySignal(SIGABRT), "alive; .*thread 'busy' makes no progress");
#endif
}

TEST(SupervisorTest, AHungThreadEndsNoSharedProcess) {
  BlockedThread thread;
  ASSERT_TRUE(comesToHang(thread, true, 5s));
  EXPECT_FALSE(comesToHang(thread, false, 2500ms));
  thread.go_on.set_value();
  thread.finish();
}

}  // namespace
}  // namespace sweep_guard_ros
