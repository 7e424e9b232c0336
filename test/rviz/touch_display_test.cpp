// The force on the tool, and what it has touched. Part of sweep_display_test.
#include <sweep_guard/Interaction.h>
#include <sweep_guard/Touches.h>
#include <sweep_guard/Warning.h>

#include "await.h"
#include "display_fixture.h"
#include "pictures.h"
#include "rviz/feeds.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::Interaction;
using sweep_guard::Touches;

constexpr auto kDark = static_cast<SurfaceVisual::Layer>(SurfaceVisual::kHeat + kHeatColors - 1);

bool isPurple(const QColor& c) { return c.red() < 100 && c.green() < 60 && c.blue() > 110; }

Touches touches(std::uint32_t revision = 1) {
  Touches touches;
  sweep_guard::ObjectTouches& square = touches.objects.emplace_back();
  square.mesh_id = "square";
  square.revision = revision;
  for (std::uint32_t triangle = 0; triangle < 60; ++triangle) {
    square.triangles.push_back(triangle);
    square.sweeps.push_back(triangle < 40 ? 1 : 100);
    square.depths.push_back(triangle < 20 ? 0.012F : 0.0F);
  }
  return touches;
}

// The tool's pose is 1 m above the origin.
Interaction pushedUp(double force) {
  Interaction interaction;
  interaction.valid = 1;
  sweep_guard::ObjectInteraction& object = interaction.objects.emplace_back();
  object.centroid.z = -1.0;
  object.volume = 3.14e-6;
  object.depth = 0.0102;
  object.wrench.force.z = force;
  return interaction;
}

class TouchDisplayTest : public SweepDisplayTest {
 protected:
  void SetUp() override {
    SweepDisplayTest::SetUp();
    touches_publisher_ = node_.advertise<Touches>("/sweep_guard/touches", 1, /*latch=*/true);
    interaction_publisher_ = node_.advertise<Interaction>("/sweep_guard/interaction", 10);
    QObject::connect(&timer_, &QTimer::timeout, [this] { interaction_publisher_.publish(interaction_); });
  }

  void colorBy(const char* what) { display_->subProp("Workpiece")->subProp("Color By")->setValue(what); }
  void push(const Interaction& interaction) {
    interaction_ = interaction;
    timer_.start(std::chrono::milliseconds(15));
  }

  ros::Publisher touches_publisher_;
  ros::Publisher interaction_publisher_;
  QTimer timer_;

 private:
  Interaction interaction_;
};

TEST_F(TouchDisplayTest, UntilItIsChosenNobodyListensToForceAndTouches) {
  place(square(0.0));
  show(viewOf(sweep_guard::Warning::CONTACT));
  await("the tool", [this] { return display_->drawnTools() > 0; });
  EXPECT_EQ(interaction_publisher_.getNumSubscribers(), 0U);
  EXPECT_EQ(touches_publisher_.getNumSubscribers(), 0U);
  colorBy("Touches");
  display_->subProp("Force")->setValue(true);
  await("both", [this] {
    return interaction_publisher_.getNumSubscribers() == 1 && touches_publisher_.getNumSubscribers() == 1;
  });
  colorBy("Nothing");
  display_->subProp("Force")->setValue(false);
  await("none", [this] {
    return interaction_publisher_.getNumSubscribers() == 0 && touches_publisher_.getNumSubscribers() == 0;
  });
}

