// The frames that commands are given in.
#include "ros/motion/command_frames.h"

#include "base_and_arm.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

class CommandFramesTest : public BaseAndArm {
 protected:
  CommandFramesTest() {
    motion_.tool.fixed_frame = parameters_.fixed_frame;
    motion_.tool.frame = "tool";
    frames_.start(supervisor_);
  }

  // Where the tool is.
  static std::optional<sweep_guard_core::MotionInputs::ToolPose> toolAt(double z) {
    sweep_guard_core::MotionInputs::ToolPose tool{Eigen::Isometry3d::Identity(), {}};
    tool.X_WT.translation().z() = z;
    return tool;
  }

  double height(const std::string& frame) const {
    return commandFramePose(frames_, motion_, frame, toolAt(3.0)).translation().z();
  }

  MotionParameters motion_{};
};

// tf does not place it.
TEST_F(CommandFramesTest, TheToolIsItsNewestPoseWithASlashAndWithout) {
  for (const std::string parameter : {"tool", "/tool"}) {
    motion_.tool.frame = parameter;
    for (const std::string frame : {"tool", "/tool"}) EXPECT_EQ(height(frame), 3.0) << parameter << ' ' << frame;
    for (const std::string frame : {"tool", "/tool"}) {
      motion_.command_frame = frame;
      EXPECT_EQ(height(""), 3.0) << parameter << ' ' << frame;
    }
    for (const std::string frame : {"//tool", "/tool0", "tool/"}) {
      EXPECT_TRUE(has(refusal<FrameError>([&] { height(frame); }), "no transform from '" + frame + "'")) << frame;
      EXPECT_TRUE(has(refusal<FrameError>([&] { height(frame); }), "no frame '" + frame + "'")) << frame;
    }
  }
}

TEST_F(CommandFramesTest, AnotherFrameIsWhereTfHasIt) {
  placeBase(2.0);
  awaitFrame("base");
  for (const std::string frame : {"base", "/base"}) EXPECT_EQ(height(frame), 2.0) << frame;
  for (const std::string& frame : {parameters_.fixed_frame, "/" + parameters_.fixed_frame})
    EXPECT_EQ(height(frame), 0.0) << frame;
}

TEST_F(CommandFramesTest, WithoutAToolPoseOneInItsFrameIsRefused) {
  for (const std::string frame : {"tool", "/tool"}) {
    EXPECT_TRUE(has(refusal<FrameError>([&] { commandFramePose(frames_, motion_, frame, std::nullopt); }),
                    "there is no tool pose yet"));
  }
  EXPECT_TRUE(has(refusal<FrameError>([&] { height(""); }), "its header names no frame"));
}

}  // namespace
}  // namespace sweep_guard_ros
