// The way back of a robot that a motion guard holds. Part of sweep_display_test.
#include <sweep_guard/MotionStatus.h>
#include <sweep_guard/Warning.h>

#include "await.h"
#include "display_fixture.h"
#include "pictures.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::MotionStatus;

// The tool's pose is 1 m above the square.
MotionStatus heldAbove(const char* frame = "world") {
  MotionStatus status;
  status.header.frame_id = frame;
  status.code = MotionStatus::HALT_FOR_COLLISION;
  status.normal.z = 1.0;
  return status;
}

class WayBackDisplayTest : public SweepDisplayTest {
 protected:
  void SetUp() override {
    SweepDisplayTest::SetUp();
    publisher_ = node_.advertise<MotionStatus>("/motion_guard/status", 10);
    QObject::connect(&timer_, &QTimer::timeout, [this] { publisher_.publish(status_); });
    display_->subProp("Way back")->subProp("Length")->setValue(1.5F);
    place(square(0.0));
    show(viewOf(sweep_guard::Warning::CLEAR));
  }

  void hold(const MotionStatus& status) {
    status_ = status;
    timer_.start(std::chrono::milliseconds(15));
  }
  void awaitArrow(bool shown) {
    await("the arrow", [&] { return (shareOf(Rviz::only().picture(), isMagenta) > 1e-3) == shown; });
  }

  ros::Publisher publisher_;
  MotionStatus status_;
  QTimer timer_;
};

TEST_F(WayBackDisplayTest, IsAnArrowUntilTheCommandIsPassedOn) {
  hold(heldAbove());
  awaitArrow(true);
  keepPicture(Rviz::only().picture(), "display_way_back");
  MotionStatus passed_on = heldAbove();
  passed_on.code = MotionStatus::NO_WARNING;
  hold(passed_on);
  awaitArrow(false);
}

TEST_F(WayBackDisplayTest, OfAMotionGuardThatIsSilentIsNotDrawn) {
  hold(heldAbove());
  awaitArrow(true);
  timer_.stop();
  awaitArrow(false);
  EXPECT_GT(display_->drawnTools(), 0U);
}

TEST_F(WayBackDisplayTest, InAnotherFrameIsNotDrawn) {
  hold(heldAbove());
  awaitArrow(true);
  hold(heldAbove("base"));
  awaitArrow(false);
}

TEST_F(WayBackDisplayTest, HasASwitch) {
  hold(heldAbove());
  awaitArrow(true);
  display_->subProp("Way back")->setValue(false);
  awaitArrow(false);
}

}  // namespace
}  // namespace sweep_guard_rviz
