#include "rviz/sweep_display.h"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <ros/names.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/ros_topic_property.h>
#include <sweep_guard/Warning.h>

#include <algorithm>
#include <cstdio>
#include <pluginlib/class_list_macros.hpp>
#include <utility>

#include "common/frame_name.h"
#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

using rviz::StatusProperty;

template <typename Message>
rviz::RosTopicProperty* topic(const char* name, const char* value, const char* description, rviz::Property& parent) {
  return new rviz::RosTopicProperty(name, value, ros::message_traits::datatype<Message>(), description, &parent);
}

bool hasPose(const sweep_guard::View& view) { return !view.header.stamp.isZero(); }

std::string problemOf(const sweep_guard::View& view) {
  if (!hasPose(view)) return "the guard has no pose";
  if (view.level != sweep_guard::Warning::UNKNOWN) return "";
  char text[80];
  const double age = (ros::Time::now() - view.header.stamp).toSec();
  std::snprintf(text, sizeof text, "the level is UNKNOWN; the newest pose is %.1f s old", age);
  return text;
}

DisplayStyle styleOf(const sweep_guard::View& view, const DisplayStyle& style) {
  if (view.level == sweep_guard::Warning::UNKNOWN) return style.grayed();
  if (view.level == sweep_guard::Warning::CONTACT && view.held)
    return style.held(std::max(0.0, (ros::Time::now() - view.held_since).toSec()));
  return view.acknowledged ? style.acknowledged() : style;
}

BodyPoses bodiesOf(const sweep_guard::View& view) { return view.bodies.empty() ? BodyPoses{view.pose} : view.bodies; }

std::vector<BodyPoses> pathOf(const sweep_guard::View& view) {
  const size_t count = view.bodies.size();
  const bool articulated = count > 0 && view.body_path.size() == count * view.path.size();
  std::vector<BodyPoses> path;
  for (size_t i = 0; i < view.path.size(); ++i) {
    const auto first = view.body_path.begin() + static_cast<std::ptrdiff_t>(articulated ? i * count : 0);
    path.push_back(articulated ? BodyPoses(first, first + static_cast<std::ptrdiff_t>(count))
                               : BodyPoses{view.path[i]});
  }
  return path;
}

}  // namespace

SweepDisplay::SweepDisplay() {
  addTopics();
  style_ = std::make_unique<StyleProperties>(*this, [this] { stale_ = true; });
}

SweepDisplay::~SweepDisplay() {
  unsubscribe();
  workpieces_.reset();
  way_back_.reset();
  force_.reset();
  path_.reset();
  tool_.reset();
  if (guard_node_ != nullptr) scene_manager_->destroySceneNode(guard_node_);
}

void SweepDisplay::addTopics() {
  view_topic_ =
      topic<sweep_guard::View>("View Topic", "sweep_guard/view", "Tested volumes and results of the guard.", *this);
  tool_topic_ = topic<sweep_guard::ToolShape>("Tool Topic", "sweep_guard/tool", "Shape of the tool.", *this);
  mesh_topic_ = topic<sweep_guard::DeformableMesh>("Mesh Topic", "mesh", "Meshes of the workpieces.", *this);
  vertices_topic_ =
      topic<sweep_guard::MeshVertices>("Vertices Topic", "mesh_vertices", "Deformations of the meshes.", *this);
  intended_topic_ =
      topic<sweep_guard::Intended>("Intended Topic", "sweep_guard/intended", "Where contact is meant.", *this);
  interaction_topic_ = topic<sweep_guard::Interaction>("Interaction Topic", "sweep_guard/interaction",
                                                       "Force of the workpieces on the tool.", *this);
  touches_topic_ =
      topic<sweep_guard::Touches>("Touches Topic", "sweep_guard/touches", "Which triangles were touched.", *this);
  motion_topic_ = topic<sweep_guard::MotionStatus>("Motion Status Topic", "motion_guard/status",
                                                   "Why a motion guard holds the robot back.", *this);
  for (rviz::RosTopicProperty* each : {view_topic_, tool_topic_, mesh_topic_, vertices_topic_, intended_topic_,
                                       interaction_topic_, touches_topic_, motion_topic_}) {
    connect(each, &rviz::Property::changed, this, [this] {
      if (initialized()) reset();
    });
  }
}

