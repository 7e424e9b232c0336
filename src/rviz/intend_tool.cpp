#include "rviz/intend_tool.h"

#include <OgreCamera.h>
#include <OgreViewport.h>
#include <ros/message_traits.h>
#include <ros/names.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>
#include <rviz/viewport_mouse_event.h>

#include <QRegularExpression>
#include <pluginlib/class_list_macros.hpp>

#include "rviz/ogre_conversions.h"
#include "rviz/workpieces.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_rviz {
namespace {

constexpr float kStep = 0.5F;  // of the radius, between the balls of a stroke

template <typename Message>
rviz::RosTopicProperty* topicProperty(const char* name, const char* value, const char* description,
                                      rviz::Property* parent) {
  return new rviz::RosTopicProperty(name, value, ros::message_traits::datatype<Message>(), description, parent);
}

rviz::FloatProperty* length(const char* name, float value, const char* description, rviz::Property* parent) {
  auto* const property = new rviz::FloatProperty(name, value, description, parent);
  property->setMin(0.0F);
  return property;
}

}  // namespace

IntendTool::IntendTool() {
  shortcut_key_ = 'u';
  rviz::Property* const parent = getPropertyContainer();
  guard_ = new rviz::StringProperty("Guard", "sweep_guard", "Name of the guard's node.", parent);
  mesh_topic_ = topicProperty<sweep_guard::DeformableMesh>("Mesh Topic", "mesh", "Meshes of the workpieces.", parent);
  vertices_topic_ = topicProperty<sweep_guard::MeshVertices>("Vertices Topic", "mesh_vertices",
                                                             "Deformations of the meshes.", parent);
  radius_ = length("Radius", 0.005F, "[m] of the brush: triangles that lie wholly inside are meant.", parent);
  depth_ = length("Depth", 0.01F, "[m] that the tool may reach behind the surface.", parent);
  links_ = new rviz::StringProperty("Tool Links", "", "Links that may touch, separated by blanks; empty: all.", parent);
  duration_ = length("Duration", 0.0F, "[s]; 0: until it is taken back.", parent);
}

void IntendTool::onInitialize() { setName("Intend"); }

std::string IntendTool::guardTopic(const std::string& name) const {
  return ros::names::append(guard_->getStdString(), name);
}

void IntendTool::activate() {
  painted_.reset();
  try {
    publisher_ = node_.advertise<sweep_guard::Intend>(guardTopic("intend_updates"), 100);
    subscribers_[0] = node_.subscribe<sweep_guard::DeformableMesh>(
        mesh_topic_->getTopicStd(), kMeshesQueued,
        [this](const sweep_guard::DeformableMesh::ConstPtr& mesh) { picker_.take(mesh); });
    subscribers_[1] = node_.subscribe<sweep_guard::MeshVertices>(
        vertices_topic_->getTopicStd(), kMeshesQueued,
        [this](const sweep_guard::MeshVertices::ConstPtr& vertices) { picker_.take(vertices); });
    subscribers_[2] = node_.subscribe<sweep_guard::Intended>(
        guardTopic("intended"), 1, [this](const sweep_guard::Intended::ConstPtr& intended) { showState(*intended); });
    setStatus("<b>Left-Click:</b> Paint where contact is meant. <b>Shift or Right-Click:</b> Take it back.");
  } catch (const ros::Exception& error) {
    setStatus(QString::fromStdString(error.what()));
  }
}

void IntendTool::deactivate() {
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  publisher_.shutdown();
  picker_.clear();
}

void IntendTool::showState(const sweep_guard::Intended& intended) {
  if (!intended.refusal.empty()) {
    return setStatus(QString::fromStdString("refused: " + sweep_guard_core::printable(intended.refusal, 500)));
  }
  size_t triangles = 0;
  for (const sweep_guard::Intention& intention : intended.intentions) triangles += intention.triangles.size();
  setStatus(QString("contact is meant on %1 triangles").arg(triangles));
}

int IntendTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  if (event.leftUp()) painted_.reset();
  const bool takes_back = event.rightDown() || (event.leftDown() && event.shift());
  const bool paints = event.left() && !event.shift();
  if (!takes_back && !paints) return 0;
  const auto picked = pick(event);
  if (!picked) {
    setStatus("no workpiece under the mouse");
    return 0;
  }
  if (takes_back) {
    takeBack(picked->mesh_id);
  } else {
    paint(*picked);
  }
  return Render;
}

std::optional<sweep_guard::Intend> IntendTool::pick(rviz::ViewportMouseEvent& event) const {
  const auto width = static_cast<float>(event.viewport->getActualWidth());
  const auto height = static_cast<float>(event.viewport->getActualHeight());
  const Ogre::Ray ray = event.viewport->getCamera()->getCameraToViewportRay(static_cast<float>(event.x) / width,
                                                                            static_cast<float>(event.y) / height);
  return picker_.pick(ray, [this](const std::string& frame, Ogre::Vector3& position, Ogre::Quaternion& rotation) {
    return context_->getFrameManager()->getTransform(frame, ros::Time(), position, rotation);
  });
}

void IntendTool::paint(sweep_guard::Intend intend) {
  const bool near = painted_ && painted_->mesh_id == intend.mesh_id &&
                    (toOgre(painted_->center) - toOgre(intend.center)).length() < kStep * radius_->getFloat();
  if (near) return;
  painted_ = intend;
  intend.radius = static_cast<double>(radius_->getFloat());
  intend.depth = static_cast<double>(depth_->getFloat());
  for (const QString& link : links_->getString().split(QRegularExpression("[\\s,]+"))) {
    if (!link.isEmpty()) intend.tool_links.push_back(link.toStdString());
  }
  intend.duration = ros::Duration(static_cast<double>(duration_->getFloat()));
  publisher_.publish(intend);
}

void IntendTool::takeBack(const std::string& mesh_id) {
  painted_.reset();
  sweep_guard::Intend intend;
  intend.mesh_id = mesh_id;
  publisher_.publish(intend);
}

}  // namespace sweep_guard_rviz

PLUGINLIB_EXPORT_CLASS(sweep_guard_rviz::IntendTool, rviz::Tool)
