// The brush paints on the square that the display shows. Part of sweep_display_test.
#include "rviz/intend_tool.h"

#include <rviz/properties/property.h>
#include <rviz/viewport_mouse_event.h>
#include <sweep_guard/Intended.h>
#include <sweep_guard/Warning.h>

#include <QMouseEvent>
#include <cmath>

#include "await.h"
#include "display_fixture.h"
#include "pictures.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::Intend;
using sweep_guard::Intended;

class IntendToolTest : public SweepDisplayTest {
 protected:
  void SetUp() override {
    SweepDisplayTest::SetUp();
    intended_publisher_ = node_.advertise<Intended>("/sweep_guard/intended", 1, /*latch=*/true);
    subscriber_ = node_.subscribe<Intend>("/sweep_guard/intend_updates", 100,
                                          [this](const Intend::ConstPtr& intend) { sent_.push_back(*intend); });
    tool_.initialize(&Rviz::only().manager);
    tool_.activate();
    await("the guard", [this] { return subscriber_.getNumPublishers() > 0; });
    place(square(0.0));
  }
  void TearDown() override {
    tool_.deactivate();
    SweepDisplayTest::TearDown();
  }

  // Relative to the middle of the picture, in pixels.
  int mouse(QEvent::Type type, int dx, Qt::MouseButton button, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    rviz::RenderPanel& panel = Rviz::only().panel;
    const QPointF at(0.5 * panel.width() + dx, 0.5 * panel.height());
    const bool released = type == QEvent::MouseButtonRelease;
    const Qt::MouseButton acting = type == QEvent::MouseMove ? Qt::NoButton : button;
    QMouseEvent event(type, at, at, acting, released ? Qt::NoButton : button, modifiers);
    rviz::ViewportMouseEvent seen(&panel, panel.getViewport(), &event, 0, 0);
    return tool_.processMouseEvent(seen);
  }

  // The mesh reaches the brush a little later than the display. One message is sent.
  void click(Qt::MouseButton button, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    const size_t before = sent_.size();
    await("the mesh", [&] { return mouse(QEvent::MouseButtonPress, 0, button, modifiers) == rviz::Tool::Render; });
    mouse(QEvent::MouseButtonRelease, 0, button, modifiers);
    await("the message", [&] { return sent_.size() == before + 1; });
  }

  void setProperty(const QString& name, const QVariant& value) {
    tool_.getPropertyContainer()->subProp(name)->setValue(value);
  }

  IntendTool tool_;
  ros::Publisher intended_publisher_;
  ros::Subscriber subscriber_;
  std::vector<Intend> sent_;
};

TEST_F(IntendToolTest, AClickPaintsABallUnderTheMouse) {
  setProperty("Radius", 0.3F);
  setProperty("Depth", 0.02F);
  setProperty("Tool Links", "bit, burr");
  setProperty("Duration", 5.0F);
  click(Qt::LeftButton);
  EXPECT_EQ(sent_[0].mesh_id, "square");
  EXPECT_EQ(sent_[0].frame_id, "world");
  EXPECT_NEAR(sent_[0].center.x, 0.0, 0.1);  // where the camera looks
  EXPECT_NEAR(sent_[0].center.y, 0.0, 0.1);
  EXPECT_NEAR(sent_[0].center.z, 0.0, 1e-4);
  EXPECT_FLOAT_EQ(static_cast<float>(sent_[0].radius), 0.3F);
  EXPECT_FLOAT_EQ(static_cast<float>(sent_[0].depth), 0.02F);
  EXPECT_EQ(sent_[0].tool_links, (std::vector<std::string>{"bit", "burr"}));
  EXPECT_EQ(sent_[0].duration, ros::Duration(5.0));
}

TEST_F(IntendToolTest, AStrokePaintsABallAtEveryHalfRadius) {
  setProperty("Radius", 0.3F);
  click(Qt::LeftButton);
  sent_.clear();
  mouse(QEvent::MouseButtonPress, 0, Qt::LeftButton);
  for (int dx = 1; dx <= 60; ++dx) mouse(QEvent::MouseMove, dx, Qt::LeftButton);
  mouse(QEvent::MouseButtonRelease, 60, Qt::LeftButton);
  await("the stroke", [this] { return sent_.size() >= 3; });
  for (size_t i = 1; i < sent_.size(); ++i) {
    const double step =
        std::hypot(sent_[i].center.x - sent_[i - 1].center.x, sent_[i].center.y - sent_[i - 1].center.y);
    EXPECT_GE(step, 0.15 - 1e-4);
    EXPECT_LE(step, 0.25);
  }
}

TEST_F(IntendToolTest, ShiftAndTheRightButtonTakeBack) {
  click(Qt::LeftButton, Qt::ShiftModifier);
  EXPECT_EQ(sent_[0].mesh_id, "square");
  EXPECT_EQ(sent_[0].radius, 0.0);
  EXPECT_TRUE(sent_[0].triangles.empty());
  sent_.clear();
  click(Qt::RightButton);
  EXPECT_EQ(sent_[0].radius, 0.0);
}

TEST_F(IntendToolTest, BesideTheWorkpieceNothingIsSent) {
  click(Qt::LeftButton);
  sent_.clear();
  EXPECT_EQ(mouse(QEvent::MouseButtonPress, 310, Qt::LeftButton), 0);
  EXPECT_EQ(mouse(QEvent::MouseButtonPress, 0, Qt::MiddleButton), 0);
  mouse(QEvent::MouseButtonRelease, 0, Qt::MiddleButton);
  click(Qt::RightButton);
  EXPECT_EQ(sent_[0].radius, 0.0);  // the first since then
}

TEST_F(IntendToolTest, TheDisplayPaintsTheRegionGreenAndFollowsIt) {
  sweep_guard::View view = viewOf(sweep_guard::Warning::CLEAR);
  for (sweep_guard::ObjectView& object : view.objects) object.touched = object.reflex = object.considered = {};
  show(view);
  Intended intended;
  sweep_guard::Intention& region = intended.intentions.emplace_back();
  region.mesh_id = "square";
  region.revision = 1;
  for (std::uint32_t i = 60; i < 140; ++i) region.triangles.push_back(i);
  intended_publisher_.publish(intended);
  await("the region", [&] {
    show(view);
    return drawn(SurfaceVisual::kIntended) == 80U;
  });
  const auto is_green = [](const QColor& c) { return c.green() > c.red() + 20 && c.green() > c.blue() + 20; };
  await("green", [&] {
    show(view);
    const QImage picture = Rviz::only().picture();
    keepPicture(picture, "display_intended");
    return shareOf(picture, is_green) > 0.01;
  });
  region.revision = 2;
  intended_publisher_.publish(intended);
  await("that it goes", [&] {
    show(view);
    return drawn(SurfaceVisual::kIntended) == 0U;
  });
}

}  // namespace
}  // namespace sweep_guard_rviz
