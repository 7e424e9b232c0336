#pragma once

#include <ros/subscriber.h>
#include <rviz/display.h>
#include <sweep_guard/View.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "rviz/look_properties.h"
#include "rviz/tip_path.h"
#include "rviz/tool_visual.h"
#include "rviz/workpieces.h"

namespace rviz {
class RosTopicProperty;
}

namespace sweep_guard_rviz {

/// Draws the workpieces as they deform, with what the guard tests and finds: `~view` on the meshes that it is fed with.
/// Without `~view` for half a second, the workpieces alone; no tool while its pose is not known. Nothing is subscribed
/// to while it is disabled.
class SweepDisplay : public rviz::Display {
 public:
  SweepDisplay();
  ~SweepDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  /// The `~view` of a guard, and the `~tool` beside it.
  void setTopic(const QString& topic, const QString& datatype) override;

  /// Triangles that are drawn in a layer, of all workpieces.
  size_t drawnTriangles(SurfaceVisual::Layer layer) const;
  size_t drawnTools() const { return tool_ ? tool_->shown() : 0; }  ///< the tool and its ghosts

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

  void draw();
  void drawTools(const Look& look);
  void place();
  void tellInputs();
  /// One line of the status. @param wrong  empty: nothing is, which `fine` says then
  void tell(const std::string& name, const std::string& wrong, const std::string& fine,
            rviz::StatusProperty::Level if_wrong = rviz::StatusProperty::Warn);
  bool silent() const;

  rviz::RosTopicProperty* view_topic_ = nullptr;
  rviz::RosTopicProperty* tool_topic_ = nullptr;
  rviz::RosTopicProperty* mesh_topic_ = nullptr;
  rviz::RosTopicProperty* vertices_topic_ = nullptr;
  std::unique_ptr<LookProperties> look_;

  Ogre::SceneNode* guard_node_ = nullptr;  // of the fixed frame of the guard
  std::unique_ptr<ToolVisual> tool_;
  std::unique_ptr<TipPath> path_;
  std::unique_ptr<Workpieces> workpieces_;

  ros::Subscriber subscribers_[4];
  sweep_guard::View::ConstPtr view_;
  SteadyTime seen_;
  bool was_silent_ = true;
  bool stale_ = true;  // what is drawn is not what is known
  std::map<std::string, std::string> told_;
};

}  // namespace sweep_guard_rviz
