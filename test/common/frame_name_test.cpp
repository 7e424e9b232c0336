#include "common/frame_name.h"

#include <gtest/gtest.h>

#include <utility>

namespace sweep_guard_core {
namespace {

TEST(FrameNameTest, HasNoSlashAtItsFront) {
  for (const auto& [frame, plain] : {std::pair{"tool", "tool"},
                                     {"/tool", "tool"},
                                     {"/robot1/tool", "robot1/tool"},
                                     {"a", "a"},
                                     {"/a", "a"},
                                     {"", ""}}) {
    EXPECT_EQ(withoutSlash(frame), plain);
  }
}

TEST(FrameNameTest, WithoutANameBehindItOrWithMoreItStays) {
  for (const std::string frame : {"/", "//", "//tool"}) EXPECT_EQ(withoutSlash(frame), frame);
}

TEST(FrameNameTest, IsTheSameWithASlashAndWithout) {
  for (const char* const frame : {"tool", "/tool"}) {
    EXPECT_TRUE(isSameFrame(frame, "tool"));
    EXPECT_TRUE(isSameFrame("/tool", frame));
    EXPECT_FALSE(isSameFrame(frame, "//tool"));
    EXPECT_FALSE(isSameFrame(frame, "/tool0"));
    EXPECT_FALSE(isSameFrame(frame, ""));
  }
}

}  // namespace
}  // namespace sweep_guard_core
