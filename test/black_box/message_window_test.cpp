#include "black_box/message_window.h"

#include <gtest/gtest.h>

#include <string>

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;
using Window = MessageWindow<std::string>;

constexpr auto kBegin = 1000s;

class MessageWindowTest : public ::testing::Test {
 protected:
  void hear(Duration time, const std::string& content, const std::string& key = "", std::size_t size = 1) {
    window_.add({Time(kBegin + time), size, key, content});
  }

  std::vector<std::string> contents() const {
    std::vector<std::string> contents;
    for (const auto& message : window_.snapshot()) contents.push_back(message.content);
    return contents;
  }

  Window window_{/*length=*/10s, /*max_size=*/100};
};

TEST_F(MessageWindowTest, KeepsTheLastSecondsInTheirOrder) {
  for (int i = 0; i <= 30; ++i) hear(std::chrono::seconds(i), std::to_string(i));
  const auto kept = window_.snapshot();
  ASSERT_EQ(kept.size(), 11U);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].content, std::to_string(20 + i));
    EXPECT_EQ(kept[i].received, Time(kBegin + std::chrono::seconds(20 + i)));
  }
}

TEST_F(MessageWindowTest, KeepsTheNewestOfEachKeyFromBeforeInTheOrderInWhichTheyCame) {
  hear(0s, "old liver", "liver");
  hear(1s, "liver", "liver");
  hear(2s, "bone", "bone");
  hear(3s, "pose");
  hear(20s, "newest");
  EXPECT_EQ(contents(), (std::vector<std::string>{"liver", "bone", "newest"}));
}

// The mesh that is replaced within the window is the one that held when the window began.
TEST_F(MessageWindowTest, TheFirstOfAKeyIsNotReplacedByOneWithinTheWindow) {
  hear(0s, "before", "liver");
  hear(15s, "within", "liver");
  hear(20s, "newest");
  EXPECT_EQ(contents(), (std::vector<std::string>{"before", "within", "newest"}));
}

TEST_F(MessageWindowTest, WhatDependsOnAKeyIsForgottenWhenThatIsReplaced) {
  hear(0s, "mesh", "liver");
  hear(1s, "vertices", "liver\nvertices");
  hear(2s, "vertices of the other", "liver two\nvertices");
  hear(12s, "newest");
  EXPECT_EQ(contents(), (std::vector<std::string>{"mesh", "vertices", "vertices of the other", "newest"}));
  hear(13s, "other mesh", "liver");
  hear(30s, "newest");
  EXPECT_EQ(contents(), (std::vector<std::string>{"vertices of the other", "other mesh", "newest"}));
  EXPECT_EQ(window_.size(), 3U);
}

TEST_F(MessageWindowTest, MessagesFromBeforeComeWithinASecondBeforeTheFirst) {
  hear(0s, "liver", "liver");
  hear(1s, "bone", "bone");
  hear(20s, "first");
  const auto kept = window_.snapshot();
  EXPECT_EQ(kept[0].received, Time(kBegin + 19s));
  EXPECT_EQ(kept[1].received, Time(kBegin + 19500ms));
  EXPECT_EQ(kept[2].received, Time(kBegin + 20s));
}

TEST_F(MessageWindowTest, TimesOfASnapshotIncreaseAlsoWhereTheClockStandsStillOrBeginsAtZero) {
  Window window({10s, 100});
  for (int i = 0; i < 5; ++i) window.add({Time(), 1, "", std::to_string(i)});
  Time before;
  for (const auto& message : window.snapshot()) {
    EXPECT_GT(message.received, before);
    before = message.received;
  }
}

TEST_F(MessageWindowTest, NeverTakesMoreThanItsSize) {
  for (unsigned i = 0; i < 1000; ++i) {
    hear(std::chrono::milliseconds(i), std::to_string(i), i % 3 == 0 ? "key " + std::to_string(i % 7) : "", 1 + i % 60);
    ASSERT_LE(window_.size(), 100U);
  }
  EXPECT_EQ(contents().back(), "999");
}

TEST_F(MessageWindowTest, AMessageThatIsTooLargeByItselfIsNotKeptAndAllOthersAre) {
  hear(0s, "liver", "liver");
  hear(20s, "pose");
  EXPECT_FALSE(window_.add({Time(kBegin + 21s), 101, "bone", "huge"}));
  EXPECT_EQ(contents(), (std::vector<std::string>{"liver", "pose"}));
  EXPECT_EQ(window_.size(), 2U);
  EXPECT_TRUE(window_.add({Time(kBegin + 21s), 100, "bone", "large"}));
  EXPECT_EQ(contents(), std::vector<std::string>{"large"});
}

TEST_F(MessageWindowTest, CoversTheTimeFromItsOldestToItsNewestMessage) {
  EXPECT_FALSE(window_.covers(Time()));
  EXPECT_EQ(window_.newest(), Time());
  hear(1s, "pose");
  hear(12s, "next");
  hear(13s, "newest");
  EXPECT_FALSE(window_.covers(Time(kBegin + 11s)));
  EXPECT_TRUE(window_.covers(Time(kBegin + 12s)));
  EXPECT_TRUE(window_.covers(window_.newest()));
  EXPECT_FALSE(window_.covers(Time(kBegin + 14s)));
}

TEST_F(MessageWindowTest, AMomentLeavesWhereTheSizeIsReachedAndItIsInTheOlderHalf) {
  hear(0s, "first", "", 30);
  hear(4s, "second", "", 30);
  EXPECT_FALSE(window_.isLeaving(Time(kBegin + 1s), 40));
  EXPECT_TRUE(window_.isLeaving(Time(kBegin + 1s), 41));
  EXPECT_FALSE(window_.isLeaving(Time(kBegin + 2s), 41));
  EXPECT_FALSE(window_.isLeaving(Time(kBegin - 1s), 41));
}

TEST_F(MessageWindowTest, KeepsOnlySoManyKeys) {
  Window window({1s, 1U << 20U});
  for (std::size_t i = 0; i < 2 * Window::kMaxKeys; ++i) {
    window.add({Time(kBegin + i * 1s), 1, "key " + std::to_string(i), ""});
  }
  EXPECT_LE(window.size(), Window::kMaxKeys + 2);
}

TEST_F(MessageWindowTest, AnewItKnowsOnlyTheNewestOfEachKey) {
  hear(5s, "liver", "liver");
  hear(6s, "pose");
  EXPECT_FALSE(window_.hasGoneBack(Time(kBegin + 5500ms)));
  EXPECT_TRUE(window_.hasGoneBack(Time(kBegin)));
  window_.startOver();
  hear(0s, "again");
  EXPECT_EQ(contents(), (std::vector<std::string>{"liver", "again"}));
}

}  // namespace
}  // namespace sweep_guard_core
