#include <fmt/format.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/JointState.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <boost/program_options.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "common/run_program.h"
#include "simulation/demo_statistics.h"
#include "sweep_guard/Contacts.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/Interaction.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/Warning.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {

namespace po = boost::program_options;

namespace {

using std::chrono::seconds;
using sweep_guard_core::Duration;
using sweep_guard_core::InvalidInput;
using sweep_guard_ros::fromMsg;

constexpr std::uint32_t kQueue = 100000;
constexpr Duration kConnectTimeout = seconds(60);
constexpr Duration kAnswerTimeout = seconds(1);
constexpr Duration kLivePeriod = std::chrono::milliseconds(500);
volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) { interrupted = 1; }

struct Arguments {
  double duration = 0.0;  // [s]
  std::string latency_csv;
  bool joints = false;
  bool elastic = false;
  bool camera = false;
  bool help = false;
};

po::options_description describe(Arguments& arguments) {
  po::options_description options(
      "Usage: demo_monitor [options]\n"
      "Counts the poses of a demo and the answers of the guard, and reports them.\n"
      "Topics: tool_pose or joint_states, mesh, mesh_vertices, camera/depth/camera_info, contacts, warning,\n"
      "interaction");
  options.add_options()("help,h", po::bool_switch(&arguments.help), "print this text")(
      "joints", po::bool_switch(&arguments.joints), "joints move the tool: count their states as poses")(
      "elastic", po::bool_switch(&arguments.elastic), "also report how far the workpiece gives way, and the force")(
      "camera", po::bool_switch(&arguments.camera),
      "the guard has a depth camera in place of the mesh: count its images")(
      "duration", po::value(&arguments.duration)->value_name("S"),
      "seconds from the first pose, at most 1e6; 0 (default): until the operator ends or Ctrl-C")(
      "latency-csv", po::value(&arguments.latency_csv)->value_name("FILE"),
      "write stamp [s], latency [ms] and number of triangles touched of every sweep");
  return options;
}

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  try {
    po::variables_map values;
    const po::options_description options = describe(arguments);
    po::store(po::command_line_parser({words.begin() + 1, words.end()}).options(options).positional({}).run(), values);
    po::notify(values);
  } catch (const po::error& error) {
    throw InvalidInput(std::string(error.what()) + "; --help lists the options");
  }
  if (!(arguments.duration >= 0.0 && arguments.duration <= 1e6)) {
    throw InvalidInput("--duration must be seconds in [0, 1e6]");
  }
  return arguments;
}

Duration steadyNow() { return std::chrono::steady_clock::now().time_since_epoch(); }

/// Waits for a condition. Returns false after Ctrl-C.
/// @throws InvalidInput with `problem` after a minute
bool waitUntil(const std::function<bool()>& condition, const std::string& problem) {
  for (const Duration begin = steadyNow(); interrupted == 0; ros::WallDuration(0.01).sleep()) {
    if (condition()) return true;
    if (steadyNow() - begin > kConnectTimeout) throw InvalidInput(problem);
  }
  return false;
}

class DemoMonitor {
 public:
  explicit DemoMonitor(const Arguments& arguments)
      : duration_(sweep_guard_core::fromSeconds(arguments.duration)), joints_(arguments.joints) {
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    contacts_ = node_.subscribe("contacts", kQueue, &DemoMonitor::onContacts, this, hints);
    mesh_vertices_ = node_.subscribe("mesh_vertices", kQueue, &DemoMonitor::onMeshVertices, this, hints);
    warning_ = node_.subscribe("warning", kQueue, &DemoMonitor::onWarning, this, hints);
    if (arguments.camera) countImages();
    if (!arguments.elastic) return;
    mesh_ = node_.subscribe("mesh", 1, &DemoMonitor::onMesh, this);
    interaction_ = node_.subscribe("interaction", kQueue, &DemoMonitor::onInteraction, this, hints);
  }

  /// Counts until the duration is over, the operator ends, or Ctrl-C.
  void run() {
    const auto waitFor = [](const auto& condition, const std::string& problem) {
      return waitUntil([&] { return ros::spinOnce(), condition(); }, problem);
    };
    if (!waitFor([this] { return contacts_.getNumPublishers() > 0; },
                 "no publisher of " + contacts_.getTopic() + "; start the guard, or remap contacts to it")) {
      return;
    }
    if (!waitFor([this] { return workpiece_known_; },
                 "the guard knows no workpiece; start one, or see the guard's log")) {
      return;
    }
    poses_ = joints_ ? subscribePoses<sensor_msgs::JointState>("joint_states")
                     : subscribePoses<geometry_msgs::PoseStamped>("tool_pose");
    if (!waitFor([this] { return statistics_.poses() > 0; },
                 "no pose on " + poses_.getTopic() + "; start the operator, or see its log")) {
      return;
    }
    count();
    settle();
  }

  const DemoStatistics& statistics() const { return statistics_; }

