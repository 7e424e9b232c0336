#include "ros/tool/robot_description.h"

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "ros/tool/xacro_check.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using tinyxml2::XMLElement;

constexpr size_t kMaxDescription = size_t{8} << 20U;  // [byte]

// urdfdom reports errors through console_bridge, from the detail to the link, and continues after some of them.
class ErrorCollector : public console_bridge::OutputHandler {
 public:
  ErrorCollector() { console_bridge::useOutputHandler(this); }
  ~ErrorCollector() override { console_bridge::restorePreviousOutputHandler(); }
  ErrorCollector(const ErrorCollector&) = delete;
  ErrorCollector& operator=(const ErrorCollector&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return text.substr(0, 300);
}

std::string nameOf(const XMLElement& element) {
  const char* const name = element.Attribute("name");
  return name == nullptr ? "" : name;
}

std::string oneGeometryText(const std::string& kind) {
  return "a " + kind + " must have one geometry of one shape; give each shape its own";
}

// Of each kind if it is null.
std::vector<XMLElement*> elementsOf(XMLElement& parent, const char* kind) {
  std::vector<XMLElement*> elements;
  for (XMLElement* e = parent.FirstChildElement(kind); e != nullptr; e = e->NextSiblingElement(kind))
    elements.push_back(e);
  return elements;
}

void removeEach(XMLElement& parent, const char* kind) {
  for (XMLElement* element : elementsOf(parent, kind)) parent.DeleteChild(element);
}

// urdfdom silently reads only the first of several geometries.
bool hasSeveralGeometries(XMLElement& shape) {
  XMLElement* const geometry = shape.FirstChildElement("geometry");
  return geometry != nullptr && (elementsOf(shape, "geometry").size() > 1 || elementsOf(*geometry, nullptr).size() > 1);
}

bool hasGeometry(XMLElement& shape) {
  XMLElement* const geometry = shape.FirstChildElement("geometry");
  return geometry != nullptr && geometry->FirstChildElement() != nullptr;
}

bool isPoint(XMLElement& shape) {
  if (!hasGeometry(shape) || hasSeveralGeometries(shape)) return false;
  const XMLElement* const box = shape.FirstChildElement("geometry")->FirstChildElement("box");
  const char* const size = box == nullptr ? nullptr : box->Attribute("size");
  double x = 1.0, y = 1.0, z = 1.0;
  return size != nullptr && std::istringstream(size) >> x >> y >> z && x == 0.0 && y == 0.0 && z == 0.0;
}

// What is wrong with geometry that is not read, or with a color, does not matter.
LinkElements readElements(XMLElement& link, LinkGeometry wanted) {
  const auto collisions = elementsOf(link, "collision");
  const auto visuals = elementsOf(link, "visual");
  LinkElements found;
  found.visual_is_read = wanted == LinkGeometry::kVisual || (wanted == LinkGeometry::kEither && collisions.empty());
  found.has_shape = !collisions.empty() ||
                    !std::all_of(visuals.begin(), visuals.end(), [](XMLElement* visual) { return isPoint(*visual); });
  for (XMLElement* shape : found.visual_is_read ? visuals : collisions) {
    if (!hasGeometry(*shape)) throw InvalidInput("link '" + nameOf(link) + "': " + oneGeometryText(shape->Name()));
    found.has_several = found.has_several || hasSeveralGeometries(*shape);
    removeEach(*shape, "material");
  }
  removeEach(link, found.visual_is_read ? "collision" : "visual");
  return found;
}

class PrinterWithoutComments : public tinyxml2::XMLPrinter {
 public:
  using tinyxml2::XMLPrinter::Visit;
  bool Visit(const tinyxml2::XMLComment&) override { return true; }
};

// urdfdom passes text that it quotes to printf() as a format. So for urdfdom, a percent sign is a character of private use with
// a digit; and that character, where the text has it already, is the same with another digit.
constexpr std::string_view kMask = "\xEE\x80\x80";

std::string masked(const std::string& xml) {
  std::string text;
  for (size_t i = 0; i < xml.size(); ++i) {
    const bool is_mask = xml.compare(i, kMask.size(), kMask) == 0;
    if (is_mask || xml[i] == '%') text += kMask;
    if (is_mask) i += kMask.size() - 1;
    text += is_mask ? '1' : xml[i] == '%' ? '0' : xml[i];
  }
  return text;
}

std::string unmasked(std::string_view text) {
  std::string original;
  for (size_t mask = text.find(kMask); mask != std::string_view::npos; mask = text.find(kMask)) {
    const bool percent = text.substr(mask + kMask.size(), 1) == "0";
    original.append(text.substr(0, mask)).append(percent ? "%" : kMask);
    text.remove_prefix(std::min(mask + kMask.size() + 1, text.size()));
  }
  return original.append(text);
}

template <typename Part>
void unmaskNames(std::map<std::string, std::shared_ptr<Part>>& parts) {
  std::map<std::string, std::shared_ptr<Part>> renamed;
  for (auto& [name, part] : parts) {
    part->name = unmasked(name);
    renamed.emplace(part->name, part);
  }
  parts = std::move(renamed);
}

template <typename Shape>
void unmaskFile(const std::shared_ptr<Shape>& shape) {
  if (!shape->geometry || shape->geometry->type != urdf::Geometry::MESH) return;
  auto& mesh = static_cast<urdf::Mesh&>(*shape->geometry);
  mesh.filename = unmasked(mesh.filename);
}

void unmask(urdf::ModelInterface& model) {
  unmaskNames(model.links_);
  unmaskNames(model.joints_);
  for (const auto& [name, joint] : model.joints_) {
    joint->parent_link_name = unmasked(joint->parent_link_name);
    joint->child_link_name = unmasked(joint->child_link_name);
    if (joint->mimic) joint->mimic->joint_name = unmasked(joint->mimic->joint_name);
  }
  for (const auto& [name, link] : model.links_) {
    for (const auto& shape : link->collision_array) unmaskFile(shape);
    for (const auto& shape : link->visual_array) unmaskFile(shape);
  }
}

// tinyxml2 limits the depth of nested elements; TinyXML, and so urdfdom, does not.
// @param[out] found  by link
std::string checkedXml(const std::string& urdf, LinkGeometry geometry, std::map<std::string, LinkElements>& found) {
  if (urdf.size() > kMaxDescription) throw InvalidInput("larger than 8 MiB");
  tinyxml2::XMLDocument document;
  if (document.Parse(urdf.data(), urdf.size()) != tinyxml2::XML_SUCCESS) {
    throw InvalidInput("not XML: " + oneLine(document.ErrorStr()));
  }
  XMLElement* const robot = document.FirstChildElement("robot");
  if (robot == nullptr) throw InvalidInput("no element <robot>");
  requireNoXacro(*robot);
  for (XMLElement* link = robot->FirstChildElement("link"); link != nullptr; link = link->NextSiblingElement("link")) {
    found[nameOf(*link)] = readElements(*link, geometry);
  }
  PrinterWithoutComments printer;
  document.Accept(&printer);
  return masked(printer.CStr());
}

std::shared_ptr<const urdf::ModelInterface> parse(const std::string& xml) {
  const ErrorCollector errors;
  std::shared_ptr<urdf::ModelInterface> model;
  std::string reason;
  try {
    model = urdf::parseURDF(xml);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (!errors.text().empty()) reason = errors.text();
  if (reason.empty() && (!model || !model->getRoot())) reason = "there is no root link";
  if (!reason.empty()) throw InvalidInput("not a URDF: " + oneLine(unmasked(reason)));
  unmask(*model);
  return model;
}

// Two readers of XML may differ in what a name is.
void requireRead(const urdf::ModelInterface& model, const std::map<std::string, LinkElements>& found) {
  for (const auto& [name, link] : model.links_) {
    if (found.count(name) == 0) throw InvalidInput(oneLine("link '" + name + "': its name is not plain text"));
  }
}

void requireOneParentEach(const urdf::ModelInterface& model) {
  std::map<std::string, std::string> parent_joint;
  for (const auto& [name, joint] : model.joints_) {
    const auto [other, is_first] = parent_joint.emplace(joint->child_link_name, name);
    if (!is_first) {
      throw InvalidInput("link '" + joint->child_link_name + "' is the child of two joints, '" + other->second +
                         "' and '" + name + "'");
    }
  }
}

// urdfdom accepts links in a loop of joints.
void requireConnected(const urdf::ModelInterface& model) {
  std::set<std::string> connected;
  for (const urdf::Link* link : RobotDescription::subtree(*model.getRoot())) connected.insert(link->name);
  for (const auto& [name, link] : model.links_) {
    if (connected.count(name) != 0) continue;
    throw InvalidInput(
        oneLine("link '" + name + "' is not connected to the root link '" + model.getRoot()->name + "'"));
  }
}

}  // namespace

RobotDescription::RobotDescription(const std::string& urdf, LinkGeometry geometry)
    : model_(parse(checkedXml(urdf, geometry, elements_))) {
  requireRead(*model_, elements_);
  requireOneParentEach(*model_);
  requireConnected(*model_);
}

const urdf::Link* RobotDescription::link(const std::string& name) const {
  const auto found = model_->links_.find(name);
  return found == model_->links_.end() ? nullptr : found->second.get();
}

const urdf::Joint* RobotDescription::joint(const std::string& name) const {
  const auto found = model_->joints_.find(name);
  return found == model_->joints_.end() ? nullptr : found->second.get();
}

void RobotDescription::requireOneGeometryEach(const urdf::Link& link) const {
  if (elements_.at(link.name).has_several)
    throw InvalidInput(oneGeometryText(isMadeOfVisuals(link) ? "visual" : "collision"));
}

std::vector<const urdf::Link*> RobotDescription::subtree(const urdf::Link& link) {
  std::vector<const urdf::Link*> links;
  std::vector<const urdf::Link*> open{&link};
  while (!open.empty()) {
    links.push_back(open.back());
    open.pop_back();
    const auto& children = links.back()->child_links;
    for (auto child = children.rbegin(); child != children.rend(); ++child) open.push_back(child->get());
  }
  return links;
}

Eigen::Isometry3d fromUrdf(const urdf::Pose& pose) {
  const Eigen::Quaterniond rotation(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
  const Eigen::Vector3d position(pose.position.x, pose.position.y, pose.position.z);
  if (!rotation.coeffs().allFinite() || !position.allFinite()) throw InvalidInput("its origin is not finite");
  return Eigen::Translation3d(position) * rotation.normalized();
}

}  // namespace sweep_guard_ros
