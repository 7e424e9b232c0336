#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rviz/render_panel.h>
#include <rviz/visualization_manager.h>

#include <QImage>
#include <QTimer>
#include <string>

#include "display_scene.h"
#include "rviz/sweep_display.h"

namespace sweep_guard_rviz {

/// rviz without its window: one for all tests, because Ogre starts once.
class Rviz {
 public:
  Rviz();  ///< only() returns this object from now on
  static Rviz& only();

  QImage picture();
  void setDistance(float distance);  ///< distance of the camera from the origin [m]

  rviz::RenderPanel panel;
  rviz::VisualizationManager manager;
};

/// A display and a guard that repeats one view.
class SweepDisplayTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override { delete display_; }

  void place(const sweep_guard::DeformableMesh& mesh);
  void show(const sweep_guard::View& view, bool posed = true);  ///< posed: with a stamp
  void fallSilent() { timer_.stop(); }

  size_t drawn(SurfaceVisual::Layer layer) const { return display_->drawnTriangles(layer); }
  std::string status(const QString& name) const;  ///< text of a line of the status list; empty if there is none

  ros::NodeHandle node_;
  ros::Publisher mesh_publisher_;
  ros::Publisher vertices_publisher_;
  ros::Publisher view_publisher_;
  ros::Publisher tool_publisher_;
  SweepDisplay* display_ = nullptr;

 private:
  sweep_guard::View view_;
  bool posed_ = true;
  QTimer timer_;
};

}  // namespace sweep_guard_rviz
