#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>

#include "common/run_program.h"
#include "evaluation/joint_errors.h"
#include "evaluation/option_values.h"
#include "evaluation/options.h"
#include "recording/bag.h"
#include "recording/recording.h"
#include "ros/tool/robot_tree.h"
#include "sweep_guard/common/unwound.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_evaluation {
namespace {

namespace po = boost::program_options;
using sweep_guard_core::InvalidInput;

constexpr const char* kUsage =
    "Usage: evaluate_joint_prediction --urdf FILE --links LINK,LINK,... [options] BAG...\n\n"
    "Predicts the links of a robot from its joints, and each from its own poses, and compares both with what came. "
    "Writes\n"
    "a CSV table. BAG is a rosbag with sensor_msgs/JointState.\n\n";

struct Arguments {
  bool help = false;
  std::string urdf, links, topic;
  std::vector<std::string> bags;
  std::vector<std::string> predictors;
  std::vector<sweep_guard_core::Duration> horizons;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  po::options_description options("Options");
  options.add_options()("help,h", po::bool_switch(&arguments.help), "print this text")(
      "urdf", text(arguments.urdf, "FILE"), "description of the robot")("links", text(arguments.links, "LINK,..."),
                                                                        "links whose origins are predicted")(
      "topic", text(arguments.topic, "NAME"), "topic of the joints; required if there are several")(
      "predictors", withDefault("direct,polynomial,constant_velocity,hold", "NAMES"), "predictors to compare")(
      "horizons", withDefault("0.1,0.5,1", "S,S,..."), "horizons of the errors [s]");
  const po::variables_map values = parseCommandLine(argc, argv, options, arguments.bags);
  if (arguments.help) std::cout << kUsage << options;
  if (arguments.help) return arguments;
  if (arguments.urdf.empty() || arguments.links.empty() || arguments.bags.empty())
    throw InvalidInput("--urdf, --links and a bag are needed: see --help");
  arguments.predictors = splitAtCommas(values["predictors"].as<std::string>());
  for (const std::string& word : splitAtCommas(values["horizons"].as<std::string>()))
    arguments.horizons.push_back(sweep_guard_core::fromSeconds(toNumber("horizons", word, 1e-3, 10.0)));
  if (!std::is_sorted(arguments.horizons.begin(), arguments.horizons.end()))
    throw InvalidInput("--horizons: must ascend");
  return arguments;
}

sweep_guard_ros::RobotTree readTree(const Arguments& arguments) {
  const sweep_guard_ros::RobotDescription robot(sweep_guard_recording::readFile(arguments.urdf));
  std::vector<const urdf::Link*> links;
  for (const std::string& name : splitAtCommas(arguments.links)) {
    links.push_back(robot.link(name));
    if (links.back() == nullptr) throw InvalidInput(arguments.urdf + " has no link '" + name + "'");
  }
  return treeOf(robot, robot.root(), links);
}

// The position of each variable, or none if the message lacks one.
std::optional<std::vector<double>> positionsOf(const sensor_msgs::JointState& joints,
                                               const sweep_guard_core::KinematicTree& tree) {
  std::vector<double> positions;
  for (const sweep_guard_core::JointVariable& variable : tree.variables()) {
    const auto found = std::find(joints.name.begin(), joints.name.end(), variable.name);
    const auto index = static_cast<size_t>(found - joints.name.begin());
    if (index >= joints.position.size()) return std::nullopt;
    if (!std::isfinite(joints.position[index]))
      throw InvalidInput("the position of joint '" + variable.name + "' is not finite");
    positions.push_back(joints.position[index]);
  }
  return positions;
}

// Messages that lack a joint, or are not later than the one before, are left out.
std::vector<StampedPositions> readStates(const std::string& bag, const std::string& topic,
                                         const sweep_guard_core::KinematicTree& tree) {
  std::vector<StampedPositions> states;
  const auto add = [&](const std::string&, const sensor_msgs::JointState& joints) {
    auto positions = positionsOf(joints, tree);
    const sweep_guard_core::Time stamp = sweep_guard_ros::fromMsg(joints.header.stamp);
    if (!positions || (!states.empty() && stamp <= states.back().stamp)) return;
    for (size_t i = 0; i < positions->size() && !states.empty(); ++i) {
      double& position = (*positions)[i];
      if (tree.variables()[i].continuous) position = sweep_guard_core::unwound(position, states.back().positions[i]);
    }
    states.push_back({stamp, std::move(*positions)});
  };
  sweep_guard_recording::readJointBag(bag, topic, add);
  if (states.empty()) throw InvalidInput(bag + ": no message has all joints that move the links");
  return states;
}

int run(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  if (arguments.help) return 0;
  const sweep_guard_ros::RobotTree robot = readTree(arguments);
  bool header = true;
  for (const std::string& bag : arguments.bags) {
    const std::vector<StampedPositions> states = readStates(bag, arguments.topic, robot.tree);
    for (const std::string& predictor : arguments.predictors) {
      JointErrorRequest request{robot.tree, robot.links, states, arguments.horizons, {}};
      request.predictor.predictor = predictor;
      const std::string name = std::filesystem::path(bag).stem();
      std::cout << jointErrorCsv(name, predictor, compareJointPrediction(request), header) << std::flush;
      header = false;
    }
  }
  return 0;
}

}  // namespace
}  // namespace sweep_guard_evaluation

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("evaluate_joint_prediction",
                                      [&] { return sweep_guard_evaluation::run(argc, argv); });
}
