#include "sweep_guard/rviz/sweep_display.h"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/ros_topic_property.h>
#include <sweep_guard/Warning.h>

#include <pluginlib/class_list_macros.hpp>

#include "sweep_guard/rviz/attach.h"

namespace sweep_guard_rviz {
namespace {

using rviz::StatusProperty;

constexpr auto kSilent = std::chrono::milliseconds(500);
constexpr std::uint32_t kVerticesQueued = 10;  // of several workpieces

template <typename Message>
rviz::RosTopicProperty* topic(const char* name, const char* value, const char* description, rviz::Property& parent) {
  return new rviz::RosTopicProperty(name, value, ros::message_traits::datatype<Message>(), description, &parent);
}

}  // namespace

SweepDisplay::SweepDisplay() {
  addTopics();
  look_ = std::make_unique<LookProperties>(*this, [this] { stale_ = true; });
}

SweepDisplay::~SweepDisplay() {
  unsubscribe();
  workpieces_.clear();
  path_.reset();
  tool_.reset();
}

void SweepDisplay::addTopics() {
  view_topic_ = topic<sweep_guard::View>("View Topic", "/sweep_guard/view", "What the guard tests and finds.", *this);
  tool_topic_ = topic<sweep_guard::ToolShape>("Tool Topic", "/sweep_guard/tool", "Shape of its tool.", *this);
  mesh_topic_ = topic<sweep_guard::DeformableMesh>("Mesh Topic", "/mesh", "Workpieces that it guards.", *this);
  vertices_topic_ = topic<sweep_guard::MeshVertices>("Vertices Topic", "/mesh_vertices", "How they deform.", *this);
  for (rviz::RosTopicProperty* each : {view_topic_, tool_topic_, mesh_topic_, vertices_topic_}) {
    connect(each, &rviz::Property::changed, this, [this] {
      if (initialized()) reset();
    });
  }
}

void SweepDisplay::onInitialize() {
  guard_node_ = scene_node_->createChildSceneNode();
  tool_ = std::make_unique<ToolVisual>(*scene_manager_, *guard_node_);
  path_ = std::make_unique<TipPath>(*scene_manager_, *guard_node_);
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
          stale_ = true;
        });
    subscribers_[2] = update_nh_.subscribe<sweep_guard::DeformableMesh>(
        mesh_topic_->getTopicStd(), kVerticesQueued,
        [this](const sweep_guard::DeformableMesh::ConstPtr& mesh) { takeMesh(*mesh); });
    subscribers_[3] =
        update_nh_.subscribe(vertices_topic_->getTopicStd(), kVerticesQueued, &SweepDisplay::takeVertices, this);
    tell(StatusProperty::Ok, "Topics", "subscribed");
  } catch (const ros::Exception& error) {
    tell(StatusProperty::Error, "Topics", error.what());
  }
}

void SweepDisplay::unsubscribe() {
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
}

void SweepDisplay::reset() {
  rviz::Display::reset();
  told_.clear();
  wrong_.clear();
  workpieces_.clear();
  vertices_.clear();
  view_.reset();
  if (path_) path_->clear();
  if (tool_) tool_->show({});
  stale_ = true;
  if (!isEnabled()) return;
  unsubscribe();  // what is latched is to come again
  subscribe();
}

WorkpieceVisual& SweepDisplay::workpiece(const std::string& id) {
  std::unique_ptr<WorkpieceVisual>& visual = workpieces_[id];
  if (!visual) visual = std::make_unique<WorkpieceVisual>(*scene_manager_, *scene_node_);
  return *visual;
}

void SweepDisplay::takeMesh(const sweep_guard::DeformableMesh& mesh) {
  vertices_.erase(mesh.id);
  wrong_.erase(mesh.id);
  stale_ = true;
  if (mesh.mesh.vertices.empty() && mesh.mesh.triangles.empty()) {
    workpieces_.erase(mesh.id);
    return;
  }
  const std::string wrong = workpiece(mesh.id).setMesh(mesh);
  if (!wrong.empty()) wrong_[mesh.id] = wrong;
}

void SweepDisplay::takeVertices(const sweep_guard::MeshVertices::ConstPtr& vertices) {
  vertices_[vertices->id] = vertices;
}

void SweepDisplay::takeView(const sweep_guard::View::ConstPtr& view) {
  view_ = view;
  seen_ = std::chrono::steady_clock::now();
  stale_ = true;
  path_->add(view->header.stamp, view->pose);
}

bool SweepDisplay::silent() const { return !view_ || std::chrono::steady_clock::now() - seen_ > kSilent; }

void SweepDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  deform();
  if (silent() != was_silent_) stale_ = true;
  if (stale_) draw();
  place();
  tellMeshes();
}

