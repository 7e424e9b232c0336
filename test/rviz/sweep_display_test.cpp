#include "rviz/sweep_display.h"

#include <sweep_guard/Warning.h>

#include <QApplication>
#include <cmath>
#include <cstdio>

#include "await.h"
#include "display_fixture.h"
#include "pictures.h"
#include "virtual_display.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::DeformableMesh;
using sweep_guard::View;
using sweep_guard::Warning;

class HighlightTest : public SweepDisplayTest {
 protected:
  void showHighlights(std::uint8_t level) {
    place(square(0.0));
    show(viewOf(level));
    await("highlights", [this] { return drawn(SurfaceVisual::kTouched) > 0; });
  }

  // Sends the view again and again: on a busy machine a picture takes so long that the guard counts as silent.
  template <typename Condition>
  void awaitShown(const std::string& what, const View& view, const Condition& condition) {
    await(what, [&] {
      show(view);
      return condition();
    });
  }
};

TEST_F(HighlightTest, HighlightsEveryTriangleOnce) {
  showHighlights(Warning::CONTACT);
  EXPECT_EQ(drawn(SurfaceVisual::kTouched), 15U);
  EXPECT_EQ(drawn(SurfaceVisual::kReflex), 15U);
  EXPECT_EQ(drawn(SurfaceVisual::kConsidered), 30U);
  const QImage picture = Rviz::only().picture();
  keepPicture(picture, "display_contact");
  EXPECT_GT(shareOf(picture, isRed), 0.01);
  EXPECT_GT(shareOf(picture, isAmber), 0.01);
}

TEST_F(HighlightTest, IsGrayWhileTheLevelIsUnknown) {
  showHighlights(Warning::UNKNOWN);
  const QImage picture = Rviz::only().picture();
  keepPicture(picture, "display_unknown");
  EXPECT_GT(shareOf(picture, isGray), 0.01);
  EXPECT_EQ(shareOf(picture, isRed), 0.0);
  EXPECT_EQ(shareOf(picture, isAmber), 0.0);
}

TEST_F(HighlightTest, AContactThatIsOnlyHeldIsPaleAndSaysForHowLong) {
  place(square(0.0));
  View view = viewOf(Warning::CONTACT);
  view.objects[0].reflex.clear();
  awaitShown("touched triangles", view, [] { return shareOf(Rviz::only().picture(), isRed) > 0.005; });
  view.held = true;
  view.held_since = ros::Time::now() - ros::Duration(0.3);
  sweep_guard::TriangleContact& contact = view.objects[0].impacts.emplace_back();
  contact.normal.z = 1.0;
  contact.depth = 0.01;
  awaitShown("pale ones", view, [this] {
    return shareOf(Rviz::only().picture(), isRed) < 0.001 && drawn(SurfaceVisual::kTouched) == 15U;
  });
  keepPicture(Rviz::only().picture(), "display_held");
}

TEST_F(HighlightTest, WhatIsAcknowledgedIsPaleAndStays) {
  place(square(0.0));
  View view = viewOf(Warning::CONSIDERED);
  awaitShown("amber triangles", view, [] { return shareOf(Rviz::only().picture(), isAmber) > 0.01; });
  view.acknowledged = true;
  awaitShown("pale ones", view, [this] {
    return shareOf(Rviz::only().picture(), isAmber) < 0.001 && drawn(SurfaceVisual::kConsidered) == 30U;
  });
  keepPicture(Rviz::only().picture(), "display_acknowledged");
}

TEST_F(HighlightTest, ShowsOnlyTheWorkpieceWhenTheGuardIsSilent) {
  showHighlights(Warning::CONTACT);
  fallSilent();
  await("silence", [this] { return drawn(SurfaceVisual::kTouched) == 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kSurface), kTriangles);
  EXPECT_EQ(display_->drawnTools(), 0U);
  await("the status", [this] { return status("View") == "the guard is silent"; });
}

TEST_F(SweepDisplayTest, ASurfaceIsDrawnWhereItsVerticesAre) {
  const auto pale = [](const QColor& c) { return c.red() > 120 && c.green() > 110 && c.blue() > 90; };
  place(square(-100.0));
  EXPECT_LT(shareOf(Rviz::only().picture(), pale), 0.01);
  vertices_publisher_.publish(verticesOf(square(0.0)));
  await("the surface", [&] { return shareOf(Rviz::only().picture(), pale) > 0.05; });
  vertices_publisher_.publish(verticesOf(square(-100.0)));
  await("that it goes", [&] { return shareOf(Rviz::only().picture(), pale) < 0.01; });
}

TEST_F(SweepDisplayTest, HighlightsNothingOfAnotherRevision) {
  place(square(0.0, /*revision=*/2));
  show(viewOf(Warning::CONTACT));
  await("the tool", [this] { return display_->drawnTools() > 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kTouched), 0U);
}

TEST_F(HighlightTest, AWorkpieceThatTheViewOmitsHasNoHighlights) {
  showHighlights(Warning::CONTACT);
  View view = viewOf(Warning::CONTACT);
  view.objects.clear();
  show(view);
  await("that they go", [this] { return drawn(SurfaceVisual::kTouched) == 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kSurface), kTriangles);
}

TEST_F(SweepDisplayTest, AResetReceivesLatchedMessagesAgain) {
  place(square(0.0));
  display_->reset();
  EXPECT_EQ(drawn(SurfaceVisual::kSurface), 0U);
  await("the mesh", [this] { return drawn(SurfaceVisual::kSurface) == kTriangles; });
}

