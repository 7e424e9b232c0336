#include "rviz/style_properties.h"

namespace sweep_guard_rviz {

StyleProperties::StyleProperties(rviz::Property& parent, const std::function<void()>& changed)
    : parent_(parent), changed_(changed) {
  auto* const surface = add(&DisplayStyle::surface, "Workpiece", "The deforming surfaces.", {214, 205, 188}, 1.0F);
  add(&DisplayStyle::touched, "Touched", "Triangles that the tool touches.", {235, 20, 20}, 1.0F);
  add(&DisplayStyle::reflex, "Reflex", "Triangles that the tool will touch within the reflex interval.", {255, 70, 50},
      0.9F);
  add(&DisplayStyle::considered, "Considered", "Triangles that the tool will touch later.", {255, 176, 0}, 0.9F);
  add(&DisplayStyle::intended, "Intended", "Triangles that the tool is meant to touch.", {40, 170, 70}, 0.5F);
  add(&DisplayStyle::allowed, "Allowed", "Triangles that links touch which may (tool/allowed).", {100, 140, 165}, 0.6F);
  auto* const measured = add(&DisplayStyle::measured, "Measured sweep",
                             "Swept boxes with their clipping planes, up to the newest pose.", {0, 205, 230}, 0.2F);
  add(&DisplayStyle::predicted, "Predicted sweeps", "Swept boxes with their clipping planes along the predicted path.",
      {140, 190, 255}, 0.03F);
  add(&DisplayStyle::tool, "Tool", "The tool at its newest measured pose.", {90, 128, 230}, 1.0F);
  auto* const ghosts =
      add(&DisplayStyle::ghosts, "Ghosts", "The tool at predicted poses, fading with time.", {115, 165, 255}, 0.35F);
  add(&DisplayStyle::path, "Path", "Path of the tip, measured (the last 2 s) and predicted.", {235, 235, 235}, 0.9F);
  auto* const contacts =
      add(&DisplayStyle::contacts, "Contacts", "First contact point of each triangle.", {255, 240, 90}, 1.0F);
  auto* const normals =
      add(&DisplayStyle::normals, "Normals", "Contact normals, pointing out of the workpiece.", {255, 240, 90}, 1.0F);
  add(&DisplayStyle::depths, "Depths", "Contact depths, into the workpiece; the largest also as text.", {235, 20, 20},
      1.0F);
  auto* const force =
      add(&DisplayStyle::force, "Force",
          "Force of a workpiece on the tool, with volume and depth as text; the guard computes it while this is on.",
          {190, 90, 255}, 1.0F, false);
  auto* const way_back =
      add(&DisplayStyle::way_back, "Way back", "From where a motion guard holds the robot back.", {235, 0, 170}, 1.0F);
  max_edged_ = new rviz::IntProperty(
      "Edges Up To", 5000, "Edges are drawn for surfaces with at most this many triangles; lines are slow.", surface);
  max_edged_->setMin(0);
  color_by_ =
      new rviz::EnumProperty("Color By", "Nothing",
                             "Colors the triangles that were touched by the number of sweeps that touched them, "
                             "or by the largest depth: since the workpiece came, or since ~reset_touches.",
                             surface);
  color_by_->addOption("Nothing", static_cast<int>(ColorBy::kNothing));
  color_by_->addOption("Touches", static_cast<int>(ColorBy::kTouches));
  color_by_->addOption("Largest Depth", static_cast<int>(ColorBy::kDepth));
  history_ =
      new rviz::IntProperty("History", 0, "Number of earlier boxes kept, at least half a box width apart.", measured);
  history_->setMin(0);
  history_->setMax(1000);
  max_ghosts_ = new rviz::IntProperty("Number", 8, "Largest number of ghosts.", ghosts);
  max_ghosts_->setMin(1);
  max_ghosts_->setMax(50);
  point_size_ = new rviz::FloatProperty("Point Size", 0.003F, "[m]; normals and depths are half as thick.", contacts);
  point_size_->setMin(1e-5F);
  normal_length_ = new rviz::FloatProperty("Length", 0.02F, "[m]", normals);
  normal_length_->setMin(1e-5F);
  force_length_ = new rviz::FloatProperty("Length", 0.03F, "[m/N]", force);
  force_length_->setMin(1e-6F);
  way_back_length_ = new rviz::FloatProperty("Length", 0.1F, "[m]", way_back);
  way_back_length_->setMin(1e-5F);
  for (rviz::Property* property :
       {static_cast<rviz::Property*>(max_edged_), static_cast<rviz::Property*>(history_),
        static_cast<rviz::Property*>(max_ghosts_), static_cast<rviz::Property*>(point_size_),
        static_cast<rviz::Property*>(normal_length_), static_cast<rviz::Property*>(color_by_),
        static_cast<rviz::Property*>(force_length_), static_cast<rviz::Property*>(way_back_length_)}) {
    QObject::connect(property, &rviz::Property::changed, &parent_, changed_);
  }
}

rviz::BoolProperty* StyleProperties::add(ElementStyle DisplayStyle::*element, const char* name, const char* description,
                                         const QColor& color, float alpha, bool shown) {
  ElementProperties& properties = elements_.emplace_back();
  properties.element = element;
  properties.shown = new rviz::BoolProperty(name, shown, description, &parent_);
  properties.color = new rviz::ColorProperty("Color", color, "", properties.shown);
  properties.alpha = new rviz::FloatProperty("Alpha", alpha, "0 is transparent, 1 opaque.", properties.shown);
  properties.alpha->setMin(0.0F);
  properties.alpha->setMax(1.0F);
  QObject::connect(properties.shown, &rviz::Property::changed, &parent_, changed_);
  QObject::connect(properties.color, &rviz::Property::changed, &parent_, changed_);
  QObject::connect(properties.alpha, &rviz::Property::changed, &parent_, changed_);
  return properties.shown;
}

DisplayStyle StyleProperties::style() const {
  DisplayStyle style;
  for (const ElementProperties& properties : elements_) {
    ElementStyle& element = style.*properties.element;
    element.shown = properties.shown->getBool();
    element.color = properties.color->getOgreColor();
    element.color.a = properties.alpha->getFloat();
  }
  style.max_edged = static_cast<size_t>(max_edged_->getInt());
  style.history = static_cast<size_t>(history_->getInt());
  style.max_ghosts = static_cast<size_t>(max_ghosts_->getInt());
  style.point_size = point_size_->getFloat();
  style.normal_length = normal_length_->getFloat();
  style.force_length = force_length_->getFloat();
  style.way_back_length = way_back_length_->getFloat();
  style.color_by = static_cast<ColorBy>(color_by_->getOptionInt());
  return style;
}

}  // namespace sweep_guard_rviz
