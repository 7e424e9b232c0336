#include "monitor/work_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "monitor/warning_monitor_fixture.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kPoses = 65536;
constexpr size_t kAtOnce = 4096;
constexpr int kTasks = 16;

QueuedPose receivedAt(int ms) {
  QueuedPose queued;
  queued.pose.received = at(ms).steady;
  return queued;
}

std::future<int> submit(WorkQueue& queue, int answer) {
  return queue.submit<int>([answer] { return answer; });
}

TEST(WorkQueueTest, TakesAllWorkAtOnceAndEachOnce) {
  WorkQueue queue;
  WorkQueue::Work taken;
  queue.push({});
  queue.push({});
  std::future<int> answer = submit(queue, 7);
  ASSERT_TRUE(queue.take(taken));
  EXPECT_FALSE(queue.hasPoses());
  EXPECT_EQ(taken.poses.size(), 2U);
  ASSERT_EQ(taken.tasks.size(), 1U);
  taken.tasks.front()();
  EXPECT_EQ(answer.get(), 7);

  queue.push({});
  ASSERT_TRUE(queue.take(taken));
  EXPECT_EQ(taken.poses.size(), 1U);
  EXPECT_TRUE(taken.tasks.empty());
}

// The input must not wait: it would hold up the poses behind it.
TEST(WorkQueueTest, APoseReplacesTheNewestOfAFullQueueAndSaysSo) {
  WorkQueue queue;
  for (size_t i = 0; i < kPoses; ++i) ASSERT_TRUE(queue.push(receivedAt(static_cast<int>(i))));
  EXPECT_FALSE(queue.push(receivedAt(100000)));
  EXPECT_FALSE(queue.push(receivedAt(100001)));
  WorkQueue::Work taken;
  size_t poses = 0;
  while (queue.hasPoses()) {
    ASSERT_TRUE(queue.take(taken));
    for (const QueuedPose& queued : taken.poses) {
      ++poses;
      ASSERT_EQ(queued.pose.received, at(poses == kPoses ? 100001 : static_cast<int>(poses - 1)).steady);
    }
  }
  EXPECT_EQ(poses, kPoses);
  EXPECT_TRUE(queue.push({}));
}

// The guard keeps 8192 poses: beyond these it would go straight past some.
TEST(WorkQueueTest, TakesNoMorePosesThanTheGuardKeeps) {
  WorkQueue queue;
  for (size_t i = 0; i < kAtOnce + 7; ++i) queue.push(receivedAt(static_cast<int>(i)));
  std::future<int> answer = submit(queue, 7);
  WorkQueue::Work taken;
  ASSERT_TRUE(queue.take(taken));
  EXPECT_EQ(taken.poses.size(), kAtOnce);
  EXPECT_EQ(taken.tasks.size(), 1U);
  EXPECT_TRUE(queue.hasPoses());
  queue.swept({});
  EXPECT_EQ(queue.waitingSince(), at(kAtOnce).steady);
  queue.push(receivedAt(100000));
  ASSERT_TRUE(queue.take(taken));
  ASSERT_EQ(taken.poses.size(), 8U);
  EXPECT_EQ(taken.poses.front().pose.received, at(kAtOnce).steady);
  EXPECT_EQ(taken.poses.back().pose.received, at(100000).steady);
  EXPECT_TRUE(taken.tasks.empty());
}

TEST(WorkQueueTest, KnowsSinceWhenTheOldestPoseWaits) {
  WorkQueue queue;
  EXPECT_FALSE(queue.waitingSince());
  for (const int ms : {10, 20, 30}) queue.push(receivedAt(ms));
  EXPECT_EQ(queue.waitingSince(), at(10).steady);
  WorkQueue::Work taken;
  ASSERT_TRUE(queue.take(taken));
  queue.push(receivedAt(40));
  EXPECT_EQ(queue.waitingSince(), at(10).steady);  // taken, and not swept
  queue.swept(at(30).steady);
  EXPECT_EQ(queue.waitingSince(), at(30).steady);
  queue.swept({});
  EXPECT_EQ(queue.waitingSince(), at(40).steady);
  ASSERT_TRUE(queue.take(taken));
  queue.swept({});
  EXPECT_FALSE(queue.waitingSince());
}

