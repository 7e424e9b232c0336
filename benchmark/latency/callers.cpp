// Calls ~check_sweep of a guard from many clients at once, each as soon as it has an answer; a client that finds the guard
// busy asks again after 0.1 s. scripts/latency --callers runs it beside a measurement.
#include <ros/ros.h>
#include <sched.h>
#include <sweep_guard/CheckSweep.h>

#include <atomic>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <vector>

#include "common/run_program.h"
#include "latency/scene.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard::CheckSweep;

constexpr size_t kPoses = 100;

std::atomic<int> tested = 0;
std::atomic<int> refused = 0;

CheckSweep::Request request() {
  CheckSweep::Request request;
  request.path.resize(kPoses);
  for (size_t i = 0; i < kPoses; ++i) {
    request.path[i].header.frame_id = "world";
    request.path[i].pose = LatencyScene::tool(0.01 * static_cast<double>(i));
  }
  request.fine = true;
  return request;
}

void callWhileThereIsAGuard() {
  const std::string name = "/sweep_guard/check_sweep";
  CheckSweep::Request asked = request();
  ros::ServiceClient client;
  while (ros::ok()) {
    if (!client.isValid()) client = ros::NodeHandle().serviceClient<CheckSweep>(name, /*persistent=*/true);
    CheckSweep::Response response;
    const bool answered = client.isValid() && client.call(asked, response);
    if (answered) ++(response.success ? tested : refused);
    if (!answered || !response.success) ros::WallDuration(0.1).sleep();
  }
}

int run(int argc, char** argv) {
  const sched_param none{};
  sched_setscheduler(0, SCHED_IDLE, &none);  // what the clients do themselves is not measured
  ros::init(argc, argv, "callers", ros::init_options::AnonymousName);
  const ros::NodeHandle alive;
  std::vector<std::thread> clients;
  for (int i = argc > 1 ? std::atoi(argv[1]) : 64; i > 0; --i) clients.emplace_back(callWhileThereIsAGuard);
  for (std::thread& client : clients) client.join();
  std::cout << tested << " paths tested, " << refused << " calls refused" << std::endl;
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("callers", [&] { return sweep_guard_benchmark::run(argc, argv); });
}
