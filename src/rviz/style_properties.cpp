#include "rviz/style_properties.h"

namespace sweep_guard_rviz {

ElementStyle StyleProperties::ElementProperties::style() const {
  ElementStyle style;
  style.shown = shown->getBool();
  style.color = color->getOgreColor();
  style.color.a = alpha->getFloat();
  return style;
}

StyleProperties::StyleProperties(rviz::Property& parent, const std::function<void()>& changed)
    : parent_(parent),
      changed_(changed),
      surface_(add("Workpiece", "The deforming surfaces.", {214, 205, 188}, 1.0F)),
      touched_(add("Touched", "Triangles that the tool touches.", {235, 20, 20}, 1.0F)),
      reflex_(add("Reflex", "Triangles that the tool will touch within the reflex interval.", {255, 70, 50}, 0.9F)),
      considered_(add("Considered", "Triangles that the tool will touch later.", {255, 176, 0}, 0.9F)),
      intended_(add("Intended", "Triangles that the tool is meant to touch.", {40, 170, 70}, 0.5F)),
      allowed_(add("Allowed", "Triangles that links touch which may (tool/allowed).", {100, 140, 165}, 0.6F)),
      measured_(
          add("Measured sweep", "Swept boxes with their clipping planes, up to the newest pose.", {0, 205, 230}, 0.2F)),
      predicted_(add("Predicted sweeps", "Swept boxes with their clipping planes along the predicted path.",
                     {140, 190, 255}, 0.03F)),
      tool_(add("Tool", "The tool at its newest measured pose.", {90, 128, 230}, 1.0F)),
      ghosts_(add("Ghosts", "The tool at predicted poses, fading with time.", {115, 165, 255}, 0.35F)),
      path_(add("Path", "Path of the tip, measured (the last 2 s) and predicted.", {235, 235, 235}, 0.9F)),
      contacts_(add("Contacts", "First contact point of each triangle.", {255, 240, 90}, 1.0F)),
      normals_(add("Normals", "Contact normals, pointing out of the workpiece.", {255, 240, 90}, 1.0F)),
      depths_(add("Depths", "Contact depths, into the workpiece; the largest also as text.", {235, 20, 20}, 1.0F)),
      force_(add(
          "Force",
          "Force of a workpiece on the tool, with volume and depth as text; the guard computes it while this is on.",
          {190, 90, 255}, 1.0F, false)) {
  max_edged_ = new rviz::IntProperty("Edges Up To", 5000,
                                     "Edges are drawn for surfaces with at most this many triangles; lines are slow.",
                                     surface_.shown);
  max_edged_->setMin(0);
  color_by_ =
      new rviz::EnumProperty("Color By", "Nothing",
                             "Colors the triangles that were touched by the number of sweeps that touched them, "
                             "or by the largest depth: since the workpiece came, or since ~reset_touches.",
                             surface_.shown);
  color_by_->addOption("Nothing", static_cast<int>(ColorBy::kNothing));
  color_by_->addOption("Touches", static_cast<int>(ColorBy::kTouches));
  color_by_->addOption("Largest Depth", static_cast<int>(ColorBy::kDepth));
  history_ = new rviz::IntProperty("History", 0, "Number of earlier boxes kept, at least half a box width apart.",
                                   measured_.shown);
  history_->setMin(0);
  history_->setMax(1000);
  max_ghosts_ = new rviz::IntProperty("Number", 8, "Largest number of ghosts.", ghosts_.shown);
  max_ghosts_->setMin(1);
  max_ghosts_->setMax(50);
  point_size_ =
      new rviz::FloatProperty("Point Size", 0.003F, "[m]; normals and depths are half as thick.", contacts_.shown);
  point_size_->setMin(1e-5F);
  normal_length_ = new rviz::FloatProperty("Length", 0.02F, "[m]", normals_.shown);
  normal_length_->setMin(1e-5F);
  force_length_ = new rviz::FloatProperty("Length", 0.03F, "[m/N]", force_.shown);
  force_length_->setMin(1e-6F);
  for (rviz::Property* property :
       {static_cast<rviz::Property*>(max_edged_), static_cast<rviz::Property*>(history_),
        static_cast<rviz::Property*>(max_ghosts_), static_cast<rviz::Property*>(point_size_),
        static_cast<rviz::Property*>(normal_length_), static_cast<rviz::Property*>(color_by_),
        static_cast<rviz::Property*>(force_length_)}) {
    QObject::connect(property, &rviz::Property::changed, &parent_, changed_);
  }
}

StyleProperties::ElementProperties StyleProperties::add(const char* name, const char* description, const QColor& color,
                                                        float alpha, bool shown) {
  ElementProperties properties{};
  properties.shown = new rviz::BoolProperty(name, shown, description, &parent_);
  properties.color = new rviz::ColorProperty("Color", color, "", properties.shown);
  properties.alpha = new rviz::FloatProperty("Alpha", alpha, "0 is transparent, 1 opaque.", properties.shown);
  properties.alpha->setMin(0.0F);
  properties.alpha->setMax(1.0F);
  QObject::connect(properties.shown, &rviz::Property::changed, &parent_, changed_);
  QObject::connect(properties.color, &rviz::Property::changed, &parent_, changed_);
  QObject::connect(properties.alpha, &rviz::Property::changed, &parent_, changed_);
  return properties;
}

DisplayStyle StyleProperties::style() const {
  DisplayStyle style;
  style.surface = surface_.style();
  style.max_edged = static_cast<size_t>(max_edged_->getInt());
  style.touched = touched_.style();
  style.reflex = reflex_.style();
  style.considered = considered_.style();
  style.intended = intended_.style();
  style.allowed = allowed_.style();
  style.measured = measured_.style();
  style.history = static_cast<size_t>(history_->getInt());
  style.predicted = predicted_.style();
  style.tool = tool_.style();
  style.ghosts = ghosts_.style();
  style.max_ghosts = static_cast<size_t>(max_ghosts_->getInt());
  style.path = path_.style();
  style.contacts = contacts_.style();
  style.point_size = point_size_->getFloat();
  style.normals = normals_.style();
  style.normal_length = normal_length_->getFloat();
  style.depths = depths_.style();
  style.force = force_.style();
  style.force_length = force_length_->getFloat();
  style.color_by = static_cast<ColorBy>(color_by_->getOptionInt());
  return style;
}

}  // namespace sweep_guard_rviz
