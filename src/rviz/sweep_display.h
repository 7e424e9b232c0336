#pragma once

#include <ros/subscriber.h>
#include <rviz/display.h>
#include <sweep_guard/View.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "rviz/drawing.h"
#include "rviz/feeds.h"
#include "rviz/force_visual.h"
#include "rviz/style_properties.h"
#include "rviz/tip_path.h"
#include "rviz/tool_visual.h"
#include "rviz/workpieces.h"

namespace rviz {
class RosTopicProperty;
}

namespace sweep_guard_rviz {

/// Draws the deforming workpieces together with the content of a guard's `~view`. Draws only the workpieces when no
/// `~view` has arrived for 0.5 s, and no tool while its pose is not known. Optionally draws the force on the tool and
/// colors the touched triangles. While a motion guard holds the robot back, draws an arrow from where it does, the way back.
/// Subscribes to nothing while it is disabled.
class SweepDisplay : public rviz::Display {
 public:
  SweepDisplay();
  ~SweepDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  /// Selects the guard that publishes this `~view`, and its other topics.
  void setTopic(const QString& topic, const QString& datatype) override;

  /// Returns the number of triangles that a layer shows, of all workpieces.
  size_t drawnTriangles(SurfaceVisual::Layer layer) const;
  size_t drawnForces() const { return force_ ? force_->shown() : 0; }  ///< number of arrows
  size_t drawnTools() const { return tool_ ? tool_->shown() : 0; }     ///< number of drawn tools, ghosts included

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;

  void addTopics();
  void subscribe();
  void unsubscribe();
  void takeView(const sweep_guard::View::ConstPtr& view);
  void subscribeByChoice(const DisplayStyle& style);

  void draw();
  void drawTools(const DisplayStyle& style);
  void drawForce(const DisplayStyle& style);
  void drawWayBack(const DisplayStyle& style);
  void place();
  void reportInputs();
  /// Sets one line of the status.
  /// @param problem  empty: none, and the line shows `ok_text`
  void report(const std::string& name, const std::string& problem, const std::string& ok_text,
              rviz::StatusProperty::Level severity = rviz::StatusProperty::Warn);
  bool silent() const;

  rviz::RosTopicProperty* view_topic_ = nullptr;
  rviz::RosTopicProperty* tool_topic_ = nullptr;
  rviz::RosTopicProperty* mesh_topic_ = nullptr;
  rviz::RosTopicProperty* vertices_topic_ = nullptr;
  rviz::RosTopicProperty* intended_topic_ = nullptr;
  rviz::RosTopicProperty* interaction_topic_ = nullptr;
  rviz::RosTopicProperty* touches_topic_ = nullptr;
  rviz::RosTopicProperty* motion_topic_ = nullptr;
  std::unique_ptr<StyleProperties> style_;

  Ogre::SceneNode* guard_node_ = nullptr;  // at the fixed frame of the guard
  std::unique_ptr<ToolVisual> tool_;
  std::unique_ptr<TipPath> path_;
  std::unique_ptr<ForceVisual> force_;
  std::unique_ptr<Drawing> way_back_;
  std::unique_ptr<Workpieces> workpieces_;

  ros::Subscriber subscribers_[5];
  NewestFeed<sweep_guard::Interaction> force_feed_;  // these only while they are shown
  NewestFeed<sweep_guard::MotionStatus> motion_feed_;
  ros::Subscriber touches_subscriber_;
  sweep_guard::ToolShape::ConstPtr tool_shape_;
  sweep_guard::View::ConstPtr view_;
  SteadyTime view_received_;
  bool was_silent_ = true;
  bool stale_ = true;  // the drawing is out of date
  std::map<std::string, std::string> reported_;
};

}  // namespace sweep_guard_rviz