TEST(WorkQueueTest, ATaskAloneLetsNoPoseWait) {
  WorkQueue queue;
  std::future<int> answer = submit(queue, 7);
  WorkQueue::Work taken;
  ASSERT_TRUE(queue.take(taken));
  EXPECT_FALSE(queue.waitingSince());
}

TEST(WorkQueueTest, RefusesTooManyTasks) {
  WorkQueue queue;
  for (int i = 0; i < kTasks; ++i) submit(queue, i);
  EXPECT_THROW(submit(queue, 0), Error);
  WorkQueue::Work taken;
  ASSERT_TRUE(queue.take(taken));
  EXPECT_NO_THROW(submit(queue, 0));
}

TEST(WorkQueueTest, ATaskThatCannotBeginInTimeNeverRuns) {
  WorkQueue queue;
  bool ran = false;
  EXPECT_THROW(queue.run([&] { ran = true; }, std::chrono::milliseconds(1)), Error);
  WorkQueue::Work taken;
  ASSERT_TRUE(queue.take(taken));
  for (const auto& task : taken.tasks) task();
  EXPECT_FALSE(ran);
}

TEST(WorkQueueTest, ATaskThatHasBegunIsWaitedFor) {
  WorkQueue queue;
  std::thread guard([&] {
    WorkQueue::Work taken;
    ASSERT_TRUE(queue.take(taken));
    taken.tasks.front()();
  });
  std::atomic<bool> ended = false;
  const auto task = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ended = true;
  };
  EXPECT_NO_THROW(queue.run(task, std::chrono::seconds(20)));
  EXPECT_TRUE(ended);
  guard.join();
}

TEST(WorkQueueTest, WaitsNoLongerThanAsked) {
  WorkQueue queue;
  WorkQueue::Work taken;
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
  EXPECT_TRUE(queue.take(taken, until));
  EXPECT_GE(std::chrono::steady_clock::now(), until);
  EXPECT_TRUE(taken.poses.empty() && taken.tasks.empty());
  EXPECT_TRUE(queue.take(taken, until));
  queue.push({});
  EXPECT_TRUE(queue.take(taken, SteadyTime()));
  EXPECT_EQ(taken.poses.size(), 1U);
}

TEST(WorkQueueTest, WorkEndsATimedWait) {
  WorkQueue queue;
  std::thread guard([&] {
    WorkQueue::Work taken;
    while (taken.poses.empty()) {
      ASSERT_TRUE(queue.take(taken, std::chrono::steady_clock::now() + std::chrono::hours(1)));
    }
  });
  queue.push({});
  guard.join();
}

TEST(WorkQueueTest, StoppingEndsEveryWait) {
  WorkQueue queue;
  std::future<int> answer = submit(queue, 7);
  WorkQueue idle;
  std::thread guard([&] {
    WorkQueue::Work taken;
    EXPECT_FALSE(idle.take(taken));
  });
  queue.stop();
  idle.stop();
  guard.join();
  EXPECT_THROW(answer.get(), std::future_error);
  EXPECT_THROW(submit(queue, 0), Error);
  WorkQueue::Work taken;
  EXPECT_FALSE(queue.take(taken));
}

TEST(WorkQueueTest, TakesImagesInTheirOrderAndNoMoreThanSixteen) {
  WorkQueue queue;
  std::vector<std::shared_ptr<const Workpiece>> images;
  for (int i = 0; i < 16; ++i) {
    images.push_back(std::make_shared<const Workpiece>(
        Workpiece{"camera", 0, {}, {}, "table", TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})}));
    EXPECT_TRUE(queue.show(images.back()));
  }
  EXPECT_FALSE(queue.show(images.front()));
  EXPECT_TRUE(queue.hasImages() && queue.hasWork() && !queue.hasPoses());
  EXPECT_EQ(queue.takeImages(), images);
  EXPECT_FALSE(queue.hasWork());
  queue.show(images.front());
  WorkQueue::Work work;
  EXPECT_TRUE(queue.take(work));
  EXPECT_EQ(work.images.size(), 1U);
  queue.stop();
  EXPECT_FALSE(queue.show(images.front()));
}

}  // namespace
}  // namespace sweep_guard_core
