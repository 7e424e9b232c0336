#pragma once

#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>

#include <functional>
#include <vector>

#include "rviz/display_style.h"

namespace sweep_guard_rviz {

/// Offers the style as properties of a display: a switch for each element, with its color and alpha as children.
class StyleProperties {
 public:
  /// @param parent   owns the properties
  /// @param changed  is called when a property changes
  StyleProperties(rviz::Property& parent, const std::function<void()>& changed);

  DisplayStyle style() const;

 private:
  struct ElementProperties {
    ElementStyle DisplayStyle::*element;
    rviz::BoolProperty* shown;
    rviz::ColorProperty* color;
    rviz::FloatProperty* alpha;
  };

  /// Returns the switch.
  rviz::BoolProperty* add(ElementStyle DisplayStyle::*element, const char* name, const char* description,
                          const QColor& color, float alpha, bool shown = true);

  rviz::Property& parent_;
  std::function<void()> changed_;
  std::vector<ElementProperties> elements_;
  rviz::IntProperty* max_edged_;
  rviz::EnumProperty* color_by_;
  rviz::IntProperty* history_;
  rviz::IntProperty* max_ghosts_;
  rviz::FloatProperty* point_size_;
  rviz::FloatProperty* normal_length_;
  rviz::FloatProperty* force_length_;
  rviz::FloatProperty* way_back_length_;
};

}  // namespace sweep_guard_rviz
