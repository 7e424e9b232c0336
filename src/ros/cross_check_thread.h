#pragma once

#include <map>
#include <memory>
#include <string>
#include <thread>

#include "guard/cross_check.h"
#include "ros/log_throttle.h"
#include "ros/parameters/parameters.h"
#include "ros/threads/supervisor.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Asks a second detector every Nth query of the guard's, in a thread that runs when nothing else does. If they
/// disagree, reports it to the monitor and saves the query in the folder of ROS's logs.
class CrossCheckThread {
 public:
  CrossCheckThread(const LiveParameters& parameters, sweep_guard_core::WarningMonitor& monitor);
  ~CrossCheckThread();
  CrossCheckThread(const CrossCheckThread&) = delete;
  CrossCheckThread& operator=(const CrossCheckThread&) = delete;

  void start(Supervisor& supervisor);

  sweep_guard_core::QuerySampler& sampler() { return sampler_; }

 private:
  void run();
  void checkOrLog(const sweep_guard_core::SampledQuery& query);
  void check(const sweep_guard_core::SampledQuery& query);
  void report(const sweep_guard_core::SampledQuery& query, const std::string& other,
              const sweep_guard_core::Disagreement& disagreement);
  sweep_guard_core::Detector& detector(std::string& name);

  const LiveParameters& parameters_;
  sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::QuerySampler sampler_;
  std::map<std::string, std::unique_ptr<sweep_guard_core::Detector>> detectors_;  // by name, made on demand
  LogThrottle log_;
  ThreadTop* top_ = nullptr;  // from start() on
  std::thread thread_;
};

}  // namespace sweep_guard_ros