TEST_F(TouchDisplayTest, ColorsTheWorkpieceByTouchesOrDepth) {
  place(square(0.0));
  touches_publisher_.publish(touches());
  colorBy("Touches");
  await("20 dark triangles", [this] { return drawn(kDark) == 20; });
  EXPECT_EQ(drawn(SurfaceVisual::kHeat), 40U);
  await("the scale", [this] { return status("Touches") == "'square': 1 (pale) to 100 sweeps (dark)"; });
  const QImage picture = Rviz::only().picture();
  keepPicture(picture, "display_touches");
  EXPECT_GT(shareOf(picture, isPurple), 0.005);
  colorBy("Largest Depth");
  await("the scale of the depth", [this] { return status("Touches") == "'square': 0 (pale) to 12.0 mm (dark)"; });
  EXPECT_EQ(drawn(kDark), 20U);
  colorBy("Nothing");
  await("none", [this] { return drawn(kDark) == 0; });
  EXPECT_EQ(shareOf(Rviz::only().picture(), isPurple), 0.0);
}

TEST_F(TouchDisplayTest, WhatIsTouchedNowIsDrawnOverIt) {
  place(square(0.0));
  touches_publisher_.publish(touches());
  colorBy("Touches");
  sweep_guard::View view = viewOf(sweep_guard::Warning::CONTACT);
  view.objects[0].touched.clear();
  for (std::uint32_t triangle = 40; triangle < 60; ++triangle) view.objects[0].touched.push_back(triangle);
  show(view);
  await("both", [this] { return drawn(kDark) == 20 && drawn(SurfaceVisual::kTouched) == 20; });
  EXPECT_EQ(shareOf(Rviz::only().picture(), isPurple), 0.0);
}

TEST_F(TouchDisplayTest, ColorsNothingOfAnotherRevision) {
  place(square(0.0));
  colorBy("Touches");
  touches_publisher_.publish(touches());
  await("colors", [this] { return drawn(kDark) == 20; });
  touches_publisher_.publish(touches(/*revision=*/2));
  await("none", [this] { return drawn(kDark) == 0; });
  await("the status", [this] { return status("Touches") == "none"; });
}

TEST_F(TouchDisplayTest, DrawsTheForceAsAnArrow) {
  place(square(0.0));
  display_->subProp("Force")->setValue(true);
  display_->subProp("Force")->subProp("Length")->setValue(0.5F);
  show(viewOf(sweep_guard::Warning::CONTACT));
  push(pushedUp(4.0));
  await("the arrow",
        [this] { return display_->drawnForces() == 1 && shareOf(Rviz::only().picture(), isMagenta) > 1e-3; });
  const QImage picture = Rviz::only().picture();
  keepPicture(picture, "display_force");
  const double share = shareOf(picture, isMagenta);
  push(pushedUp(2.0));
  await("a shorter one", [&] { return shareOf(Rviz::only().picture(), isMagenta) < 0.6 * share; });
  push(Interaction());
  await("none", [this] { return display_->drawnForces() == 0 && shareOf(Rviz::only().picture(), isMagenta) == 0.0; });
}

TEST_F(TouchDisplayTest, AForceThatIsNoLongerToldIsNotDrawn) {
  display_->subProp("Force")->setValue(true);
  show(viewOf(sweep_guard::Warning::CONTACT));
  push(pushedUp(4.0));
  await("the arrow", [this] { return display_->drawnForces() == 1; });
  timer_.stop();
  await("that it goes", [this] { return display_->drawnForces() == 0; });
  EXPECT_GT(display_->drawnTools(), 0U);
}

TEST(ForceTextTest, TellsForceVolumeAndDepth) {
  EXPECT_EQ(describe(pushedUp(4.0).objects[0]), "4.00 N, 3.14 cm^3, 10.2 mm");
}

TEST(ForceTextTest, OfSeveralWorkpiecesTellsTheWholeForceAndTheLargestDepth) {
  Interaction interaction = pushedUp(4.0);
  interaction.objects.push_back(interaction.objects[0]);
  interaction.objects[1].depth = 0.02;
  interaction.wrench.force.x = 3.0;
  interaction.wrench.force.z = 4.0;
  EXPECT_EQ(describe(interaction), "5.00 N, 6.28 cm^3, 20.0 mm");
  EXPECT_EQ(describe(Interaction()), "");
}

}  // namespace
}  // namespace sweep_guard_rviz
