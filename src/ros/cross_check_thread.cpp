#include "ros/cross_check_thread.h"

#include <ros/console.h>
#include <ros/file_log.h>

#include "guard/detector_case.h"
#include "ros/process.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr int kNice = 19;
constexpr std::uintmax_t kMaxFolder = 64U << 20U;  // [bytes]

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
  top_ = &supervisor.add({"cross-check", /*watched=*/false});
  thread_ = std::thread([this] { run(); });
}

void CrossCheckThread::run() {
  top_->enter();
  setNice(kNice);
  sweep_guard_core::SampledQuery query;
  while (sampler_.take(query)) top_->run([&] { checkOrLog(query); });
}

// The warning does not rest on the other detector.
void CrossCheckThread::checkOrLog(const sweep_guard_core::SampledQuery& query) {
  try {
    check(query);
  } catch (const sweep_guard_core::Error& error) {
    detectors_.clear();
    log_.error("cross-check", std::string("cross-check failed: ") + error.what());
  }
}

void CrossCheckThread::check(const sweep_guard_core::SampledQuery& query) {
  std::string other = sweep_guard_core::otherDetector(query.detector);
  const auto disagreement = sweep_guard_core::crossCheck(query, detector(other));
  if (disagreement.any()) report(query, other, disagreement);
}

// The warning first: a large case takes a while to write.
void CrossCheckThread::report(const sweep_guard_core::SampledQuery& query, const std::string& other,
                              const sweep_guard_core::Disagreement& disagreement) {
  const std::string& mesh_id = query.workpiece->id;
  std::string text = "detectors disagree about '" + mesh_id + "': " + found(disagreement.missed.size(), other) + ", " +
                     found(disagreement.invented.size(), query.detector);
  monitor_.detectorsDisagree(text, mesh_id, disagreement.missed, now().steady);
  const std::string folder = ros::file_log::getLogDirectory() + "/sweep_guard_cases";
  text += "; " + save(sweep_guard_core::caseOf(query, other), folder, kMaxFolder);
  monitor_.detectorsDisagree(text, mesh_id, disagreement.missed, now().steady);
  log_.error("disagreement", text);
}

// Without OpenGL, `reference` stands in for `select`.
sweep_guard_core::Detector& CrossCheckThread::detector(std::string& name) {
  auto& made = detectors_[name];
  if (made) return *made;
  try {
    made = sweep_guard_core::makeDetector(name, parameters_.initial().detector_options);
  } catch (const sweep_guard_core::DeviceError& error) {
    ROS_WARN("cross-check by reference instead of %s: %s", name.c_str(), error.what());
    made = sweep_guard_core::makeDetector("reference");
  }
  return *made;
}

}  // namespace sweep_guard_ros
