// Measures how long motion_guard takes from a command to its output, as a nodelet in one process with the guard: commands and
// poses at 1 kHz, new vertices of a deforming hull at 60 Hz. Needs a ROS master; scripts/latency --commands starts one.
#include <geometry_msgs/TwistStamped.h>
#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/spinner.h>
#include <sweep_guard/MotionStatus.h>

#include <algorithm>
#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "common/run_program.h"
#include "latency/process.h"
#include "latency/scene.h"
#include "latency/sender.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::DeviceError;
using sweep_guard_core::quantile;

constexpr double kWarmUp = 4.0;    // [s]
constexpr double kSpeed = 0.02;    // [m/s] of the commands, back and forth
constexpr double kPeriod = 0.001;  // [s]

/// Sends commands, and receives what motion_guard makes of them.
class Commands {
 public:
  Commands() {
    node_.setCallbackQueue(&queue_);
    publisher_ = node_.advertise<geometry_msgs::TwistStamped>("command", 100);
    const auto hints = ros::TransportHints().tcpNoDelay();
    outputs_ = node_.subscribe("guarded_command", 1000, &Commands::onOutput, this, hints);
    status_ = node_.subscribe("motion_guard/status", 1000, &Commands::onStatus, this, hints);
    spinner_.start();
    thread_ = std::thread([this] { send(); });
  }
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;
  ~Commands() {
    stopping_ = true;
    thread_.join();
    spinner_.stop();
  }

  void restart() {
    const std::lock_guard lock(mutex_);
    milliseconds_.clear();
    ages_ms_.clear();
    sent_ = limited_ = 0;
  }

  void print(int triangles) const {
    const std::lock_guard lock(mutex_);
    const auto figures = [](const std::vector<double>& values) {
      const double most = values.empty() ? NAN : *std::max_element(values.begin(), values.end());
      std::printf("p50 %.3f ms, p99 %.3f ms, largest %.3f ms", quantile(values, 0.5), quantile(values, 0.99), most);
    };
    std::printf("%d triangles, %zu commands, %zu answered, %zu limited\ncommand to output: ", triangles, sent_,
                milliseconds_.size(), limited_);
    figures(milliseconds_);
    std::printf("\nage of the planes: ");
    figures(ages_ms_);
    std::printf("\n");
  }

  // Of commands that arrive together, the newest counts.
  bool mostAnswered() const {
    const std::lock_guard lock(mutex_);
    return static_cast<double>(milliseconds_.size()) >= 0.99 * static_cast<double>(sent_);
  }

 private:
  void send() {
    using Clock = std::chrono::steady_clock;
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kPeriod));
    size_t number = 0;
    for (auto due = Clock::now(); !stopping_; due = std::max(due + period, Clock::now())) {
      std::this_thread::sleep_until(due);
      auto command = boost::make_shared<geometry_msgs::TwistStamped>();
      command->header.frame_id = "world";
      command->twist.linear.x = (number++ / 1000) % 2 == 0 ? -kSpeed : kSpeed;
      command->header.stamp = ros::Time::now();
      publisher_.publish(command);
      const std::lock_guard lock(mutex_);
      ++sent_;
    }
  }

  void onOutput(const geometry_msgs::TwistStamped::ConstPtr& output) {
    const double took = 1e3 * (ros::Time::now() - output->header.stamp).toSec();
    const std::lock_guard lock(mutex_);
    milliseconds_.push_back(took);
    if (std::abs(output->twist.linear.x) < kSpeed) ++limited_;
  }

  void onStatus(const sweep_guard::MotionStatus::ConstPtr& status) {
    const std::lock_guard lock(mutex_);
    ages_ms_.push_back(1e3 * status->planes_age);
  }

  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_{1, &queue_};
  ros::Publisher publisher_;
  ros::Subscriber outputs_;
  ros::Subscriber status_;
  mutable std::mutex mutex_;
  std::vector<double> milliseconds_;
  std::vector<double> ages_ms_;
  size_t sent_ = 0;
  size_t limited_ = 0;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

void load(nodelet::Loader& loader, const std::string& name, const std::string& type) {
  if (!loader.load(ros::names::resolve(name), type, {}, {})) throw DeviceError("cannot load " + type);
}

int run(int argc, char** argv) {
  ros::init(argc, argv, "command_latency", ros::init_options::NoSigintHandler);
  const int triangles = argc > 1 ? std::atoi(argv[1]) : 20000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10.0;
  ros::NodeHandle node;
  node.setParam("sweep_guard/tool/radius", 0.005);
  node.setParam("sweep_guard/tool/length", 0.05);
  node.setParam("motion_guard/command_type", "twist_stamped");
  LatencyScene scene(triangles);
  nodelet::Loader loader(/*provide_ros_api=*/false);
  load(loader, "sweep_guard", "sweep_guard/SweepGuardNodelet");
  load(loader, "motion_guard", "sweep_guard/MotionGuardNodelet");
  Sender sender(scene, Rates(), /*away=*/false);
  Commands commands;
  ros::WallDuration(kWarmUp).sleep();
  commands.restart();
  const Usage before = usageOf(getpid());
  ros::WallDuration(seconds).sleep();
  const Usage after = usageOf(getpid());
  commands.print(triangles);
  double load_now = 0.0;
  getloadavg(&load_now, 1);
  std::printf("processor of the whole process: %.2f, load %.1f\n", (after.processor_s - before.processor_s) / seconds,
              load_now);
  return commands.mostAnswered() ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("command_latency", [&] { return sweep_guard_benchmark::run(argc, argv); });
}
