#include "sweep_guard/rviz/sweep_display.h"

#include <OgreRenderWindow.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rviz/properties/status_list.h>
#include <rviz/render_panel.h>
#include <rviz/visualization_manager.h>
#include <sweep_guard/Warning.h>

#include <QApplication>
#include <QTimer>

#include "await.h"
#include "pictures.h"
#include "virtual_display.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::DeformableMesh;
using sweep_guard::MeshVertices;
using sweep_guard::View;
using sweep_guard::Warning;

constexpr int kSide = 10;  // squares along a side of the sheet
constexpr size_t kTriangles = size_t{2} * kSide * kSide;

bool there_is_a_display = false;

// A sheet of 4 m, its squares cut in two.
DeformableMesh sheet(double z, std::uint32_t revision = 1) {
  DeformableMesh mesh;
  mesh.header.frame_id = "world";
  mesh.id = "sheet";
  mesh.revision = revision;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      geometry_msgs::Point& p = mesh.mesh.vertices.emplace_back();
      p.x = 4.0 * x / kSide - 2.0;
      p.y = 4.0 * y / kSide - 2.0;
      p.z = z;
    }
  }
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x;
      mesh.mesh.triangles.emplace_back().vertex_indices = {a, a + 1, a + kSide + 1};
      mesh.mesh.triangles.emplace_back().vertex_indices = {a + 1, a + kSide + 2, a + kSide + 1};
    }
  }
  return mesh;
}

MeshVertices verticesOf(const DeformableMesh& mesh) {
  MeshVertices vertices;
  vertices.header = mesh.header;
  vertices.id = mesh.id;
  vertices.revision = mesh.revision;
  for (const geometry_msgs::Point& p : mesh.mesh.vertices) {
    for (const double value : {p.x, p.y, p.z}) vertices.positions.push_back(static_cast<float>(value));
  }
  return vertices;
}

std::vector<std::uint32_t> range(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = begin; i < end; ++i) all.push_back(i);
  return all;
}

// Some are touched, some of these and others are within the reflex interval, and others within the considered one.
View viewOf(std::uint8_t level) {
  View view;
  view.header.frame_id = "world";
  view.level = level;
  view.pose.orientation.w = 1.0;
  view.pose.position.z = 1.0;
  sweep_guard::ObjectView& object = view.objects.emplace_back();
  object.mesh_id = "sheet";
  object.revision = 1;
  object.frame_id = "world";
  object.touched = range(80, 95);
  object.reflex = range(90, 110);
  object.considered = range(100, 140);
  return view;
}

sweep_guard::ToolShape tetrahedron() {
  sweep_guard::ToolShape shape;
  shape_msgs::Mesh& part = shape.parts.emplace_back();
  part.vertices.resize(4);
  part.vertices[0].z = part.vertices[1].x = part.vertices[2].y = 0.5;
  for (const auto& corners : {std::array{0U, 1U, 2U}, {0U, 1U, 3U}, {0U, 2U, 3U}, {1U, 2U, 3U}}) {
    part.triangles.emplace_back().vertex_indices = {corners[0], corners[1], corners[2]};
  }
  return shape;
}

/// rviz without its frame: one for all tests, for Ogre begins once.
struct Rviz {
  Rviz() : manager(&panel) {
    panel.resize(640, 480);
    panel.initialize(manager.getSceneManager(), &manager);
    panel.show();
    manager.initialize();
    manager.setFixedFrame("world");
    manager.startUpdate();
  }

  QImage picture() {
    Ogre::RenderWindow& window = *panel.getRenderWindow();
    manager.notifyConfigChanged();
    window.update();
    QImage image(static_cast<int>(window.getWidth()), static_cast<int>(window.getHeight()), QImage::Format_RGB32);
    const Ogre::PixelBox box(window.getWidth(), window.getHeight(), 1, Ogre::PF_A8R8G8B8, image.bits());
    window.copyContentsToMemory(Ogre::Box(0, 0, window.getWidth(), window.getHeight()), box);
    return image;
  }

  rviz::RenderPanel panel;
  rviz::VisualizationManager manager;
};
Rviz* rviz_frame = nullptr;

