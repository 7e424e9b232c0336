#include "ros/input/frame_tree.h"

#include <gtest/gtest.h>

namespace sweep_guard_ros {
namespace {

class FrameTreeTest : public testing::Test {
 protected:
  FrameTreeTest() {
    tree_.add("map", "world");
    tree_.add("world", "table");
    tree_.add("table", "part");
    tree_.add("world", "base");
    tree_.add("base", "tool");
    tree_.add("tool", "camera");
  }

  FrameTree tree_;
};

TEST_F(FrameTreeTest, WhatLiesBetweenTwoFramesIsUsed) {
  tree_.use("workpieces", "world", {"part"});
  EXPECT_TRUE(tree_.isUsed("table"));
  EXPECT_TRUE(tree_.isUsed("part"));
  EXPECT_FALSE(tree_.isUsed("world")) << "where both stand does not count";
  EXPECT_FALSE(tree_.isUsed("tool"));
  EXPECT_FALSE(tree_.isUsed("unknown"));
}

TEST_F(FrameTreeTest, AlsoUpAndDownAgain) {
  tree_.use("workpieces", "tool", {"part"});
  for (const char* const frame : {"tool", "base", "table", "part"}) EXPECT_TRUE(tree_.isUsed(frame)) << frame;
  EXPECT_FALSE(tree_.isUsed("camera"));
  EXPECT_FALSE(tree_.isUsed("world"));
}

TEST_F(FrameTreeTest, EachUserHasItsOwn) {
  tree_.use("workpieces", "world", {"table"});
  tree_.use("tool", "world", {"tool"});
  tree_.use("workpieces", "world", {});
  EXPECT_FALSE(tree_.isUsed("table"));
  EXPECT_TRUE(tree_.isUsed("base"));
}

TEST_F(FrameTreeTest, TellsWhoUsesAFrame) {
  tree_.use("workpieces", "world", {"part"});
  tree_.use("tool", "world", {"tool"});
  EXPECT_TRUE(tree_.isUsedBy("workpieces", "table"));
  EXPECT_FALSE(tree_.isUsedBy("tool", "table"));
  EXPECT_TRUE(tree_.isUsedBy("tool", "base"));
  EXPECT_FALSE(tree_.isUsedBy("haptics", "base"));
}

TEST_F(FrameTreeTest, TellsWhatLiesBetweenFramesThatNobodyUses) {
  const std::set<std::string> expected = {"table", "part", "base", "tool"};
  EXPECT_EQ(tree_.between("part", "tool"), expected);
  EXPECT_EQ(tree_.between("map", "base"), (std::set<std::string>{"world", "base"}));
  EXPECT_EQ(tree_.between("world", "nowhere"), (std::set<std::string>{"map", "nowhere", "world"}));
}

TEST_F(FrameTreeTest, FollowsAFrameThatIsHungUpElsewhere) {
  tree_.use("workpieces", "world", {"part"});
  ASSERT_FALSE(tree_.isUsed("base"));
  tree_.add("base", "table");
  EXPECT_TRUE(tree_.isUsed("base"));
}

TEST_F(FrameTreeTest, ALoopHasAnEnd) {
  tree_.add("part", "world");
  tree_.use("workpieces", "world", {"part", "nowhere"});
  EXPECT_FALSE(tree_.isUsed("camera"));
}

}  // namespace
}  // namespace sweep_guard_ros
