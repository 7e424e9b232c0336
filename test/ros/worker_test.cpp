#include "ros/input/worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <mutex>
#include <new>

namespace sweep_guard_ros {
namespace {

// Jobs note their numbers. A worker that is not started keeps them all waiting.
class WorkerTest : public testing::Test {
 protected:
  Worker::Job job(int number, size_t bytes, bool replaceable = false) {
    return {[this, number] { run_.push_back(number); }, [this, number] { dropped_.push_back(number); }, bytes,
            replaceable};
  }

  void startAndFinish(Worker& worker) {
    std::promise<void> done;
    worker.push({[&] { done.set_value(); }, {}, 0});
    worker.start(supervisor_, {"worker"});
    done.get_future().wait();
  }

  Supervisor supervisor_{Process::kShared};
  std::vector<int> run_;
  std::vector<int> dropped_;
};

TEST_F(WorkerTest, RunsJobsInTheirOrder) {
  Worker worker(1000);
  for (int i = 0; i < 100; ++i) worker.push(job(i, 10));
  startAndFinish(worker);
  ASSERT_EQ(run_.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(run_[static_cast<size_t>(i)], i);
  EXPECT_TRUE(dropped_.empty());
}

TEST_F(WorkerTest, DropsTheOldestJobsThatDoNotFitAndDoesNotRunThem) {
  Worker worker(100);
  for (int i = 1; i <= 4; ++i) worker.push(job(i, 25));
  EXPECT_TRUE(dropped_.empty());
  worker.push(job(5, 50));
  EXPECT_EQ(dropped_, (std::vector<int>{1, 2}));
  startAndFinish(worker);
  EXPECT_EQ(run_, (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(dropped_, (std::vector<int>{1, 2}));
}

TEST_F(WorkerTest, KeepsTheNewestJobHoweverLarge) {
  Worker worker(100);
  worker.push(job(1, 100));
  worker.push(job(2, 1000));
  worker.push(job(3, 1000));
  startAndFinish(worker);
  EXPECT_EQ(dropped_, (std::vector<int>{1, 2}));
  EXPECT_EQ(run_, (std::vector<int>{3}));
}

// Vertices are sent again soon; a latched mesh is not.
TEST_F(WorkerTest, DropsReplaceableJobsBeforeOthers) {
  Worker worker(100);
  worker.push(job(1, 40));
  worker.push(job(2, 30, /*replaceable=*/true));
  worker.push(job(3, 30, /*replaceable=*/true));
  worker.push(job(4, 30, /*replaceable=*/true));
  EXPECT_EQ(dropped_, (std::vector<int>{2}));
  worker.push(job(5, 60));
  EXPECT_EQ(dropped_, (std::vector<int>{2, 3, 4}));
  worker.push(job(6, 30, /*replaceable=*/true));
  EXPECT_EQ(dropped_, (std::vector<int>{2, 3, 4, 6}));
  startAndFinish(worker);
  EXPECT_EQ(run_, (std::vector<int>{1, 5}));
}

// Else a refusal of an old mesh would come after the new one was accepted.
TEST_F(WorkerTest, DropsAJobBeforeTheOneThatTakesItsPlaceRuns) {
  std::mutex mutex;
  std::vector<int> events;
  const auto note = [&](int event) {
    return [&, event] {
      const std::lock_guard lock(mutex);
      events.push_back(event);
    };
  };
  std::promise<void> running;
  std::promise<void> go_on;
  std::promise<void> done;
  Worker worker(100);
  worker.start(supervisor_, {"worker"});
  worker.push({[&] {
                 running.set_value();
                 go_on.get_future().wait();
               },
               {},
               0});
  running.get_future().wait();
  worker.push({note(1),
               [&] {
                 go_on.set_value();
                 std::this_thread::sleep_for(std::chrono::milliseconds(20));
                 note(-1)();
               },
               90});
  worker.push({[&] {
                 note(2)();
                 done.set_value();
               },
               {},
               90});
  done.get_future().wait();
  EXPECT_EQ(events, (std::vector<int>{-1, 2}));
}

TEST_F(WorkerTest, DropsAJobThatRunsOutOfMemory) {
  Worker worker(100);
  worker.push({[] { throw std::bad_alloc(); }, [&] { dropped_.push_back(1); }, 10});
  worker.push(job(2, 10));
  startAndFinish(worker);
  EXPECT_EQ(dropped_, (std::vector<int>{1}));
  EXPECT_EQ(run_, (std::vector<int>{2}));
}

TEST_F(WorkerTest, FreesTheBytesOfJobsThatHaveRun) {
  Worker worker(100);
  worker.start(supervisor_, {"worker"});
  for (int i = 0; i < 100; ++i) {
    std::promise<void> done;
    worker.push({[&] { done.set_value(); }, [] { ADD_FAILURE() << "dropped"; }, 90});
    done.get_future().wait();
  }
}

TEST_F(WorkerTest, WaitsForTheRunningJobWhenDestroyedAndForgetsTheOthers) {
  std::promise<void> running;
  std::atomic<bool> finished = false;
  {
    Worker worker(100);
    worker.start(supervisor_, {"worker"});
    worker.push({[&] {
                   running.set_value();
                   std::this_thread::sleep_for(std::chrono::milliseconds(50));
                   finished = true;
                 },
                 [] { ADD_FAILURE() << "dropped"; }, 10});
    running.get_future().wait();
    worker.push(job(2, 10));
  }
  EXPECT_TRUE(finished);
  EXPECT_TRUE(run_.empty());
  EXPECT_TRUE(dropped_.empty());
}

TEST_F(WorkerTest, MayBeDestroyedWithoutAStart) {
  Worker worker(100);
  worker.push(job(1, 10));
}

}  // namespace
}  // namespace sweep_guard_ros
