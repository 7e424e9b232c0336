#include <geometry_msgs/PoseStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "recording/touched.h"
#include "simulation/demo_report.h"
#include "sweep_guard/Contacts.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/Warning.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using sweep_guard_core::Duration;
using sweep_guard_core::InvalidInput;

constexpr std::uint32_t kQueue = 100000;
constexpr Duration kPatience = seconds(60);
constexpr Duration kGrace = seconds(1);
constexpr Duration kLivePeriod = milliseconds(500);
constexpr const char* kUsage =
    "Usage: demo_monitor [--duration S] [--latency-csv FILE]\n"
    "Watches a demo and reports what the guard did with every tool pose.\n"
    "  --duration S        seconds from the first pose; 0 (default): until the operator ends or Ctrl-C\n"
    "  --latency-csv FILE  write stamp [s], latency [ms] and triangles touched of every sweep\n"
    "Topics: tool_pose, mesh_vertices, contacts, warning\n";

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) { interrupted = 1; }

struct Arguments {
  Duration duration{0};
  std::string latency_csv;
  bool help = false;
};

Duration toDuration(const std::string& text) {
  double value = -1.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !(value >= 0.0 && value <= 1e6)) {
    throw InvalidInput("--duration is '" + text + "', must be seconds in [0, 1e6]");
  }
  return sweep_guard_core::fromSeconds(value);
}

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (size_t i = 1; i < words.size(); ++i) {
    const bool has_value = i + 1 < words.size();
    if (words[i] == "--help" || words[i] == "-h") {
      arguments.help = true;
    } else if (words[i] == "--duration" && has_value) {
      arguments.duration = toDuration(words[++i]);
    } else if (words[i] == "--latency-csv" && has_value) {
      arguments.latency_csv = words[++i];
    } else {
      throw InvalidInput("argument '" + words[i] + "' is unknown or lacks its value\n" + kUsage);
    }
  }
  return arguments;
}

sweep_guard_core::Time toTime(const ros::Time& time) { return sweep_guard_core::Time(Duration(time.toNSec())); }

Duration steadyNow() { return std::chrono::steady_clock::now().time_since_epoch(); }

const char* levelName(std::uint8_t level) {
  switch (level) {
    case sweep_guard::Warning::CLEAR:
      return "CLEAR";
    case sweep_guard::Warning::CONSIDERED:
      return "CONSIDERED";
    case sweep_guard::Warning::REFLEX:
      return "REFLEX";
    case sweep_guard::Warning::CONTACT:
      return "CONTACT";
    default:
      return "UNKNOWN";
  }
}

/// Waits until `condition`, or Ctrl-C (false).
/// @throws InvalidInput with `problem` when it takes longer than a minute
bool waitUntil(const std::function<bool()>& condition, const std::string& problem) {
  for (const Duration begin = steadyNow(); interrupted == 0; ros::WallDuration(0.01).sleep()) {
    if (condition()) return true;
    if (steadyNow() - begin > kPatience) throw InvalidInput(problem);
  }
  return false;
}

class DemoMonitor {
 public:
  explicit DemoMonitor(Duration duration) : duration_(duration) {
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    contacts_ = node_.subscribe("contacts", kQueue, &DemoMonitor::onContacts, this, hints);
    mesh_vertices_ = node_.subscribe("mesh_vertices", kQueue, &DemoMonitor::onMeshVertices, this, hints);
    warning_ = node_.subscribe("warning", kQueue, &DemoMonitor::onWarning, this, hints);
  }

  /// Counts until the duration is over, the operator is gone or Ctrl-C.
  void watch() {
    const auto connected = [this] {
      ros::spinOnce();
      return contacts_.getNumPublishers() > 0;
    };
    if (!waitUntil(connected,
                   "nobody publishes " + contacts_.getTopic() + "; start the guard, or remap contacts to it"))
      return;
    tool_pose_ = node_.subscribe("tool_pose", kQueue, &DemoMonitor::onPose, this, ros::TransportHints().tcpNoDelay());
    const auto moving = [this] {
      ros::spinOnce();
      return report_.poses() > 0;
    };
    if (!waitUntil(moving,
                   "no pose came on " + tool_pose_.getTopic() + "; start the operator, or see what it waits for"))
      return;
    count();
    settle();
  }

  const DemoReport& report() const { return report_; }

