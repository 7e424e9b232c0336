#include "ros/tool/xacro_check.h"

#include <string>
#include <string_view>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;

bool isOfXacro(std::string_view name) { return name.substr(0, 6) == "xacro:"; }

bool isReplaced(std::string_view value) {
  return value.find("${") != std::string_view::npos || value.find("$(") != std::string_view::npos;
}

// Not <gazebo> or <transmission>: in these, a $ may be meant for another program.
bool isReadByUrdfdom(std::string_view name) { return name == "link" || name == "joint" || name == "material"; }

[[noreturn]] void refuseXacro(const std::string& found) {
  throw sweep_guard_core::InvalidInput("it is a xacro file, with " + sweep_guard_core::printable(found) +
                                       ": run `xacro FILE > robot.urdf` first, or in a launch file <param "
                                       "name=\"robot_description\" command=\"xacro FILE\"/>");
}

void requireNoneIn(const XMLElement& element, bool is_read) {
  const std::string name = element.Name();
  if (isOfXacro(name)) refuseXacro("<" + name + ">");
  for (const XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    if (isOfXacro(a->Name()) || (is_read && isReplaced(a->Value()))) {
      refuseXacro(std::string(a->Name()) + "=\"" + a->Value() + "\" in <" + name + ">");
    }
  }
}

// tinyxml2 limits the depth.
void requireNoneBelow(const XMLElement& element, bool is_read) {
  requireNoneIn(element, is_read);
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    requireNoneBelow(*e, is_read);
  }
}

}  // namespace

void requireNoXacro(const XMLElement& robot) {
  requireNoneIn(robot, true);
  for (const XMLElement* e = robot.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    requireNoneBelow(*e, isReadByUrdfdom(e->Name()));
  }
}

}  // namespace sweep_guard_ros