void SweepDisplay::setTopic(const QString& topic, const QString& /*datatype*/) {
  const std::string guard = ros::names::parentNamespace(topic.toStdString());
  view_topic_->setString(topic);
  const std::pair<rviz::RosTopicProperty*, const char*> others[] = {{tool_topic_, "tool"},
                                                                    {intended_topic_, "intended"},
                                                                    {interaction_topic_, "interaction"},
                                                                    {touches_topic_, "touches"}};
  for (const auto& [other, name] : others) other->setString(QString::fromStdString(ros::names::append(guard, name)));
}

void SweepDisplay::onInitialize() {
  guard_node_ = scene_node_->createChildSceneNode();
  tool_ = std::make_unique<ToolVisual>(*scene_manager_, *guard_node_);
  path_ = std::make_unique<TipPath>(*scene_manager_, *guard_node_);
  force_ = std::make_unique<ForceVisual>(*scene_manager_, *guard_node_);
  way_back_ = std::make_unique<Drawing>(*scene_manager_, *guard_node_, /*on_top=*/true);
  workpieces_ = std::make_unique<Workpieces>(*scene_manager_, *scene_node_);
}

void SweepDisplay::onEnable() { subscribe(); }

void SweepDisplay::onDisable() {
  unsubscribe();
  reset();
}

void SweepDisplay::subscribe() {
  try {
    subscribers_[0] = update_nh_.subscribe(view_topic_->getTopicStd(), 1, &SweepDisplay::takeView, this);
    subscribers_[1] = update_nh_.subscribe<sweep_guard::ToolShape>(
        tool_topic_->getTopicStd(), 1, [this](const sweep_guard::ToolShape::ConstPtr& shape) {
          tool_->setShape(*shape);
          tool_shape_ = shape;
          stale_ = true;
        });
    subscribers_[2] = update_nh_.subscribe<sweep_guard::DeformableMesh>(
        mesh_topic_->getTopicStd(), kMeshesQueued, [this](const sweep_guard::DeformableMesh::ConstPtr& mesh) {
          workpieces_->take(*mesh);
          stale_ = true;
        });
    subscribers_[3] = update_nh_.subscribe<sweep_guard::MeshVertices>(
        vertices_topic_->getTopicStd(), kMeshesQueued,
        [this](const sweep_guard::MeshVertices::ConstPtr& vertices) { workpieces_->take(vertices); });
    subscribers_[4] = update_nh_.subscribe<sweep_guard::Intended>(
        intended_topic_->getTopicStd(), 1, [this](const sweep_guard::Intended::ConstPtr& intended) {
          workpieces_->take(intended);
          stale_ = true;
        });
    report("Topics", "", "subscribed");
  } catch (const ros::Exception& error) {
    report("Topics", error.what(), "", StatusProperty::Error);
  }
}

void SweepDisplay::subscribeByChoice(const DisplayStyle& style) {
  try {
    force_feed_.listen(style.force.shown ? interaction_topic_->getTopicStd() : "");
    motion_feed_.listen(style.way_back.shown ? motion_topic_->getTopicStd() : "");
  } catch (const ros::Exception& error) {
    report("Topics", error.what(), "", StatusProperty::Error);
  }
  if (style.color_by == ColorBy::kNothing) {
    touches_subscriber_.shutdown();
  } else if (!touches_subscriber_) {
    touches_subscriber_ = update_nh_.subscribe<sweep_guard::Touches>(
        touches_topic_->getTopicStd(), 1, [this](const sweep_guard::Touches::ConstPtr& touches) {
          workpieces_->take(touches);
          stale_ = true;
        });
  }
}

void SweepDisplay::unsubscribe() {
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  force_feed_.listen("");
  motion_feed_.listen("");
  touches_subscriber_.shutdown();
}

void SweepDisplay::reset() {
  rviz::Display::reset();
  reported_.clear();
  view_.reset();
  tool_shape_.reset();
  if (initialized()) {
    force_->clear();
    drawWayBack(DisplayStyle());
    workpieces_->clear();
    path_->clear();
    tool_->setShape({});
  }
  stale_ = true;
  if (!isEnabled()) return;
  unsubscribe();  // to receive latched messages again
  subscribe();
}

void SweepDisplay::takeView(const sweep_guard::View::ConstPtr& view) {
  view_ = view;
  view_received_ = std::chrono::steady_clock::now();
  stale_ = true;
  hasPose(*view) ? path_->add(view->header.stamp, view->pose) : path_->clear();
}

bool SweepDisplay::silent() const { return !view_ || std::chrono::steady_clock::now() - view_received_ > kSilent; }

void SweepDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  workpieces_->deform();
  if (silent() != was_silent_) stale_ = true;
  if (stale_) draw();
  place();
  reportInputs();
}

void SweepDisplay::draw() {
  stale_ = false;
  was_silent_ = silent();
  DisplayStyle style = style_->style();
  subscribeByChoice(style);
  if (was_silent_) style = style.surfaceOnly();
  if (!view_) return workpieces_->draw({}, style);
  style = styleOf(*view_, style);
  workpieces_->draw(view_->objects, style);
  drawTools(style);
  path_->show(view_->path, style.path);
  drawForce(style);
  drawWayBack(style);
}

void SweepDisplay::drawForce(const DisplayStyle& style) {
  const auto interaction = force_feed_.newest();
  if (interaction && style.force.shown && hasPose(*view_)) return force_->show(*interaction, view_->pose, style);
  force_->clear();
}

void SweepDisplay::drawWayBack(const DisplayStyle& style) {
  const auto motion = motion_feed_.newest();
  const bool placed = motion && tool_shape_ && view_ && hasPose(*view_) &&
                      sweep_guard_core::isSameFrame(motion->header.frame_id, view_->header.frame_id);
  const auto from = placed ? heldPoint(*motion, *tool_shape_, bodiesOf(*view_)) : std::nullopt;
  if (from) {
    const Ogre::Vector3 along = style.way_back_length * toOgre(motion->normal);
    way_back_->addArrow(*from, *from + along, 0.06F * style.way_back_length);
  }
  way_back_->paint(style.way_back.color, style.way_back.color);
  way_back_->show();
}

void SweepDisplay::drawTools(const DisplayStyle& style) {
  std::vector<ToolVisual::PlacedTool> places;
  const bool posed = hasPose(*view_);
  if (posed && style.tool.shown) places.push_back({bodiesOf(*view_), style.tool.color});
  if (posed && style.ghosts.shown) {
    const std::vector<BodyPoses> path = pathOf(*view_);
    for (const size_t i : pickGhosts(path, style.max_ghosts, tool_->sizes())) {
      Ogre::ColourValue color = style.ghosts.color;
      color.a *= 1.0F - 0.8F * static_cast<float>(i) / static_cast<float>(path.size());
      places.push_back({path[i], color});
    }
  }
  tool_->show(places);
}

void SweepDisplay::place() {
  std::string problem;
  const auto find = [&](const std::string& frame, Ogre::Vector3& position, Ogre::Quaternion& rotation) {
    const bool found = context_->getFrameManager()->getTransform(frame, ros::Time(), position, rotation);
    if (!found)
      problem += (problem.empty() ? "no transform to " : ", ") + fixed_frame_.toStdString() + " from " + frame;
    return found;
  };
  workpieces_->place(find);
  Ogre::Vector3 position;
  Ogre::Quaternion rotation;
  const bool found = view_ && find(view_->header.frame_id, position, rotation);
  attach(*scene_node_, *guard_node_, found && !was_silent_);
  if (found) {
    guard_node_->setPosition(position);
    guard_node_->setOrientation(rotation);
  }
  report("Frames", problem, "known", StatusProperty::Error);
}

void SweepDisplay::reportInputs() {
  report("View",
         !view_        ? "no view from " + subscribers_[0].getTopic()
         : was_silent_ ? "the guard is silent"
                       : problemOf(*view_),
         "received");
  report("Tool", tool_->hasShape() ? "" : "no tool shape from " + subscribers_[1].getTopic(), "known");
  report("Mesh", workpieces_->problem(subscribers_[2].getTopic()),
         std::to_string(drawnTriangles(SurfaceVisual::kSurface)) + " triangles");
  const std::string legend = workpieces_->legend();
  if (touches_subscriber_) report("Touches", "", legend.empty() ? "none" : legend);
}

void SweepDisplay::report(const std::string& name, const std::string& problem, const std::string& ok_text,
                          StatusProperty::Level severity) {
  const std::string& text = problem.empty() ? ok_text : problem;
  if (std::exchange(reported_[name], text) == text) return;
  setStatusStd(problem.empty() ? StatusProperty::Ok : severity, name, text);
}

size_t SweepDisplay::drawnTriangles(SurfaceVisual::Layer layer) const { return workpieces_->drawnTriangles(layer); }

}  // namespace sweep_guard_rviz

PLUGINLIB_EXPORT_CLASS(sweep_guard_rviz::SweepDisplay, rviz::Display)
