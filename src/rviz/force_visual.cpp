#include "rviz/force_visual.h"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include <utility>

#include "rviz/feeds.h"
#include "rviz/ogre_conversions.h"

namespace sweep_guard_rviz {
namespace {

constexpr float kThickness = 0.04F;  // of the length
constexpr float kText = 0.006F;      // height of a letter [m]

}  // namespace

ForceVisual::ForceVisual(Ogre::SceneManager& scene, Ogre::SceneNode& node)
    : scene_(scene), node_(node), arrows_(scene, node, /*on_top=*/true) {}

ForceVisual::~ForceVisual() {
  for (const auto& label : labels_) {
    Ogre::SceneNode* const node = label->getParentSceneNode();
    node->detachAllObjects();
    scene_.destroySceneNode(node);
  }
}

void ForceVisual::show(const sweep_guard::Interaction& interaction, const geometry_msgs::Pose& tool,
                       const DisplayStyle& style) {
  const Ogre::Quaternion rotation = toOgre(tool.orientation);
  shown_ = 0;
  for (const sweep_guard::ObjectInteraction& object : interaction.objects) {
    const Ogre::Vector3 from = toOgre(tool.position) + rotation * toOgre(object.centroid);
    const Ogre::Vector3 along = style.force_length * (rotation * toOgre(object.wrench.force));
    if (along.isZeroLength()) continue;
    arrows_.addArrow(from, from + along, kThickness * along.length());
    label(describe(object), from + along, style);
  }
  for (size_t i = shown_; i < labels_.size(); ++i) labels_[i]->getParentSceneNode()->setVisible(false);
  arrows_.paint(style.force.color, style.force.color);
  arrows_.show();
}

void ForceVisual::clear() { show({}, {}, DisplayStyle()); }

void ForceVisual::addLabel() {
  auto label = std::make_unique<rviz::MovableText>("-");
  label->showOnTop(true);
  label->setTextAlignment(rviz::MovableText::H_LEFT, rviz::MovableText::V_ABOVE);
  node_.createChildSceneNode()->attachObject(label.get());
  labels_.push_back(std::move(label));
}

void ForceVisual::label(const std::string& text, const Ogre::Vector3& place, const DisplayStyle& style) {
  if (shown_ == labels_.size()) addLabel();
  rviz::MovableText& label = *labels_[shown_++];
  label.setCaption(text);
  label.setCharacterHeight(kText);
  label.setColor(style.force.color);
  label.getParentSceneNode()->setPosition(place);
  label.getParentSceneNode()->setVisible(true);
}

}  // namespace sweep_guard_rviz
