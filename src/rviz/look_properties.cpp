#include "rviz/look_properties.h"

namespace sweep_guard_rviz {

Part LookProperties::PartProperties::part() const {
  Part part;
  part.shown = shown->getBool();
  part.color = color->getOgreColor();
  part.color.a = alpha->getFloat();
  return part;
}

LookProperties::LookProperties(rviz::Property& parent, const std::function<void()>& changed)
    : parent_(parent),
      changed_(changed),
      surface_(add({"Workpiece", "The deforming surfaces.", {214, 205, 188}, 1.0F})),
      touched_(add({"Touched", "Triangles that the tool touches.", {235, 20, 20}, 1.0F})),
      reflex_(add({"Reflex", "Triangles that it will meet within the reflex interval.", {255, 70, 50}, 0.9F})),
      considered_(add({"Considered", "Triangles that it will meet later.", {255, 176, 0}, 0.9F})),
      measured_(
          add({"Measured sweep", "Boxes and their clipping planes, swept to the newest pose.", {0, 205, 230}, 0.2F})),
      predicted_(add({"Predicted sweeps", "The same along the predicted path.", {140, 190, 255}, 0.03F})),
      tool_(add({"Tool", "Where it was measured last.", {90, 128, 230}, 1.0F})),
      ghosts_(add({"Ghosts", "Where it is expected, fading with the time from now.", {115, 165, 255}, 0.35F})),
      path_(add({"Path", "Way of the tip, of the last 2 s and expected.", {235, 235, 235}, 0.9F})),
      contacts_(add({"Contacts", "First point touched of each triangle.", {255, 240, 90}, 1.0F})),
      normals_(add({"Normals", "Of the triangles touched: the way out of them.", {255, 240, 90}, 1.0F})),
      depths_(add({"Depths", "Of the contacts, into the workpiece; the largest in words.", {235, 20, 20}, 1.0F})) {
  most_edged_ = new rviz::IntProperty("Edges Up To", 5000,
                                      "Edges are drawn of surfaces of so many triangles at most: lines cost more.",
                                      surface_.shown);
  most_edged_->setMin(0);
  history_ = new rviz::IntProperty("History", 0, "Earlier boxes that stay, each half a box's least width farther.",
                                   measured_.shown);
  history_->setMin(0);
  history_->setMax(1000);
  most_ghosts_ = new rviz::IntProperty("Number", 8, "Of ghosts at most.", ghosts_.shown);
  most_ghosts_->setMin(1);
  most_ghosts_->setMax(50);
  point_size_ =
      new rviz::FloatProperty("Point Size", 0.003F, "[m]; normals and depths are half as thick.", contacts_.shown);
  point_size_->setMin(1e-5F);
  normal_length_ = new rviz::FloatProperty("Length", 0.02F, "[m]", normals_.shown);
  normal_length_->setMin(1e-5F);
  for (rviz::Property* property :
       {static_cast<rviz::Property*>(most_edged_), static_cast<rviz::Property*>(history_),
        static_cast<rviz::Property*>(most_ghosts_), static_cast<rviz::Property*>(point_size_),
        static_cast<rviz::Property*>(normal_length_)}) {
    QObject::connect(property, &rviz::Property::changed, &parent_, changed_);
  }
}

LookProperties::PartProperties LookProperties::add(const Default& part) {
  PartProperties properties{};
  properties.shown = new rviz::BoolProperty(part.name, true, part.description, &parent_);
  properties.color = new rviz::ColorProperty("Color", part.color, "", properties.shown);
  properties.alpha = new rviz::FloatProperty("Alpha", part.alpha, "0 is transparent, 1 opaque.", properties.shown);
  properties.alpha->setMin(0.0F);
  properties.alpha->setMax(1.0F);
  QObject::connect(properties.shown, &rviz::Property::changed, &parent_, changed_);
  QObject::connect(properties.color, &rviz::Property::changed, &parent_, changed_);
  QObject::connect(properties.alpha, &rviz::Property::changed, &parent_, changed_);
  return properties;
}

Look LookProperties::look() const {
  Look look;
  look.surface = surface_.part();
  look.most_edged = static_cast<size_t>(most_edged_->getInt());
  look.touched = touched_.part();
  look.reflex = reflex_.part();
  look.considered = considered_.part();
  look.measured = measured_.part();
  look.history = static_cast<size_t>(history_->getInt());
  look.predicted = predicted_.part();
  look.tool = tool_.part();
  look.ghosts = ghosts_.part();
  look.most_ghosts = static_cast<size_t>(most_ghosts_->getInt());
  look.path = path_.part();
  look.contacts = contacts_.part();
  look.point_size = point_size_->getFloat();
  look.normals = normals_.part();
  look.normal_length = normal_length_->getFloat();
  look.depths = depths_.part();
  return look;
}

}  // namespace sweep_guard_rviz
