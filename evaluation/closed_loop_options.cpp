#include "evaluation/closed_loop_options.h"

#include <limits>
#include <sstream>

#include "common/csv.h"
#include "evaluation/closed_loop_episode.h"
#include "evaluation/option_values.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvNumber;

namespace po = boost::program_options;

namespace {

std::string inSeconds(sweep_guard_core::Duration duration) { return csvNumber(sweep_guard_core::toSeconds(duration)); }

po::options_description describe(ClosedLoopOptions& options) {
  po::options_description described("Options");
  described.add_options()("help,h", po::bool_switch(&options.help), "print this text")("csv", text(options.csv, "FILE"),
                                                                                       "write the figures there")(
      "topic", text(options.topic, "NAME"), "topic of the poses in rosbags; required if there are several")(
      "placements", withDefault("120", "N"),
      "squares along each recording; the robot runs into half of them and misses the others")(
      "seed", withDefault("1", "N"), "seed of the placements")(
      "retreats", withDefault(std::to_string(options.random_retreats), "N"),
      "retreats in random directions from each place where the tool was held, with and without a turn each")(
      "tool-radius", withDefault("0.005", "M"), "radius of the tool, a cylinder [m]")(
      "tool-length", withDefault("0.1", "M"), "length of the tool [m]")(
      "pieces", withDefault("5", "N"), "convex pieces, end to end, that the tool is described by");
  return described;
}

po::options_description describeRobot(const ClosedLoopOptions& options) {
  po::options_description described("Robot and guard");
  described.add_options()("max-speed", withDefault(csvNumber(options.robot.max_speed), "V"),
                          "commands are clipped to this first [m/s]")(
      "max-turn-rate", withDefault(csvNumber(options.robot.max_turn_rate), "W"), "the same of turns [rad/s]")(
      "max-acceleration", withDefault(csvNumber(options.robot.max_acceleration), "A"),
      "commands are clipped to this first [m/s^2]")(
      "max-turn-acceleration", withDefault(csvNumber(options.robot.max_turn_acceleration), "A"),
      "the same of turns [rad/s^2]")("dead-time", withDefault(inSeconds(options.robot.dead_time), "S"),
                                     "until the robot begins to follow [s], rounded to milliseconds")(
      "lag", withDefault(inSeconds(options.robot.lag), "S"), "time constant with which it follows [s]")(
      "pose-delay", withDefault(inSeconds(options.guard.pose_delay), "S"), "until a pose arrives at the guard [s]")(
      "plane-delay", withDefault(inSeconds(options.guard.plane_delay), "S"), "until its planes arrive [s]")(
      "deceleration", withDefault(csvNumber(options.guard.motion.deceleration), "A"),
      "that the guard expects of the robot [m/s^2]")("standoff",
                                                     withDefault(csvNumber(options.guard.motion.standoff), "M"),
                                                     "distance at which the guard lets nothing close in [m]")(
      "reach", withDefault(csvNumber(options.guard.reach), "M"), "of the planes [m]");
  return described;
}

void storeLoop(const po::variables_map& values, ClosedLoopOptions& options) {
  const auto number = [&](const char* option, auto lower, auto upper) {
    return toNumber(option, values[option].as<std::string>(), lower, upper);
  };
  const auto seconds = [&](const char* option) { return sweep_guard_core::fromSeconds(number(option, 0.0, 1.0)); };
  options.placements = number("placements", size_t{1}, size_t{100000});
  options.seed = number("seed", std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
  options.random_retreats = number("retreats", size_t{0}, size_t{1000});
  options.shape =
      sweep_guard_core::ConvexShape::cylinder(number("tool-radius", 1e-3, 1.0), number("tool-length", 1e-3, 10.0));
  options.tool = inPieces(options.shape, number("pieces", size_t{1}, size_t{100}));
  options.robot = {number("max-speed", 1e-3, 10.0),
                   number("max-turn-rate", 1e-3, 100.0),
                   number("max-acceleration", 1e-3, 1e3),
                   number("max-turn-acceleration", 1e-3, 1e4),
                   std::chrono::round<std::chrono::milliseconds>(seconds("dead-time")),
                   seconds("lag")};
  options.guard.pose_delay = seconds("pose-delay");
  options.guard.plane_delay = seconds("plane-delay");
  options.guard.motion.deceleration = number("deceleration", 1e-3, 1e3);
  options.guard.motion.standoff = number("standoff", 0.0, 1.0);
  options.guard.reach = number("reach", 1e-3, 10.0);
  if (options.guard.plane_delay < options.guard.pose_delay) {
    throw sweep_guard_core::InvalidInput("--plane-delay: must be at least --pose-delay");
  }
}

}  // namespace

std::string closedLoopUsage() {
  ClosedLoopOptions options;
  std::ostringstream text;
  text << "Usage: evaluate_closed_loop [options] FILE...\n\n"
          "Lets recorded hands drive a simulated robot towards squares, with and without a motion guard before it. "
          "FILE is a\n"
          "motion file (lines `stamp tx ty tz qx qy qz qw` in s and m) or a rosbag with geometry_msgs/PoseStamped or\n"
          "TransformStamped. Prints a table. The exit status is 1 if a guarded tool touches a square at rest, reaches "
          "the\n"
          "standoff at 1 mm/s or more or retreats with less than 99 % of its speed, or if a command is changed without "
          "a square\n"
          "within reach.\n\n"
       << describe(options) << '\n'
       << describeRobot(options);
  return text.str();
}

ClosedLoopOptions parseClosedLoopOptions(int argc, const char* const* argv) {
  ClosedLoopOptions options;
  po::options_description all = describe(options);
  all.add(describeRobot(options));
  const po::variables_map values = parseCommandLine(argc, argv, all, options.files);
  storeLoop(values, options);
  if (options.files.empty() && !options.help) {
    throw sweep_guard_core::InvalidInput("no recording; --help shows the usage");
  }
  return options;
}

}  // namespace sweep_guard_evaluation
