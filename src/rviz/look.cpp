#include "rviz/look.h"

namespace sweep_guard_rviz {
namespace {

constexpr Part Look::*kOfTheGuard[] = {&Look::touched,   &Look::reflex,  &Look::considered, &Look::measured,
                                       &Look::predicted, &Look::tool,    &Look::ghosts,     &Look::path,
                                       &Look::contacts,  &Look::normals, &Look::depths};

}  // namespace

Look Look::greyed() const {
  Look look = *this;
  for (Part Look::*part : kOfTheGuard) {
    const float alpha = (look.*part).color.a;
    (look.*part).color = Ogre::ColourValue(0.55F, 0.55F, 0.55F, alpha);
  }
  return look;
}

Look Look::surfaceOnly() const {
  Look look = *this;
  for (Part Look::*part : kOfTheGuard) (look.*part).shown = false;
  return look;
}

}  // namespace sweep_guard_rviz
