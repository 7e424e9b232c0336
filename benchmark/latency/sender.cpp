#include "latency/sender.h"

#include <geometry_msgs/PoseStamped.h>
#include <pthread.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <chrono>
#include <ctime>

namespace sweep_guard_benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kReservedPoses = 1'000'000;

// Calls `send` at the given rate with the time since the first call [s].
template <typename Send>
void repeat(const std::atomic<bool>& stopping, double rate, const Send& send) {
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate));
  const Clock::time_point begin = Clock::now();
  for (Clock::time_point due = begin; !stopping; due = std::max(due + period, Clock::now())) {
    std::this_thread::sleep_until(due);
    send(std::chrono::duration<double>(Clock::now() - begin).count());
  }
}

double processorOf(std::thread& thread) {
  clockid_t clock = 0;
  timespec used = {};
  pthread_getcpuclockid(thread.native_handle(), &clock);
  clock_gettime(clock, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace

Sender::Sender(LatencyScene& scene, const Rates& rates, bool away) : scene_(scene), rates_(rates), away_(away) {
  ros::NodeHandle node;
  mesh_ = node.advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
  vertices_ = node.advertise<sweep_guard::MeshVertices>("mesh_vertices", 10);
  poses_ = node.advertise<geometry_msgs::PoseStamped>("tool_pose", 1000);
  stamps_.reserve(kReservedPoses);
  auto mesh = boost::make_shared<sweep_guard::DeformableMesh>(scene_.mesh());
  mesh->header.stamp = ros::Time::now();
  mesh_.publish(mesh);
  threads_.emplace_back([this] { sendPoses(); });
  threads_.emplace_back([this] { sendVertices(); });
}

Sender::~Sender() { stop(); }

const std::vector<Nanoseconds>& Sender::poses() {
  stop();
  return stamps_;
}

double Sender::processor() const {
  double used = 0.0;
  for (const std::thread& thread : threads_) used += processorOf(const_cast<std::thread&>(thread));
  return used;
}

void Sender::sendPoses() {
  repeat(stopping_, rates_.poses, [this](double t) {
    auto pose = boost::make_shared<geometry_msgs::PoseStamped>();
    pose->header.frame_id = "world";
    pose->pose = LatencyScene::tool(t);
    if (away_) pose->pose.position.x += 1.0;
    pose->header.stamp = ros::Time::now();
    stamps_.push_back(static_cast<Nanoseconds>(pose->header.stamp.toNSec()));
    poses_.publish(pose);
  });
}

void Sender::sendVertices() {
  repeat(stopping_, rates_.vertices, [this](double /*t*/) { vertices_.publish(scene_.frame(ros::Time::now())); });
}

void Sender::stop() {
  stopping_ = true;
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

}  // namespace sweep_guard_benchmark
