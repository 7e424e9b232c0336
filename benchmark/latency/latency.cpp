// Measures the latency of a running guard: from the stamp of a tool pose until its messages are received. Sends poses
// at 1 kHz and new vertices of a deforming hull at 60 Hz. Needs a ROS master; scripts/latency starts one.
#include <ros/ros.h>

#include <boost/program_options.hpp>
#include <iostream>

#include "common/run_program.h"
#include "latency/report.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_benchmark {
namespace {

namespace options = boost::program_options;
using sweep_guard_core::InvalidInput;

Settings settingsOf(int argc, char** argv) {
  Settings settings;
  options::options_description known("latency [options]");
  known.add_options()("help", "print this text")                                             //
      ("triangles", options::value(&settings.triangles), "number of triangles of the hull")  //
      ("seconds", options::value(&settings.seconds), "time to measure")                      //
      ("pose-rate", options::value(&settings.rates.poses), "[Hz]")                           //
      ("vertices-rate", options::value(&settings.rates.vertices), "[Hz]")                    //
      ("away", options::bool_switch(&settings.away),
       "the tool moves 1 m away from the hull, where every warning should be CLEAR")  //
      ("transport", options::value(&settings.transport),
       "tcpros: the guard is a node; nodelet: it runs in this process")                                               //
      ("detector", options::value(&settings.detector), "detector of the guard")                                       //
      ("label", options::value(&settings.label), "text for the tables, beside the transport")                         //
      ("set", options::value(&settings.parameters), "parameter of the guard, as in gl_context=egl; may be repeated")  //
      ("csv", options::value(&settings.csv), "append the figures to this file")                                       //
      ("stages", options::value(&settings.stages), "append the shares of the stages to this file")                    //
      ("histogram", options::value(&settings.histogram), "append the distribution to this file");
  options::variables_map given;
  options::store(options::parse_command_line(argc, argv, known), given);
  options::notify(given);
  if (given.count("help") != 0) {
    std::cout << known;
    std::exit(0);
  }
  if (settings.transport != "tcpros" && settings.transport != "nodelet") {
    throw InvalidInput("--transport: '" + settings.transport + "' is unknown: use tcpros or nodelet");
  }
  if (!(settings.rates.poses > 0.0 && settings.rates.vertices > 0.0)) throw InvalidInput("the rates must be > 0");
  if (settings.triangles < 6 || settings.triangles % 2 != 0) throw InvalidInput("--triangles: use an even number >= 6");
  return settings;
}

int run(int argc, char** argv) {
  ros::init(argc, argv, "latency", ros::init_options::NoSigintHandler);  // an interrupted measurement is useless
  const Settings settings = settingsOf(argc, argv);
  const ros::NodeHandle alive;
  const Measurement measured = measure(settings);
  const std::vector<LatencyRow> rows = rowsOf(measured);
  print(settings, measured, rows);
  save(settings, measured, rows);
  const bool covered = rows[0].milliseconds.size() == posesOf(measured).size();
  const bool clear = !settings.away || unclearWarnings(measured) == 0;
  return covered && clear && holes(measured.messages.contacts) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("latency", [&] { return sweep_guard_benchmark::run(argc, argv); });
}
