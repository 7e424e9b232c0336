#include "ros/parameters/camera_parameters.h"

#include <ros/names.h>

#include <algorithm>
#include <array>
#include <set>

#include "ros/parameters/parameter_text.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using XmlRpc::XmlRpcValue;

// A group of a list. What it throws follows "must be".
class GroupReader {
 public:
  explicit GroupReader(XmlRpcValue& group) : group_(group) {
    if (group.getType() != XmlRpcValue::TypeStruct) refuse("a list of groups");
  }

  std::string text(const std::string& name) {
    names_.push_back(name);
    if (!group_.hasMember(name) || group_[name].getType() != XmlRpcValue::TypeString ||
        static_cast<std::string>(group_[name]).empty())
      refuse("a list of groups that each have " + name + ": TEXT, not empty");
    texts_.push_back(group_[name]);
    return texts_.back();
  }

  double number(const std::string& name, double fallback, const ParameterRange& range) {
    names_.push_back(name);
    const double number = group_.hasMember(name) ? toNumber(group_[name]) : fallback;
    if (!within(number, range)) refuse("with " + name + ": " + described(range));
    texts_.push_back(shown(ParameterValue(number)));
    return number;
  }

  std::array<double, 2> pair(const std::string& name, std::array<double, 2> fallback, const ParameterRange& range) {
    names_.push_back(name);
    if (group_.hasMember(name)) {
      XmlRpcValue& list = group_[name];
      const std::string wanted = "with " + name + ": a list of two numbers, each " + described(range);
      if (list.getType() != XmlRpcValue::TypeArray || list.size() != 2) refuse(wanted);
      fallback = {toNumber(list[0]), toNumber(list[1])};
      if (!within(fallback[0], range) || !within(fallback[1], range)) refuse(wanted);
    }
    texts_.push_back(bracketed(std::vector{shown(ParameterValue(fallback[0])), shown(ParameterValue(fallback[1]))}));
    return fallback;
  }

  // Of all entries, which must have been read.
  std::string shownAll() {
    for (const auto& [name, value] : group_) {
      if (std::count(names_.begin(), names_.end(), name) == 0)
        refuse("without " + sweep_guard_core::printable(name) + ", of which a camera has none");
    }
    return grouped(names_, texts_);
  }

  [[noreturn]] static void refuse(const std::string& wanted) { throw sweep_guard_core::InvalidInput(wanted); }

 private:
  XmlRpcValue& group_;
  std::vector<std::string> names_;
  std::vector<std::string> texts_;
};

CameraParameters cameraOf(GroupReader& group) {
  CameraParameters camera;
  camera.id = group.text("id");
  std::string error;
  if (!sweep_guard_core::isName(camera.id) || !ros::names::validate("cameras/" + camera.id, error) ||
      camera.id.find('/') != std::string::npos)
    GroupReader::refuse("with ids of at most 128 letters, digits and _, which the topic ~cameras/ID may have");
  camera.depth = group.text("depth");
  const auto [nearest, farthest] = group.pair("range", {0.1, 4.0}, {0.001, 1000.0, "m"});
  if (!(nearest < farthest)) GroupReader::refuse("with range: [nearest, farthest]");
  camera.options.nearest = nearest;
  camera.options.farthest = farthest;
  camera.options.margin = group.pair("margin", camera.options.margin, {0.0, 1.0});
  camera.timeout = sweep_guard_core::fromSeconds(group.number("timeout", 0.2, {0.01, 60.0, "s"}));
  camera.options.surface_speed = group.number("surface_speed", camera.options.surface_speed, {0.0, 100.0, "m/s"});
  camera.self_padding = group.number("self_padding", 0.03, {0.0, 1.0, "m"});
  camera.options.remember = group.number("remember", camera.options.remember, {0.0, 60.0, "s"});
  return camera;
}

}  // namespace

std::vector<CameraParameters> readCameras(ParameterReader& read) {
  std::vector<CameraParameters> cameras;
  std::set<std::string> ids;
  read.groups(
      "cameras",
      "a list of groups {id: TEXT, depth: TEXT, range: [NUMBER, NUMBER], margin: [NUMBER, NUMBER], timeout: "
      "NUMBER, surface_speed: NUMBER, self_padding: NUMBER, remember: NUMBER}, of which only id and depth are needed, "
      "or []",
      "Depth cameras: what each sees is a workpiece by its id (letters, digits, _), and must be there. depth: topic of "
      "images, sensor_msgs/Image, or of compressedDepth (png) if it ends so; camera_info is expected beside it. range "
      "[m]: depths that count. margin [m, 1/m]: a surface at depth z counts as nearer to the camera by the first "
      "plus the second times z^2: the error of the camera. timeout [s]: an older image makes the warning UNKNOWN. "
      "surface_speed [m/s]: what moves no faster along a ray of the camera is swept on its way. self_padding [m]: "
      "what is as near to the tool is the tool itself. remember [s]: what was free when the robot came before it "
      "counts as free for so long.",
      [&](XmlRpcValue& group) {
        GroupReader reader(group);
        cameras.push_back(cameraOf(reader));
        if (!ids.insert(cameras.back().id).second) GroupReader::refuse("with each id once");
        return reader.shownAll();
      });
  return cameras;
}

double readMinSeen(ParameterReader& read, double fallback) {
  return read.live().number("min_seen", fallback, {0.001, 1.0},
                            "With cameras: the warning is UNKNOWN where they see less than this share of what the tool "
                            "takes up on its predicted path to be free.");
}

}  // namespace sweep_guard_ros
