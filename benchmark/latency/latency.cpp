// Measures a running guard end to end: from the stamp of a tool's pose until what the guard says of it is heard. Poses
// come at 1 kHz, new vertices of a deforming hull at 60 Hz. Needs a ROS master; scripts/latency brings its own.
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>

#include "evaluation/csv.h"
#include "evaluation/quantile.h"
#include "latency/histogram.h"
#include "latency/listener.h"
#include "latency/process.h"
#include "latency/sender.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_benchmark {
namespace {

namespace options = boost::program_options;
using sweep_guard::InvalidInput;
using sweep_guard_evaluation::csvLine;
using sweep_guard_evaluation::csvNumber;
using sweep_guard_evaluation::quantile;

constexpr double kPatience = 15.0;  // [s] with a guard that takes in the mesh, or has fallen behind
constexpr double kWarmUp = 2.0;     // [s]
const std::string kGuard = "sweep_guard";

struct Settings {
  int triangles = 1600;
  double seconds = 10.0;
  Rates rates;
  std::string transport = "tcpros";
  std::string detector = "select";
  std::string csv;
  std::string histogram;
  std::vector<std::string> parameters;
};

Settings settingsOf(int argc, char** argv) {
  Settings settings;
  options::options_description known("latency [options]");
  known.add_options()("help", "this text")                                 //
      ("triangles", options::value(&settings.triangles), "of the hull")    //
      ("seconds", options::value(&settings.seconds), "to measure for")     //
      ("pose-rate", options::value(&settings.rates.poses), "[Hz]")         //
      ("vertices-rate", options::value(&settings.rates.vertices), "[Hz]")  //
      ("transport", options::value(&settings.transport),
       "tcpros: the guard is a node; nodelet: it runs in this process")                                               //
      ("detector", options::value(&settings.detector), "of the guard")                                                //
      ("set", options::value(&settings.parameters), "parameter of the guard, as in gl_context=egl; may be repeated")  //
      ("csv", options::value(&settings.csv), "append the figures to this file")                                       //
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
  if (!(settings.rates.poses > 0.0 && settings.rates.vertices > 0.0)) throw InvalidInput("rates: use some > 0");
  if (settings.triangles < 6 || settings.triangles % 2 != 0) throw InvalidInput("--triangles: use an even number >= 6");
  return settings;
}

void setParameters(const Settings& settings) {
  const ros::NodeHandle guard(kGuard);
  guard.setParam("tool/radius", 0.005);
  guard.setParam("tool/length", 0.05);
  guard.setParam("detector", settings.detector);
  for (const std::string& parameter : settings.parameters) {
    const size_t equals = parameter.find('=');
    if (equals == std::string::npos) throw InvalidInput("--set: '" + parameter + "' is not key=value");
    const std::string value = parameter.substr(equals + 1);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (end != value.c_str() && *end == '\0') {
      guard.setParam(parameter.substr(0, equals), number);
    } else {
      guard.setParam(parameter.substr(0, equals), value);
    }
  }
}

// The guard: a program of its own, or in this one.
class GuardProcess {
 public:
  explicit GuardProcess(const std::string& transport) {
    if (transport == "tcpros") {
      child_ =
          std::make_unique<ChildProcess>(std::vector<std::string>{neighbour("sweep_guard_node"), "__name:=" + kGuard});
      return;
    }
    loader_ = std::make_unique<nodelet::Loader>(/*provide_ros_api=*/false);
    if (!loader_->load(ros::names::resolve(kGuard), "sweep_guard/SweepGuardNodelet", {}, {})) {
      throw sweep_guard::DeviceError("the nodelet cannot be loaded");
    }
  }

  pid_t id() const { return child_ ? child_->id() : getpid(); }
  bool isOurs() const { return child_ == nullptr; }

 private:
  std::unique_ptr<ChildProcess> child_;
  std::unique_ptr<nodelet::Loader> loader_;
};

struct Measurement {
  Nanoseconds begin = 0;
  Nanoseconds end = 0;
  Usage before = {};
  Usage after = {};
  double load = 0.0;
  std::vector<Nanoseconds> poses;
  Said said;

