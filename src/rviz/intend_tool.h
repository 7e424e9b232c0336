#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <rviz/tool.h>
#include <sweep_guard/Intend.h>
#include <sweep_guard/Intended.h>

#include <optional>
#include <string>

#include "rviz/surface_picker.h"

namespace rviz {
class FloatProperty;
class RosTopicProperty;
class StringProperty;
}  // namespace rviz

namespace sweep_guard_rviz {

/// Paints where the tool is meant to touch a workpiece: a click or a stroke with the left button sends balls on the
/// surface to a guard's `~intend_updates`. With Shift, or with the right button, takes back what is intended with the
/// workpiece under the mouse. Subscribes to nothing while it is not active.
class IntendTool : public rviz::Tool {
 public:
  IntendTool();

  void activate() override;
  void deactivate() override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

 protected:
  void onInitialize() override;

 private:
  std::optional<sweep_guard::Intend> pick(rviz::ViewportMouseEvent& event) const;
  void paint(sweep_guard::Intend intend);
  void takeBack(const std::string& mesh_id);
  void showState(const sweep_guard::Intended& intended);
  std::string guardTopic(const std::string& name) const;

  rviz::StringProperty* guard_;
  rviz::RosTopicProperty* mesh_topic_;
  rviz::RosTopicProperty* vertices_topic_;
  rviz::FloatProperty* radius_;
  rviz::FloatProperty* depth_;
  rviz::StringProperty* links_;
  rviz::FloatProperty* duration_;

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber subscribers_[3];
  SurfacePicker picker_;
  std::optional<sweep_guard::Intend> painted_;  // last one of a stroke
};

}  // namespace sweep_guard_rviz
