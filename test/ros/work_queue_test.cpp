#include "ros/work_queue.h"

#include <gtest/gtest.h>

#include <thread>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kPoses = 4096;
constexpr int kTasks = 16;

void fill(WorkQueue& queue) {
  for (size_t i = 0; i < kPoses; ++i) queue.push({});
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

TEST(WorkQueueTest, APoseWaitsForRoomAndIsNotLost) {
  WorkQueue queue;
  fill(queue);
  std::thread input([&] { queue.push({}); });
  WorkQueue::Work taken;
  size_t poses = 0;
  while (poses < kPoses + 1 && queue.take(taken)) poses += taken.poses.size();
  input.join();
  EXPECT_EQ(poses, kPoses + 1);
  EXPECT_FALSE(queue.hasPoses());
}

TEST(WorkQueueTest, RefusesTooManyTasks) {
  WorkQueue queue;
  for (int i = 0; i < kTasks; ++i) submit(queue, i);
  EXPECT_THROW(submit(queue, 0), sweep_guard_core::Error);
  WorkQueue::Work taken;
  ASSERT_TRUE(queue.take(taken));
  EXPECT_NO_THROW(submit(queue, 0));
}

TEST(WorkQueueTest, StoppingEndsEveryWait) {
  WorkQueue queue;
  fill(queue);
  std::future<int> answer = submit(queue, 7);
  std::thread input([&] { queue.push({}); });
  queue.stop();
  input.join();
  EXPECT_THROW(answer.get(), std::future_error);
  EXPECT_THROW(submit(queue, 0), sweep_guard_core::Error);
  WorkQueue::Work taken;
  EXPECT_FALSE(queue.take(taken));
}

}  // namespace
}  // namespace sweep_guard_ros