/// A display, and a guard that shows the same all the time.
class SweepDisplayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!there_is_a_display) GTEST_SKIP() << "Xvfb is not installed: nothing can be drawn here";
    mesh_publisher_ = node_.advertise<DeformableMesh>("/mesh", 1, /*latch=*/true);
    vertices_publisher_ = node_.advertise<MeshVertices>("/mesh_vertices", 10);
    view_publisher_ = node_.advertise<View>("/sweep_guard/view", 1);
    tool_publisher_ = node_.advertise<sweep_guard::ToolShape>("/sweep_guard/tool", 1, /*latch=*/true);
    tool_publisher_.publish(tetrahedron());
    display_ = new SweepDisplay;  // the manager's
    rviz_frame->manager.addDisplay(display_, /*enabled=*/true);
    QObject::connect(&timer_, &QTimer::timeout, [this] {
      view_.header.stamp = ros::Time::now();
      view_publisher_.publish(view_);
    });
  }
  void TearDown() override { delete display_; }

  void place(const DeformableMesh& mesh) {
    mesh_publisher_.publish(mesh);
    await("the mesh", [this] { return drawn(SurfaceVisual::kSurface) == kTriangles; });
  }
  void show(const View& view) {
    view_ = view;
    timer_.start(std::chrono::milliseconds(15));
  }
  void fallSilent() { timer_.stop(); }

  size_t drawn(SurfaceVisual::Layer layer) const { return display_->drawnTriangles(layer); }

  /// What the status list says under a name; empty: nothing.
  std::string status(const QString& name) const {
    for (int i = 0; i < display_->numChildren(); ++i) {
      const auto* const list = dynamic_cast<rviz::StatusList*>(display_->childAt(i));
      if (list == nullptr) continue;
      for (int j = 0; j < list->numChildren(); ++j) {
        if (list->childAt(j)->getName() == name) return list->childAt(j)->getValue().toString().toStdString();
      }
    }
    return "";
  }

  ros::NodeHandle node_;
  ros::Publisher mesh_publisher_;
  ros::Publisher vertices_publisher_;
  ros::Publisher view_publisher_;
  ros::Publisher tool_publisher_;
  SweepDisplay* display_ = nullptr;

 private:
  View view_;
  QTimer timer_;
};

TEST_F(SweepDisplayTest, HighlightsEveryTriangleOnceAsTheMostUrgentOfWhatItIs) {
  place(sheet(0.0));
  show(viewOf(Warning::CONTACT));
  await("highlights", [this] { return drawn(SurfaceVisual::kTouched) > 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kTouched), 15U);
  EXPECT_EQ(drawn(SurfaceVisual::kReflex), 15U);
  EXPECT_EQ(drawn(SurfaceVisual::kConsidered), 30U);
  const QImage picture = rviz_frame->picture();
  keepPicture(picture, "display_contact");
  EXPECT_GT(shareOf(picture, isRed), 0.01);
  EXPECT_GT(shareOf(picture, isAmber), 0.01);
}

TEST_F(SweepDisplayTest, IsGreyWhileNothingIsPromised) {
  place(sheet(0.0));
  show(viewOf(Warning::UNKNOWN));
  await("highlights", [this] { return drawn(SurfaceVisual::kTouched) > 0; });
  const QImage picture = rviz_frame->picture();
  keepPicture(picture, "display_unknown");
  EXPECT_EQ(shareOf(picture, isRed), 0.0);
  EXPECT_EQ(shareOf(picture, isAmber), 0.0);
}

TEST_F(SweepDisplayTest, ShowsTheWorkpieceAloneOnceTheGuardIsSilent) {
  place(sheet(0.0));
  show(viewOf(Warning::CONTACT));
  await("highlights", [this] { return drawn(SurfaceVisual::kTouched) > 0; });
  fallSilent();
  await("silence", [this] { return drawn(SurfaceVisual::kTouched) == 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kSurface), kTriangles);
  EXPECT_EQ(display_->drawnTools(), 0U);
  await("the status", [this] { return status("View") == "the guard is silent"; });
}