 private:
  void onPose(const geometry_msgs::PoseStamped::ConstPtr& pose) {
    report_.addPose(toTime(pose->header.stamp), pose->header.seq);
  }
  void onMeshVertices(const sweep_guard::MeshVertices::ConstPtr&) { report_.addMeshUpdate(); }
  void onWarning(const sweep_guard::Warning::ConstPtr& warning) {
    level_ = levelName(warning->level);
    report_.addWarning(toTime(ros::Time::now()), static_cast<sweep_guard_core::WarningLevel>(warning->level));
  }

  void onContacts(const sweep_guard::Contacts::ConstPtr& contacts) {
    const sweep_guard_core::Time arrival = toTime(ros::Time::now());
    const sweep_guard_core::Time start = toTime(contacts->interval_start);
    const sweep_guard_core::Time stamp = toTime(contacts->header.stamp);
    if (settling_ && !report_.awaits(start, stamp)) return;
    std::vector<TouchedObject> objects;
    for (const sweep_guard::ObjectContacts& object : contacts->objects) {
      if (!sweep_guard_recording::isTouched(object)) continue;
      objects.push_back({object.mesh_id, sweep_guard_recording::trianglesTouched(object)});
    }
    report_.addContacts(start, stamp, arrival, objects);
  }

  void handleMessages() { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01)); }

  void count() {
    const Duration begin = steadyNow();
    Duration next_line = kLivePeriod;
    for (Duration elapsed{0}; interrupted == 0 && !isOver(elapsed); elapsed = steadyNow() - begin) {
      handleMessages();
      if (elapsed < next_line) continue;
      showLive(elapsed);
      next_line += kLivePeriod;
    }
    if (isatty(STDOUT_FILENO) != 0) std::cout << std::endl;
  }

  bool isOver(Duration elapsed) const {
    return duration_ > Duration(0) ? elapsed >= duration_ : tool_pose_.getNumPublishers() == 0;
  }

  void settle() {
    handleMessages();
    tool_pose_.shutdown();
    settling_ = true;
    for (const Duration begin = steadyNow(); report_.posesNotSwept() > 0 && steadyNow() - begin < kGrace;) {
      handleMessages();
    }
  }

  void showLive(Duration elapsed) const {
    const std::string line = report_.liveLine(elapsed, level_);
    if (isatty(STDOUT_FILENO) != 0) {
      std::cout << '\r' << line << "\033[K" << std::flush;
    } else {
      std::cout << line << std::endl;
    }
  }

  Duration duration_;
  DemoReport report_;
  bool settling_ = false;  // the count is over, late answers still come
  std::string level_ = "-";
  ros::NodeHandle node_;
  ros::Subscriber tool_pose_;
  ros::Subscriber mesh_vertices_;
  ros::Subscriber contacts_;
  ros::Subscriber warning_;
};

void writeLatencies(const std::string& path, const std::vector<Latency>& latencies) {
  std::ofstream csv(path);
  csv << "stamp_s,latency_ms,triangles\n" << std::fixed;
  for (const Latency& latency : latencies) {
    csv << sweep_guard_core::toSeconds(latency.stamp.time_since_epoch()) << ','
        << sweep_guard_core::toSeconds(latency.delay) * 1e3 << ',' << latency.triangles << '\n';
  }
  csv.flush();
  if (!csv) throw InvalidInput(path + ": cannot be written: " + std::strerror(errno));
}

int run(const Arguments& arguments) {
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  if (!waitUntil(ros::master::check, "no ROS master at " + ros::master::getURI() + "; start the demo")) return 1;
  DemoMonitor monitor(arguments.duration);
  monitor.watch();
  std::cout << monitor.report().summary() << std::endl;
  if (!arguments.latency_csv.empty()) writeLatencies(arguments.latency_csv, monitor.report().latencies());
  const std::optional<std::string> fault = monitor.report().fault();
  if (fault) std::cout << "FAILED: " << *fault << std::endl;
  return fault ? 1 : 0;
}

}  // namespace

}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  ros::init(argc, argv, "demo_monitor", ros::init_options::NoSigintHandler);
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  try {
    const sweep_guard_simulation::Arguments arguments = sweep_guard_simulation::parse(words);
    if (arguments.help) {
      std::cout << sweep_guard_simulation::kUsage;
      return 0;
    }
    return sweep_guard_simulation::run(arguments);
  } catch (const sweep_guard_core::InvalidInput& error) {
    std::cerr << "demo_monitor: " << error.what() << std::endl;
    return 1;
  }
}
