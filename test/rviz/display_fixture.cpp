#include "display_fixture.h"

#include <OgreRenderWindow.h>
#include <rviz/properties/status_list.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include "await.h"

namespace sweep_guard_rviz {
namespace {

Rviz* the_only = nullptr;

}  // namespace

Rviz::Rviz() : manager(&panel) {
  panel.resize(640, 480);
  panel.initialize(manager.getSceneManager(), &manager);
  panel.show();
  manager.initialize();
  manager.setFixedFrame("world");
  manager.startUpdate();
  the_only = this;
}

Rviz& Rviz::only() { return *the_only; }

QImage Rviz::picture() {
  Ogre::RenderWindow& window = *panel.getRenderWindow();
  manager.notifyConfigChanged();
  window.update();
  QImage image(static_cast<int>(window.getWidth()), static_cast<int>(window.getHeight()), QImage::Format_RGB32);
  const Ogre::PixelBox box(window.getWidth(), window.getHeight(), 1, Ogre::PF_A8R8G8B8, image.bits());
#if OGRE_VERSION < 0x10A00
  window.copyContentsToMemory(box);
#else
  window.copyContentsToMemory(Ogre::Box(0, 0, window.getWidth(), window.getHeight()), box);
#endif
  return image;
}

void Rviz::setDistance(float distance) {
  manager.getViewManager()->getCurrent()->subProp("Distance")->setValue(distance);
}

void SweepDisplayTest::SetUp() {
  mesh_publisher_ = node_.advertise<sweep_guard::DeformableMesh>("/mesh", 1, /*latch=*/true);
  vertices_publisher_ = node_.advertise<sweep_guard::MeshVertices>("/mesh_vertices", 10);
  view_publisher_ = node_.advertise<sweep_guard::View>("/sweep_guard/view", 1);
  tool_publisher_ = node_.advertise<sweep_guard::ToolShape>("/sweep_guard/tool", 1, /*latch=*/true);
  tool_publisher_.publish(tetrahedron());
  display_ = new SweepDisplay;  // owned by the manager
  Rviz::only().setDistance(10.0F);
  Rviz::only().manager.addDisplay(display_, /*enabled=*/true);
  QObject::connect(&timer_, &QTimer::timeout, [this] {
    view_.header.stamp = posed_ ? ros::Time::now() : ros::Time();
    view_publisher_.publish(view_);
  });
}

void SweepDisplayTest::place(const sweep_guard::DeformableMesh& mesh) {
  mesh_publisher_.publish(mesh);
  await("the mesh", [this] { return drawn(SurfaceVisual::kSurface) == kTriangles; });
}

void SweepDisplayTest::show(const sweep_guard::View& view, bool posed) {
  view_ = view;
  posed_ = posed;
  timer_.start(std::chrono::milliseconds(15));
}

std::string SweepDisplayTest::status(const QString& name) const {
  for (int i = 0; i < display_->numChildren(); ++i) {
    const auto* const list = dynamic_cast<rviz::StatusList*>(display_->childAt(i));
    if (list == nullptr) continue;
    for (int j = 0; j < list->numChildren(); ++j) {
      if (list->childAt(j)->getName() == name) return list->childAt(j)->getValue().toString().toStdString();
    }
  }
  return "";
}

}  // namespace sweep_guard_rviz
