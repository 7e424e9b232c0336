#include "common/pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace sweep_guard_core {
namespace {

TEST(PoolTest, ReusesValuesWithoutOtherOwners) {
  Pool<std::string> pool;
  std::string* first = nullptr;
  {
    const auto one = pool.take();
    *one = "as it was left";
    first = one.get();
  }
  const auto again = pool.take();
  EXPECT_EQ(again.get(), first);
  EXPECT_EQ(*again, "as it was left");
  EXPECT_EQ(pool.size(), 1U);
}

TEST(PoolTest, DoesNotReuseOwnedValues) {
  Pool<std::string> pool;
  const std::shared_ptr<const std::string> held = pool.take();
  const auto other = pool.take();
  EXPECT_NE(other.get(), held.get());
  EXPECT_EQ(pool.size(), 2U);
}

TEST(PoolTest, TakesOnlyFittingValues) {
  Pool<std::string> pool;
  pool.add("one");
  EXPECT_FALSE(pool.take([](const std::string& value) { return value == "two"; }));
  EXPECT_TRUE(pool.take([](const std::string& value) { return value == "one"; }));
}

TEST(PoolTest, ForgetsWhatNoneOfTheLastCallsNeeded) {
  constexpr size_t kCalls = 4;
  Pool<std::string> pool;
  const auto take = [&](size_t count) {
    std::vector<std::shared_ptr<std::string>> taken;
    for (size_t i = 0; i < count; ++i) taken.push_back(pool.take());
    pool.forgetUnneeded(kCalls);
  };
  take(10);
  for (size_t i = 1; i < kCalls; ++i) take(i == 1 ? 3 : 2);
  EXPECT_EQ(pool.size(), 10U) << "the first of these calls needed them all";
  for (size_t i = 0; i < kCalls; ++i) take(i == 1 ? 3 : 2);
  EXPECT_EQ(pool.size(), 3U);
}

TEST(PoolTest, NeverForgetsAValueThatIsOwned) {
  Pool<std::string> pool;
  const auto first = pool.take();
  pool.take();
  const auto third = pool.add("third");
  pool.forgetUnneeded(1);
  EXPECT_EQ(pool.size(), 2U);
  EXPECT_NE(pool.take(), first);
  EXPECT_EQ(*third, "third");
}

// The reader releases the value after reading it; the writer does not write before that.
TEST(PoolTest, DoesNotReuseAValueThatAnotherThreadReads) {
  Pool<std::vector<int>> pool;
  std::atomic<std::shared_ptr<const std::vector<int>>*> handed{nullptr};
  std::atomic<bool> done{false};
  bool torn = false;
  std::thread reader([&] {
    while (!done) {
      auto* given = handed.exchange(nullptr);
      if (given == nullptr) continue;
      for (const int number : **given) torn = torn || number != given->get()->front();
      delete given;
    }
  });
  for (int i = 0; i < 20000; ++i) {
    const auto next = pool.take();
    next->assign(64, i);
    delete handed.exchange(new std::shared_ptr<const std::vector<int>>(next));
  }
  done = true;
  reader.join();
  delete handed.exchange(nullptr);
  EXPECT_FALSE(torn);
  EXPECT_LE(pool.size(), 4U);
}

}  // namespace
}  // namespace sweep_guard_core
