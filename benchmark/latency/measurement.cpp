#include "latency/measurement.h"

#include <nodelet/loader.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <memory>

#include "sweep_guard/common/error.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::InvalidInput;

constexpr double kTimeout = 15.0;  // for reading the mesh, or for a backlog [s]
constexpr double kWarmUp = 2.0;    // [s]
constexpr Nanoseconds kDiagnosticsPeriod = 1'000'000'000;
const std::string kGuard = "sweep_guard";

void setParameters(const Settings& settings) {
  const ros::NodeHandle guard(kGuard);
  guard.setParam("tool/radius", 0.005);
  guard.setParam("tool/length", 0.05);
  guard.setParam("detector", settings.detector);
  guard.setParam("gl_context", "osmesa");  // with `auto`, another detector could be measured
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

// Runs the guard as a program of its own, or in this process.
class GuardProcess {
 public:
  explicit GuardProcess(const std::string& transport) {
    if (transport == "tcpros") {
      child_ = std::make_unique<ChildProcess>(
          std::vector<std::string>{programBeside("sweep_guard_node"), "__name:=" + kGuard});
      return;
    }
    loader_ = std::make_unique<nodelet::Loader>(/*provide_ros_api=*/false);
    if (!loader_->load(ros::names::resolve(kGuard), "sweep_guard/SweepGuardNodelet", {}, {})) {
      throw sweep_guard_core::DeviceError("cannot load the nodelet");
    }
  }

  pid_t id() const { return child_ ? child_->id() : getpid(); }
  bool isOurs() const { return child_ == nullptr; }

 private:
  std::unique_ptr<ChildProcess> child_;
  std::unique_ptr<nodelet::Loader> loader_;
};

// Waits until the contacts cover the pose, or for kTimeout.
void waitFor(const Listener& listener, Nanoseconds pose) {
  const ros::WallTime give_up = ros::WallTime::now() + ros::WallDuration(kTimeout);
  while (listener.newestContacts() < pose && ros::ok() && ros::WallTime::now() < give_up) {
    ros::WallDuration(0.1).sleep();
  }
}

// Leaves out the processor time of the sender if it runs in the guard's process.
Usage usage(const GuardProcess& guard, const Sender& sender) {
  Usage used = usageOf(guard.id());
  if (guard.isOurs()) used.processor_s -= sender.processor();
  return used;
}

}  // namespace

Measurement measure(const Settings& settings) {
  LatencyScene scene(settings.triangles);
  setParameters(settings);
  const Listener listener(kGuard);
  const GuardProcess guard(settings.transport);
  Sender sender(scene, settings.rates, settings.away);
  waitFor(listener, /*pose=*/1);
  if (listener.newestContacts() == 0) throw sweep_guard_core::DeviceError("the guard publishes nothing");
  ros::WallDuration(kWarmUp).sleep();

  Measurement measured;
  const ReceivedMessages before = listener.messages();
  measured.before = usage(guard, sender);
  measured.begin = static_cast<Nanoseconds>(ros::Time::now().toNSec());
  ros::WallDuration(settings.seconds).sleep();
  measured.end = static_cast<Nanoseconds>(ros::Time::now().toNSec());
  measured.after = usage(guard, sender);
  getloadavg(&measured.load, 1);
  measured.poses = sender.poses();
  waitFor(listener, measured.poses.back());
  measured.messages = listener.messages();
  measured.messages.sweeps_asked -= before.sweeps_asked;
  measured.messages.sweeps_made -= before.sweeps_made;
  measured.messages.whole_predictions -= before.whole_predictions;
  measured.messages.met -= before.met;
  return measured;
}

std::vector<Nanoseconds> posesOf(const Measurement& measured) {
  std::vector<Nanoseconds> poses;
  std::copy_if(measured.poses.begin(), measured.poses.end(), std::back_inserter(poses),
               [&](Nanoseconds pose) { return pose >= measured.begin && pose < measured.end; });
  return poses;
}

std::size_t unclearWarnings(const Measurement& measured) {
  return within(measured.messages.unclear, measured.begin, measured.end).size();
}

std::vector<StageShare> stagesOf(const Measurement& measured) {
  std::vector<StageShare> mean;
  double periods = 0.0;
  for (const StageReport& report : measured.messages.stages) {
    if (report.received - kDiagnosticsPeriod < measured.begin || report.received > measured.end) continue;
    if (mean.empty()) mean = report.shares;
    periods += 1.0;
    if (periods == 1.0) continue;
    for (size_t i = 0; i < mean.size(); ++i) mean[i].percent += (report.shares[i].percent - mean[i].percent) / periods;
  }
  return mean;
}

double sweepsPerSecond(const Measurement& measured) {
  return measured.perSecond(within(measured.messages.contacts, measured.begin, measured.end).size());
}

std::vector<LatencyRow> rowsOf(const Measurement& measured) {
  const auto during = [&](const std::vector<ReceivedMessage>& messages) {
    return within(messages, measured.begin, measured.end);
  };
  return {{"pose to contacts", latencies(posesOf(measured), measured.messages.contacts)},
          {"pose to prediction", ages(during(measured.messages.predictions))},
          {"pose to warning", ages(during(measured.messages.warnings))},
          {"pose to change of level", ages(during(measured.messages.changes))}};
}

}  // namespace sweep_guard_benchmark
