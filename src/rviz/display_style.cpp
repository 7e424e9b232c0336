#include "rviz/display_style.h"

namespace sweep_guard_rviz {
namespace {

constexpr ElementStyle DisplayStyle::*kGuardElements[] = {
    &DisplayStyle::touched,   &DisplayStyle::reflex,  &DisplayStyle::considered, &DisplayStyle::measured,
    &DisplayStyle::predicted, &DisplayStyle::tool,    &DisplayStyle::ghosts,     &DisplayStyle::path,
    &DisplayStyle::contacts,  &DisplayStyle::normals, &DisplayStyle::depths,     &DisplayStyle::intended,
    &DisplayStyle::allowed,   &DisplayStyle::force,   &DisplayStyle::way_back};

constexpr float kPale = 0.3F;  // of the opacity

}  // namespace

DisplayStyle DisplayStyle::held(double seconds) const {
  DisplayStyle style = *this;
  for (ElementStyle* const element : {&style.touched, &style.contacts, &style.normals}) element->color.a *= kPale;
  style.since_contact = seconds;
  return style;
}

DisplayStyle DisplayStyle::acknowledged() const {
  DisplayStyle style = *this;
  style.considered.color.a *= kPale;
  return style;
}

DisplayStyle DisplayStyle::grayed() const {
  DisplayStyle style = *this;
  for (ElementStyle DisplayStyle::*element : kGuardElements) {
    const float alpha = (style.*element).color.a;
    (style.*element).color = Ogre::ColourValue(0.55F, 0.55F, 0.55F, alpha);
  }
  return style;
}

DisplayStyle DisplayStyle::surfaceOnly() const {
  DisplayStyle style = *this;
  for (ElementStyle DisplayStyle::*element : kGuardElements) (style.*element).shown = false;
  return style;
}

}  // namespace sweep_guard_rviz