TEST_F(SweepDisplayTest, ASurfaceThatGoesUnderTheFloorIsSeenThere) {
  place(sheet(0.0));
  const auto pale = [](const QColor& c) { return c.red() > 120 && c.green() > 110 && c.blue() > 90; };
  await("the picture", [&] { return shareOf(rviz_frame->picture(), pale) > 0.05; });
  vertices_publisher_.publish(verticesOf(sheet(-100.0)));
  await("the picture", [&] { return shareOf(rviz_frame->picture(), pale) < 0.01; });
}

TEST_F(SweepDisplayTest, HighlightsNothingOfAnotherRevision) {
  place(sheet(0.0, /*revision=*/2));
  show(viewOf(Warning::CONTACT));
  await("the tool", [this] { return display_->drawnTools() > 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kTouched), 0U);
}

TEST_F(SweepDisplayTest, AWorkpieceThatTheGuardIsSilentAboutHasNoHighlights) {
  place(sheet(0.0));
  show(viewOf(Warning::CONTACT));
  await("highlights", [this] { return drawn(SurfaceVisual::kTouched) > 0; });
  View view = viewOf(Warning::CONTACT);
  view.objects.clear();
  show(view);
  await("that they go", [this] { return drawn(SurfaceVisual::kTouched) == 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kSurface), kTriangles);
}

TEST_F(SweepDisplayTest, AContactHasItsPointAndNormal) {
  const auto yellow = [](const QColor& c) { return c.red() > 240 && c.green() > 230 && c.blue() < 110; };
  place(sheet(0.0));
  rviz::Property* const contacts = display_->subProp("Contacts");
  contacts->subProp("Point Size")->setValue(0.8F);
  contacts->subProp("Normal Length")->setValue(1.0F);
  View view = viewOf(Warning::CONTACT);
  show(view);
  await("highlights", [this] { return drawn(SurfaceVisual::kTouched) > 0; });
  EXPECT_LT(shareOf(rviz_frame->picture(), yellow), 1e-4);
  sweep_guard::TriangleContact& contact = view.objects[0].impacts.emplace_back();
  contact.point.y = 1.0;
  contact.normal.z = 1.0;
  contact.depth = 0.0213;
  show(view);
  await("the contact", [&] {
    const QImage picture = rviz_frame->picture();
    keepPicture(picture, "display_depth");
    return shareOf(picture, yellow) > 1e-3;
  });
}

TEST_F(SweepDisplayTest, AResetKeepsWhatIsLatched) {
  place(sheet(0.0));
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
}

TEST_F(SweepDisplayTest, APartThatIsSwitchedOffIsNotDrawn) {
  place(sheet(0.0));
  show(viewOf(Warning::CONTACT));
  await("highlights", [this] { return drawn(SurfaceVisual::kConsidered) > 0; });
  display_->subProp("Considered")->setValue(false);
  await("that they go", [this] { return drawn(SurfaceVisual::kConsidered) == 0; });
  EXPECT_EQ(drawn(SurfaceVisual::kTouched), 15U);
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

TEST_F(SweepDisplayTest, TellsThatThereIsNoMesh) {
  await("the status", [this] { return status("Mesh") == "none has come from /mesh"; });
}

TEST_F(SweepDisplayTest, TellsWhichFrameIsUnknown) {
  DeformableMesh mesh = sheet(0.0);
  mesh.header.frame_id = "nowhere";
  mesh_publisher_.publish(mesh);
  await("the status", [this] { return status("Frames") == "no transform to world from nowhere"; });
}

TEST_F(SweepDisplayTest, AMeshThatCannotBeIsRefusedAndNamed) {
  DeformableMesh mesh = sheet(0.0);
  mesh.mesh.vertices[3].x = std::nan("");
  mesh_publisher_.publish(mesh);
  await("the status", [this] { return status("Mesh") == "'sheet': a vertex is NaN or infinite"; });
  EXPECT_EQ(drawn(SurfaceVisual::kSurface), 0U);
}

TEST_F(SweepDisplayTest, AWorkpieceThatIsRemovedIsGone) {
  place(sheet(0.0));
  DeformableMesh none;
  none.id = "sheet";
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
  if (!display.running()) return RUN_ALL_TESTS();
  sweep_guard_rviz::there_is_a_display = true;
  QApplication application(argc, argv);
  sweep_guard_rviz::Rviz rviz;
  sweep_guard_rviz::rviz_frame = &rviz;
  return RUN_ALL_TESTS();
}