TEST_F(SweepDisplayTest, ShowsTheToolAndItsGhosts) {
  View view = viewOf(Warning::CLEAR);
  for (int i = 1; i <= 20; ++i) {
    view.path.push_back(view.pose);
    view.path.back().position.x = 0.5 * i;
  }
  show(view);
  await("the tools", [this] { return display_->drawnTools() > 0; });
  EXPECT_EQ(display_->drawnTools(), 1U + 8U);
  display_->subProp("Ghosts")->subProp("Number")->setValue(3);
  await("fewer", [this] { return display_->drawnTools() == 1U + 3U; });
}

TEST_F(SweepDisplayTest, DrawsNoToolWhileNoPoseIsKnown) {
  View view = viewOf(Warning::UNKNOWN);
  view.path.assign(5, view.pose);
  show(view, /*posed=*/false);
  await("the shape", [this] { return status("Tool") == "known"; });
  await("the status", [this] { return status("View") == "the guard has no pose"; });
  EXPECT_EQ(display_->drawnTools(), 0U);
  show(view);
  await("the tool", [this] { return display_->drawnTools() > 0; });
  show(view, /*posed=*/false);
  await("that it goes", [this] { return display_->drawnTools() == 0; });
}

TEST_F(SweepDisplayTest, ForgetsTheToolWhenItsTopicChanges) {
  show(viewOf(Warning::CLEAR));
  await("the tool", [this] { return display_->drawnTools() > 0; });
  display_->subProp("Tool Topic")->setValue("/nobody/tool");
  await("the status", [this] { return status("Tool") == "no tool shape from /nobody/tool"; });
  await("a view", [this] { return status("View") == "received"; });
  EXPECT_EQ(display_->drawnTools(), 0U);
}

TEST_F(SweepDisplayTest, AddedByTopicListensToThatGuard) {
  display_->setTopic("/other/view", "sweep_guard/View");
  EXPECT_EQ(display_->subProp("View Topic")->getValue().toString(), "/other/view");
  EXPECT_EQ(display_->subProp("Tool Topic")->getValue().toString(), "/other/tool");
}

TEST_F(SweepDisplayTest, ReportsTheAgeOfThePoseWhileTheLevelIsUnknown) {
  show(viewOf(Warning::UNKNOWN));
  await("the status", [this] { return status("View").rfind("the level is UNKNOWN; the newest pose is ", 0) == 0; });
}

TEST_F(SweepDisplayTest, ListensToNothingWhileDisabled) {
  const auto listeners = [this] {
    return mesh_publisher_.getNumSubscribers() + vertices_publisher_.getNumSubscribers() +
           view_publisher_.getNumSubscribers() + tool_publisher_.getNumSubscribers();
  };
  await("four subscribers", [&] { return listeners() == 4; });
  display_->setEnabled(false);
  await("none", [&] { return listeners() == 0; });
}

TEST_F(SweepDisplayTest, ReportsAMissingMesh) {
  await("the status", [this] { return status("Mesh") == "no mesh from /mesh"; });
}

TEST_F(SweepDisplayTest, NeedsNoMeshOfACamera) {
  View view = viewOf(Warning::CLEAR);
  show(view);
  await("the status", [this] { return status("Mesh") == "no mesh 'square' from /mesh"; });
  view.objects[0].of_camera = 1;
  show(view);
  await("the status", [this] { return status("Mesh") == "0 triangles"; });
}

TEST_F(SweepDisplayTest, ReportsAnUnknownFrame) {
  DeformableMesh mesh = square(0.0);
  mesh.header.frame_id = "nowhere";
  mesh_publisher_.publish(mesh);
  await("the status", [this] { return status("Frames") == "no transform to world from nowhere"; });
}

TEST_F(SweepDisplayTest, RefusesAndReportsAnInvalidMesh) {
  DeformableMesh mesh = square(0.0);
  mesh.mesh.vertices[3].x = std::nan("");
  mesh_publisher_.publish(mesh);
  await("the status", [this] { return status("Mesh") == "'square': a vertex is NaN or infinite"; });
  EXPECT_EQ(drawn(SurfaceVisual::kSurface), 0U);
}

TEST_F(SweepDisplayTest, ReportsVerticesWithoutAMesh) {
  await("the display", [this] { return vertices_publisher_.getNumSubscribers() > 0; });
  vertices_publisher_.publish(verticesOf(square(0.0)));
  await("the status", [this] { return status("Mesh") == "'square': no mesh yet"; });
}

TEST_F(SweepDisplayTest, RemovesAWorkpiece) {
  place(square(0.0));
  DeformableMesh none;
  none.id = "square";
  mesh_publisher_.publish(none);
  await("that it goes", [this] { return drawn(SurfaceVisual::kSurface) == 0; });
}

}  // namespace
}  // namespace sweep_guard_rviz

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "sweep_display_test");
  ros::NodeHandle keeps_ros_running;
  const sweep_guard_rviz::VirtualDisplay display;
  if (!display.running()) {
    std::fputs("Xvfb is missing: nothing can be drawn here\n", stderr);
    return 1;
  }
  QApplication application(argc, argv);
  sweep_guard_rviz::Rviz rviz;
  return RUN_ALL_TESTS();
}