 private:
  template <typename Message>
  ros::Subscriber subscribePoses(const std::string& topic) {
    const auto add = [this](const typename Message::ConstPtr& message) {
      statistics_.addPose(fromMsg(message->header.stamp), message->header.seq);
    };
    return node_.subscribe<Message>(topic, kQueue, add, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  }
  void countImages() {
    statistics_.addImages(0);
    const auto count = [this](const sensor_msgs::CameraInfo::ConstPtr& info) {
      if (!info->header.stamp.isZero()) statistics_.addImages(1);
    };
    camera_info_ = node_.subscribe<sensor_msgs::CameraInfo>("camera/depth/camera_info", kQueue, count);
  }
  void onMesh(const sweep_guard::DeformableMesh::ConstPtr& mesh) {
    rest_.clear();
    for (const geometry_msgs::Point& p : mesh->mesh.vertices) rest_.emplace_back(p.x, p.y, p.z);
  }
  void onMeshVertices(const sweep_guard::MeshVertices::ConstPtr& vertices) {
    if (vertices->positions.empty()) return;
    statistics_.addMeshUpdate(fromMsg(vertices->header.stamp));
    if (!rest_.empty()) statistics_.addDent(dentOf(vertices->positions));
  }
  double dentOf(const std::vector<float>& positions) const {
    double dent = 0.0;
    for (size_t i = 0; i < std::min(rest_.size(), positions.size() / 3); ++i) {
      const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3f>(&positions[3 * i]).cast<double>();
      dent = std::max(dent, (p - rest_[i]).norm());
    }
    return dent;
  }
  void onInteraction(const sweep_guard::Interaction::ConstPtr& interaction) {
    const geometry_msgs::Vector3& force = interaction->wrench.force;
    statistics_.addForce(Eigen::Vector3d(force.x, force.y, force.z).norm());
  }
  void onWarning(const sweep_guard::Warning::ConstPtr& warning) {
    const auto level = static_cast<sweep_guard_core::WarningLevel>(warning->level);
    level_ = sweep_guard_core::styleOf(level).name;
    workpiece_known_ = (warning->reasons & sweep_guard::Warning::NO_MESH) == 0;
    statistics_.addWarning(fromMsg(ros::Time::now()), level);
  }

  void onContacts(const sweep_guard::Contacts::ConstPtr& contacts) {
    const sweep_guard_core::Time arrival = fromMsg(ros::Time::now());
    const sweep_guard_core::Time start = fromMsg(contacts->interval_start);
    const sweep_guard_core::Time stamp = fromMsg(contacts->header.stamp);
    if (settling_ && !statistics_.expects(start, stamp)) return;
    statistics_.addContacts(start, stamp, arrival, contacts->objects);
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
    return duration_ > Duration(0) ? elapsed >= duration_ : poses_.getNumPublishers() == 0;
  }

  void settle() {
    handleMessages();
    poses_.shutdown();
    settling_ = true;
    for (const Duration begin = steadyNow(); statistics_.posesNotSwept() > 0 && steadyNow() - begin < kAnswerTimeout;) {
      handleMessages();
    }
  }

  void showLive(Duration elapsed) const {
    const std::string line = statistics_.liveLine(elapsed, level_);
    if (isatty(STDOUT_FILENO) != 0) {
      std::cout << '\r' << line << "\033[K" << std::flush;
    } else {
      std::cout << line << std::endl;
    }
  }

  Duration duration_;
  bool joints_;  // the poses are states of joints
  DemoStatistics statistics_;
  std::vector<Eigen::Vector3d> rest_;  // vertices of an elastic workpiece as they were first [m]
  bool workpiece_known_ = false;       // to the guard
  bool settling_ = false;              // only late answers count
  std::string level_ = "-";
  ros::NodeHandle node_;
  ros::Subscriber poses_;
  ros::Subscriber mesh_;
  ros::Subscriber mesh_vertices_;
  ros::Subscriber interaction_;
  ros::Subscriber camera_info_;
  ros::Subscriber contacts_;
  ros::Subscriber warning_;
};

void writeLatencies(const std::string& path, const std::vector<Latency>& latencies) {
  std::ofstream csv(path);
  csv << "stamp_s,latency_ms,triangles\n";
  for (const Latency& latency : latencies) {
    csv << fmt::format("{:.6f},{:.6f},{}\n", sweep_guard_core::toSeconds(latency.stamp.time_since_epoch()),
                       1e3 * sweep_guard_core::toSeconds(latency.delay), latency.triangles);
  }
  csv.flush();
  if (!csv) throw InvalidInput(path + ": cannot be written: " + std::strerror(errno));
}

int run(const std::vector<std::string>& words) {
  Arguments arguments = parse(words);
  if (arguments.help) {
    std::cout << describe(arguments);
    return 0;
  }
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  if (!waitUntil(ros::master::check, "no ROS master at " + ros::master::getURI() + "; start the demo")) return 1;
  DemoMonitor monitor(arguments);
  monitor.run();
  std::cout << monitor.statistics().summary() << std::endl;
  if (!arguments.latency_csv.empty()) writeLatencies(arguments.latency_csv, monitor.statistics().latencies());
  const std::optional<std::string> fault = monitor.statistics().fault();
  if (fault) std::cout << "FAILED: " << *fault << std::endl;
  return fault ? 1 : 0;
}

}  // namespace

}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  ros::init(argc, argv, "demo_monitor", ros::init_options::NoSigintHandler);
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  return sweep_guard_core::runProgram(
      "demo_monitor", [&] { return sweep_guard_simulation::run(words); }, /*failed=*/1);
}