  double seconds() const { return 1e-9 * static_cast<double>(end - begin); }
};

// Until the contacts cover that pose, or for so long.
void waitFor(const Listener& listener, Nanoseconds pose) {
  const ros::WallTime give_up = ros::WallTime::now() + ros::WallDuration(kPatience);
  while (listener.newestContacts() < pose && ros::ok() && ros::WallTime::now() < give_up) {
    ros::WallDuration(0.1).sleep();
  }
}

// Without what the sending takes, where that is in the guard's process.
Usage usage(const GuardProcess& guard, const Sender& sender) {
  Usage used = usageOf(guard.id());
  if (guard.isOurs()) used.processor_s -= sender.processor();
  return used;
}

Measurement measure(const Settings& settings) {
  LatencyScene scene(settings.triangles);
  setParameters(settings);
  const Listener listener(kGuard);
  const GuardProcess guard(settings.transport);
  Sender sender(scene, settings.rates);
  waitFor(listener, /*pose=*/1);
  if (listener.newestContacts() == 0) throw sweep_guard::DeviceError("the guard says nothing");
  ros::WallDuration(kWarmUp).sleep();

  Measurement measured;
  const Said before = listener.said();
  measured.before = usage(guard, sender);
  measured.begin = static_cast<Nanoseconds>(ros::Time::now().toNSec());
  ros::WallDuration(settings.seconds).sleep();
  measured.end = static_cast<Nanoseconds>(ros::Time::now().toNSec());
  measured.after = usage(guard, sender);
  getloadavg(&measured.load, 1);
  measured.poses = sender.poses();
  waitFor(listener, measured.poses.back());
  measured.said = listener.said();
  measured.said.sweeps_asked -= before.sweeps_asked;
  measured.said.sweeps_made -= before.sweeps_made;
  measured.said.whole_predictions -= before.whole_predictions;
  measured.said.met -= before.met;
  return measured;
}

/// One line of the table, and of the CSV file.
struct Row {
  std::string work;
  std::vector<double> milliseconds;
};

std::vector<Nanoseconds> posesOf(const Measurement& measured) {
  std::vector<Nanoseconds> poses;
  std::copy_if(measured.poses.begin(), measured.poses.end(), std::back_inserter(poses),
               [&](Nanoseconds pose) { return pose >= measured.begin && pose < measured.end; });
  return poses;
}

std::vector<Row> rowsOf(const Measurement& measured) {
  const auto during = [&](const std::vector<Heard>& heard) { return within(heard, measured.begin, measured.end); };
  return {{"pose to contacts", latencies(posesOf(measured), measured.said.contacts)},
          {"pose to prediction", ages(during(measured.said.predictions))},
          {"pose to warning", ages(during(measured.said.warnings))},
          {"pose to change of level", ages(during(measured.said.changes))}};
}

std::string methodOf(const Settings& settings) {
  std::string method = settings.detector;
  for (const std::string& parameter : settings.parameters) method += ' ' + parameter;
  return method + ", " + settings.transport;
}

// Of the warning, p99 over TCPROS on a quiet machine [ms].
std::optional<double> goal(const Settings& settings) {
  if (settings.transport != "tcpros") return std::nullopt;
  if (settings.triangles <= 1600) return 2.0;
  if (settings.triangles <= 20'000) return 4.0;
  if (settings.triangles <= 100'000) return 10.0;
  return std::nullopt;
}

void print(const Settings& settings, const Measurement& measured, const std::vector<Row>& rows) {
  std::printf(
      "\n%d triangles, %s; load %.1f [ms]\n| | count | per second | p50 | p90 | p99 | max "
      "|\n|---|---|---|---|---|---|---|\n",
      settings.triangles, methodOf(settings).c_str(), measured.load);
  for (const Row& row : rows) {
    std::printf("| %s | %zu | %.1f | %.2f | %.2f | %.2f | %.2f |\n", row.work.c_str(), row.milliseconds.size(),
                static_cast<double>(row.milliseconds.size()) / measured.seconds(), quantile(row.milliseconds, 0.5),
                quantile(row.milliseconds, 0.9), quantile(row.milliseconds, 0.99), quantile(row.milliseconds, 1.0));
  }
  const std::vector<Heard> swept = within(measured.said.contacts, measured.begin, measured.end);
  std::printf(
      "poses: %zu sent, %zu covered; sweeps: %.1f per second, %zu of them met something; intervals unswept: %zu\n",
      posesOf(measured).size(), rows[0].milliseconds.size(), static_cast<double>(swept.size()) / measured.seconds(),
      measured.said.met, holes(measured.said.contacts));
  std::printf("predicted sweeps: %zu made of %zu; predictions with all of them: %zu\n", measured.said.sweeps_made,
              measured.said.sweeps_asked, measured.said.whole_predictions);
  std::printf("guard's process: %.0f %% of a processor, %.1f MB, %+.1f MB meanwhile\n",
              100.0 * (measured.after.processor_s - measured.before.processor_s) / measured.seconds(),
              measured.after.resident_mb, measured.after.resident_mb - measured.before.resident_mb);
  if (const std::optional<double> bound = goal(settings)) {
    const double p99 = quantile(rows[2].milliseconds, 0.99);
    std::printf("%s: pose to warning, p99 %.2f <= %g ms on a quiet machine\n", p99 <= *bound ? "pass" : "FAIL", p99,
                *bound);
  }
  std::fflush(stdout);
}

void appendFigures(const Settings& settings, const Measurement& measured, const std::vector<Row>& rows) {
  const bool is_new = !std::ifstream(settings.csv).good();
  std::ofstream file(settings.csv, std::ios::app);
  if (is_new) {
    file << csvLine({"work", "method", "triangles", "count", "per_second", "p50_ms", "p90_ms", "p99_ms", "max_ms",
                     "unswept", "sweeps_made", "sweeps_asked", "processor_share", "resident_mb", "growth_mb", "load"});
  }
  for (const Row& row : rows) {
    const auto at = [&](double fraction) { return csvNumber(quantile(row.milliseconds, fraction)); };
    const double seconds = measured.seconds();
    file << csvLine({row.work, methodOf(settings), std::to_string(settings.triangles),
                     std::to_string(row.milliseconds.size()),
                     csvNumber(static_cast<double>(row.milliseconds.size()) / seconds), at(0.5), at(0.9), at(0.99),
                     at(1.0), std::to_string(holes(measured.said.contacts)), std::to_string(measured.said.sweeps_made),
                     std::to_string(measured.said.sweeps_asked),
                     csvNumber((measured.after.processor_s - measured.before.processor_s) / seconds),
                     csvNumber(measured.after.resident_mb),
                     csvNumber(measured.after.resident_mb - measured.before.resident_mb), csvNumber(measured.load)});
  }
  if (!file) throw InvalidInput("--csv: cannot write " + settings.csv);
}

int run(int argc, char** argv) {
  ros::init(argc, argv, "latency");
  const Settings settings = settingsOf(argc, argv);
  const ros::NodeHandle alive;
  const Measurement measured = measure(settings);
  const std::vector<Row> rows = rowsOf(measured);
  print(settings, measured, rows);
  if (!settings.csv.empty()) appendFigures(settings, measured, rows);
  if (!settings.histogram.empty()) {
    for (const Row& row : rows) {
      appendHistogram(settings.histogram, {methodOf(settings), settings.triangles, row.work}, row.milliseconds);
    }
  }
  const bool covered = rows[0].milliseconds.size() == posesOf(measured).size();
  return covered && holes(measured.said.contacts) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  try {
    return sweep_guard_benchmark::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "latency: " << error.what() << '\n';
    return 2;
  }
}
