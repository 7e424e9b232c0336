#pragma once

#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>

#include <functional>

#include "rviz/look.h"

namespace sweep_guard_rviz {

/// The look as properties of a display, one for each part with its colour and alpha below.
class LookProperties {
 public:
  /// @param parent   owns them
  /// @param changed  is called when one of them changes
  LookProperties(rviz::Property& parent, const std::function<void()>& changed);

  Look look() const;

 private:
  struct PartProperties {
    rviz::BoolProperty* shown;
    rviz::ColorProperty* color;
    rviz::FloatProperty* alpha;

    Part part() const;
  };

  struct Default {
    const char* name;
    const char* description;
    QColor color;
    float alpha;
  };
  PartProperties add(const Default& part);

  rviz::Property& parent_;
  std::function<void()> changed_;
  PartProperties surface_;
  rviz::IntProperty* most_edged_;
  PartProperties touched_;
  PartProperties reflex_;
  PartProperties considered_;
  PartProperties measured_;
  rviz::IntProperty* history_;
  PartProperties predicted_;
  PartProperties tool_;
  PartProperties ghosts_;
  rviz::IntProperty* most_ghosts_;
  PartProperties path_;
  PartProperties contacts_;
  rviz::FloatProperty* point_size_;
  PartProperties normals_;
  rviz::FloatProperty* normal_length_;
  PartProperties depths_;
};

}  // namespace sweep_guard_rviz
