#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "guard/cross_check.h"
#include "ros/parameters/live_parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/process/process.h"
#include "ros/threads/background_thread.h"
#include "ros/threads/supervisor.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Asks a second detector about every Nth query of the guard, in a thread that runs when nothing else does. If both
/// disagree, reports it to the monitor and logs the query. Publishes nothing: the watchdog does soon.
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
  struct Other {
    std::string name;  // `reference` if it stands in
    std::unique_ptr<sweep_guard_core::Detector> detector;
  };
  Other& other(const std::string& name);
  Other make(const std::string& name) const;

  const LiveParameters& parameters_;
  sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::QuerySampler sampler_;
  std::uint64_t count_ = 0;
  std::map<std::string, Other> others_;  // by the name that was asked for, made on demand
  LogThrottle log_;
  ThreadTop* top_ = nullptr;  // from start() on
  BackgroundThread queries_{setIdle};
  std::thread thread_;  // takes and reports: holds locks, which a thread that gets no processor would keep
};

}  // namespace sweep_guard_ros