void SweepDisplay::deform() {
  for (const auto& [id, vertices] : vertices_) {
    const std::string wrong = workpiece(id).setVertices(*vertices);
    wrong.empty() ? static_cast<void>(wrong_.erase(id)) : static_cast<void>(wrong_[id] = wrong);
  }
  vertices_.clear();
}

void SweepDisplay::draw() {
  stale_ = false;
  was_silent_ = silent();
  Look look = look_->look();
  if (was_silent_) look = look.surfaceOnly();
  if (view_ && view_->level == sweep_guard::Warning::UNKNOWN) look = look.greyed();
  drawWorkpieces(look);
  if (view_) {
    drawTools(look);
    path_->show(view_->path, look.path);
  }
  tell(was_silent_ ? StatusProperty::Warn : StatusProperty::Ok, "View",
       !view_        ? "none has come from " + view_topic_->getTopicStd()
       : was_silent_ ? "the guard is silent"
                     : "comes");
}

// Of what the guard no longer speaks of, only the surface is drawn; what has none is gone.
void SweepDisplay::drawWorkpieces(const Look& look) {
  std::map<std::string, const sweep_guard::ObjectView*> views;
  if (view_) {
    for (const sweep_guard::ObjectView& object : view_->objects) views[object.mesh_id] = &object;
  }
  for (const auto& [id, view] : views) workpiece(id);
  for (auto each = workpieces_.begin(); each != workpieces_.end();) {
    const auto& [id, visual] = *each;
    const auto view = views.find(id);
    const bool spoken_of = view != views.end();
    if (!spoken_of && !visual->hasMesh()) {
      each = workpieces_.erase(each);
      continue;
    }
    visual->paint(look);
    visual->show(spoken_of ? *view->second : sweep_guard::ObjectView(), look);
    ++each;
  }
}

void SweepDisplay::drawTools(const Look& look) {
  std::vector<ToolVisual::Placed> places;
  if (look.tool.shown) places.push_back({view_->pose, look.tool.color});
  if (look.ghosts.shown) {
    const std::vector<size_t> ghosts =
        pickGhosts(view_->path, static_cast<size_t>(look.most_ghosts), tool_->reach(), 0.5 * tool_->thickness());
    for (const size_t i : ghosts) {
      Ogre::ColourValue color = look.ghosts.color;
      color.a *= 1.0F - 0.8F * static_cast<float>(i) / static_cast<float>(view_->path.size());
      places.push_back({view_->path[i], color});
    }
  }
  tool_->show(places);
  tell(tool_->hasShape() ? StatusProperty::Ok : StatusProperty::Warn, "Tool",
       tool_->hasShape() ? "known" : "no shape has come from " + tool_topic_->getTopicStd());
}

void SweepDisplay::place() {
  std::string unknown;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  const auto find = [&](const std::string& frame) {
    const bool found = context_->getFrameManager()->getTransform(frame, ros::Time(), position, orientation);
    if (!found)
      unknown += (unknown.empty() ? "no transform to " : ", ") + fixed_frame_.toStdString() + " from " + frame;
    return found;
  };
  for (const auto& [id, visual] : workpieces_) {
    const bool found = !visual->frame().empty() && find(visual->frame());
    visual->setVisible(found);
    if (found) visual->place(position, orientation);
  }
  const bool found = view_ && find(view_->header.frame_id);
  attach(*scene_node_, *guard_node_, found && !was_silent_);
  if (found) {
    guard_node_->setPosition(position);
    guard_node_->setOrientation(orientation);
  }
  tell(unknown.empty() ? StatusProperty::Ok : StatusProperty::Error, "Frames", unknown.empty() ? "known" : unknown);
}

void SweepDisplay::tellMeshes() {
  std::string missing;
  size_t triangles = 0;
  for (const auto& [id, visual] : workpieces_) {
    if (!visual->hasMesh()) missing = "'" + id + "' has not come from " + mesh_topic_->getTopicStd();
    triangles += visual->drawnTriangles(SurfaceVisual::kSurface);
  }
  if (workpieces_.empty()) missing = "none has come from " + mesh_topic_->getTopicStd();
  if (!wrong_.empty()) missing = "'" + wrong_.begin()->first + "': " + wrong_.begin()->second;
  tell(missing.empty() ? StatusProperty::Ok : StatusProperty::Warn, "Mesh",
       missing.empty() ? std::to_string(triangles) + " triangles" : missing);
}

void SweepDisplay::tell(StatusProperty::Level level, const std::string& name, const std::string& text) {
  if (std::exchange(told_[name], text) != text) setStatusStd(level, name, text);
}

size_t SweepDisplay::drawnTriangles(SurfaceVisual::Layer layer) const {
  size_t count = 0;
  for (const auto& [id, visual] : workpieces_) count += visual->drawnTriangles(layer);
  return count;
}

}  // namespace sweep_guard_rviz

PLUGINLIB_EXPORT_CLASS(sweep_guard_rviz::SweepDisplay, rviz::Display)
