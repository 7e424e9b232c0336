#include "ros/guard/cross_check_thread.h"

#include <ros/console.h>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

std::string found(size_t count, const std::string& detector) {
  return std::to_string(count) + (count == 1 ? " triangle" : " triangles") + " found by " + detector + " only";
}

}  // namespace

CrossCheckThread::CrossCheckThread(const LiveParameters& parameters, sweep_guard_core::WarningMonitor& monitor)
    : parameters_(parameters), monitor_(monitor), sampler_(parameters.initial().cross_check) {}

CrossCheckThread::~CrossCheckThread() {
  sampler_.stop();
  if (thread_.joinable()) thread_.join();
}

void CrossCheckThread::start(Supervisor& supervisor) {
  if (parameters_.initial().cross_check == 0) return;
  top_ = &supervisor.add({"cross-check", sweep_guard_core::Stage::kOther, /*watched=*/false});
  queries_.start(supervisor, {"queries", sweep_guard_core::Stage::kOther, /*watched=*/false});
  thread_ = std::thread([this] { run(); });
}

void CrossCheckThread::run() {
  top_->enter();
  sweep_guard_core::SampledQuery query;
  while (sampler_.take(query)) top_->run([&] { checkOrLog(query); });
}

// The warning does not rest on the other detector or on the memory that it takes.
void CrossCheckThread::checkOrLog(const sweep_guard_core::SampledQuery& query) {
  try {
    check(query);
  } catch (const std::exception& error) {
    others_.clear();
    log_.error("cross-check", std::string("cross-check failed: ") + error.what());
  }
}

void CrossCheckThread::check(const sweep_guard_core::SampledQuery& query) {
  const Other* asked = nullptr;
  sweep_guard_core::Disagreement disagreement;
  const auto ask = [&] {
    asked = &other(sweep_guard_core::otherDetector(query.detector, ++count_));
    disagreement = sweep_guard_core::crossCheck(query, *asked->detector);
  };
  queries_.submit<void>(ask).get();
  if (disagreement.any()) report(query, asked->name, disagreement);
}

void CrossCheckThread::report(const sweep_guard_core::SampledQuery& query, const std::string& other,
                              const sweep_guard_core::Disagreement& disagreement) {
  const std::string text = "detectors disagree about '" + query.workpiece->id +
                           "': " + found(disagreement.missed.size(), other) + ", " +
                           found(disagreement.invented.size(), query.detector);
  monitor_.detectorsDisagree(text, query, disagreement.missed, now().steady);
  log_.error("disagreement", "CROSSCHECK: " + text + ": " + describe(query, disagreement));
}

CrossCheckThread::Other& CrossCheckThread::other(const std::string& name) {
  const auto made = others_.find(name);
  return made != others_.end() ? made->second : others_.emplace(name, make(name)).first->second;
}

// Without OpenGL, the reference stands in for `select`.
CrossCheckThread::Other CrossCheckThread::make(const std::string& name) const {
  try {
    return {name, sweep_guard_core::makeDetector(name, parameters_.initial().detector.options)};
  } catch (const sweep_guard_core::DeviceError& error) {
    const std::string& reference = sweep_guard_core::detectorNames().back();
    ROS_WARN("cross-check by %s instead of %s: %s", reference.c_str(), name.c_str(), error.what());
    return {reference, sweep_guard_core::makeDetector(reference)};
  }
}

}  // namespace sweep_guard_ros
