// Threads of a guard that fail or hang, in its own process and in that of a nodelet manager. The test is the clock.
#include <fcntl.h>
#include <ros/service.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <thread>

#include "faults.h"
#include "guard_process.h"
#include "node_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;
using sweep_guard::Warning;
using Clock = std::chrono::steady_clock;

constexpr auto kReported = 150ms;
constexpr auto kAborted = 10s;  // 2 s of processor time, on a busy machine too

// Faults in the threads of a process.
class FaultyProcess {
 public:
  explicit FaultyProcess(pid_t pid) : pid_(pid) {
    std::snprintf(name_, sizeof name_, kFaultsName, pid);
    const int file = shm_open(name_, O_RDWR, 0600);
    if (file < 0) throw std::runtime_error("the process has not loaded the library of the faults");
    faults_ = static_cast<Faults*>(mmap(nullptr, sizeof(Faults), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    close(file);
  }
  ~FaultyProcess() {
    end();
    munmap(faults_, sizeof(Faults));
    if (!alive()) shm_unlink(name_);  // a process that is killed or aborts leaves it
  }

  void inject(Fault fault, const char* thread) {
    std::strncpy(faults_->thread, thread, sizeof faults_->thread - 1);
    faults_->struck = 0;
    faults_->fault = fault;
  }
  void end() { faults_->fault = Fault::kNone; }
  bool struck() const { return faults_->struck != 0; }
  Clock::time_point struckAt() const { return Clock::time_point(Clock::duration(faults_->struck.load())); }

  void signal(int number) const { ASSERT_EQ(kill(pid_, number), 0); }
  bool alive() const { return kill(pid_, 0) == 0; }

 private:
  const pid_t pid_;
  char name_[64];
  Faults* faults_;
};

// Good inputs, which never cease.
class ThreadsTest : public NodeTest {
 protected:
  ThreadsTest() { probe(); }  // returns when the guard is connected

  static void sendInputs() {
    probe().tick(0.01);
    publishInputs();
  }
  // Waits for no warning.
  static void publishInputs() {
    probe().publish(poseAt(kAway, probe().time()));
    probe().publish(squareMovedTo("square", kSquare, probe().time()));
    std::this_thread::sleep_for(5ms);
  }

  // @returns the first warning that fits among those of now on
  static Warning sendInputsUntil(const GuardProbe::Fits& fits) {
    const auto end = Clock::now() + 30s;
    for (size_t seen = probe().warnings().size(); Clock::now() < end;) {
      sendInputs();
      const auto warnings = probe().warnings();
      for (; seen < warnings.size(); ++seen) {
        if (fits(warnings[seen])) return warnings[seen];
      }
    }
    throw std::runtime_error("no such warning; the last: " + probe().warnings().back().text);
  }
  static void sendInputsFor(std::chrono::milliseconds time) {
    for (const auto end = Clock::now() + time; Clock::now() < end;) sendInputs();
  }

  static bool hung(const Warning& warning) { return (warning.reasons & Warning::WORKER_HUNG) != 0; }

  // From warnings after the first `begin`.
  static bool anyIsHung(size_t begin) {
    const auto warnings = probe().warnings();
    return std::any_of(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(), hung);
  }

  // On a busy machine one of several reports is in time. The guard hangs afterwards.
  static void expectReportInTime(FaultyProcess& guard, Fault fault) {
    for (int tries_left = 5; report(guard, fault) > kReported + 100ms; --tries_left) {
      ASSERT_GT(tries_left, 1);
      guard.end();
      sendInputsUntil(isClear);
    }
    sendInputsUntil([](const Warning& warning) { return has(warning.text, "thread 'guard' makes no progress"); });
  }

  void SetUp() override {
    NodeTest::SetUp();
    placeSquare("square", kSquare);
    sendInputsUntil(isClear);
  }

 private:
  // @returns how long after the fault it was reported
  static Clock::duration report(FaultyProcess& guard, Fault fault) {
    guard.inject(fault, "guard");
    const Warning report = sendInputsUntil(hung);
    const auto delay = Clock::now() - guard.struckAt();
    EXPECT_GE(delay, kReported - 20ms);
    EXPECT_EQ(report.level, Warning::UNKNOWN);
    EXPECT_TRUE(has(report.text, "makes no progress")) << report.text;
    return delay;
  }
};

class OwnProcessTest : public ThreadsTest {
 protected:
  OwnProcessTest() : guard_(guardPid()) {}

  // Waits for a guard of another run.
  static void expectRespawn(const std::string& run_before) {
    sendInputsUntil([&](const Warning& warning) { return warning.run_id != run_before; });
    ASSERT_TRUE(ros::service::waitForService("/sweep_guard/check_sweep", ros::Duration(-1.0)));
    sweep_guard::CheckSweep::Request request = requestAlong({kAway});
    request.mesh_ids = {"square"};
    while (!probe().check(request).success) {
      probe().publish(squareAt("square", kSquare, probe().time()));
      sendInputs();
    }
    sendInputsUntil(isClear);
  }

  FaultyProcess guard_;
};

TEST_F(OwnProcessTest, AHungGuardIsReportedAndAbortsAfterTwoSeconds) {
  for (const Fault fault : {Fault::kBlocks, Fault::kSpins}) {
    FaultyProcess guard(guardPid());
    const std::string run = probe().warnings().back().run_id;
    expectReportInTime(guard, fault);
    while (guard.alive()) sendInputs();
    const auto hung_for = Clock::now() - guard.struckAt();
    EXPECT_GE(hung_for, 1900ms);
    EXPECT_LE(hung_for, kAborted);
    expectRespawn(run);
  }
}

// It holds the lock of the warning: nobody can say so.
TEST_F(OwnProcessTest, AThreadThatHangsWithALockIsSilentAndAborts) {
  const std::string run = probe().warnings().back().run_id;
  guard_.inject(Fault::kBlocks, "warnings");
  while (!guard_.struck()) sendInputs();
  const size_t begin = probe().warnings().size();
  while (guard_.alive()) sendInputs();
  EXPECT_LE(Clock::now() - guard_.struckAt(), kAborted);
  const auto warnings = probe().warnings();
  for (size_t i = begin + 1; i < warnings.size(); ++i) EXPECT_NE(warnings[i].run_id, run);
  expectRespawn(run);
}

TEST_F(OwnProcessTest, RepeatedExceptionsEndTheProcess) {
  const std::string run = probe().warnings().back().run_id;
  guard_.inject(Fault::kAllFail, "reports");
  while (guard_.alive()) sendInputs();
  expectRespawn(run);
}

TEST_F(OwnProcessTest, AStopOfTheProcessIsNoHang) {
  expectReportInTime(guard_, Fault::kBlocks);
  guard_.signal(SIGSTOP);
  std::this_thread::sleep_for(3s);
  guard_.signal(SIGCONT);
  guard_.end();
  sendInputsUntil([](const Warning& warning) { return !hung(warning); });
  sendInputsUntil(isClear);
  const size_t begin = probe().warnings().size();
  guard_.signal(SIGSTOP);
  std::this_thread::sleep_for(3s);
  guard_.signal(SIGCONT);
  sendInputsUntil(isClear);
  EXPECT_FALSE(anyIsHung(begin));
  EXPECT_TRUE(guard_.alive());
}

TEST_F(OwnProcessTest, LoadOfAllProcessorsIsNoHang) {
  const size_t begin = probe().warnings().size();
  std::atomic<bool> go_on = true;
  std::vector<std::thread> load;
  for (unsigned i = 0; i < 4 * std::thread::hardware_concurrency(); ++i) {
    load.emplace_back([&] {
      while (go_on) continue;
    });
  }
  sendInputsFor(4s);
  go_on = false;
  for (std::thread& one : load) one.join();
  EXPECT_FALSE(anyIsHung(begin));
  EXPECT_TRUE(guard_.alive());
}

class SharedProcessTest : public ThreadsTest {
 protected:
  SharedProcessTest() : guard_(pidOf("/manager")) {}

  FaultyProcess guard_;
};

TEST_F(SharedProcessTest, AHungGuardIsReportedAndEndsNothing) {
  for (const Fault fault : {Fault::kBlocks, Fault::kSpins}) {
    expectReportInTime(guard_, fault);
    const size_t begin = probe().warnings().size();
    sendInputsFor(3s);
    EXPECT_TRUE(anyIsHung(begin));
    guard_.end();
    sendInputsUntil([](const Warning& warning) { return !hung(warning); });
    sendInputsUntil(isClear);
    EXPECT_TRUE(guard_.alive());
  }
}

// Between two poses that are away from it.
TEST_F(SharedProcessTest, APoseWhoseSweepFailsIsSweptAfterAll) {
  const auto contacts = probe().warnings().back().level_counts[Warning::CONTACT];
  guard_.inject(Fault::kOneFails, "guard");
  probe().tick(0.01);
  probe().publish(poseAt(kSquare, probe().time()));
  sendInputsUntil([&](const Warning& warning) { return warning.level_counts[Warning::CONTACT] > contacts; });
  EXPECT_TRUE(guard_.struck());
  sendInputsUntil(isClear);
}

class FailingThreadSharedProcessTest : public SharedProcessTest, public testing::WithParamInterface<const char*> {};

TEST_P(FailingThreadSharedProcessTest, IsUnknownUntilTheNextGoodInput) {
  for (const Fault fault : {Fault::kOneFails, Fault::kAllFail}) {
    const size_t begin = probe().warnings().size();
    guard_.inject(fault, GetParam());
    while (!guard_.struck()) publishInputs();
    for (int i = 0; i < 50; ++i) publishInputs();
    guard_.end();
    sendInputsUntil(isClear);
    const auto warnings = probe().warnings();
    const std::uint32_t reasons = Warning::DETECTOR_FAULT | Warning::POSE_INVALID | Warning::MESH_INVALID;
    EXPECT_TRUE(
        std::any_of(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(),
                    [&](const Warning& warning) { return !warning.clear && (warning.reasons & reasons) != 0; }));
    EXPECT_TRUE(guard_.alive());
  }
}

INSTANTIATE_TEST_SUITE_P(Each, FailingThreadSharedProcessTest, testing::Values("guard", "poses", "reports", "warnings"),
                         [](const auto& thread) { return std::string(thread.param); });

}  // namespace
}  // namespace sweep_guard_ros
