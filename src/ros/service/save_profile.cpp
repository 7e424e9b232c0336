#include "ros/service/save_profile.h"

#include <ros/console.h>

#include <algorithm>

#include "ros/profile_file.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Error;

constexpr size_t kMaxRequest = 1024;                     // [bytes]
constexpr auto kGuardTimeout = std::chrono::seconds(1);  // of a guard that is stuck in a sweep
constexpr double kMinTime = 1.0;                         // of motion that is worth a file [s]

}  // namespace

SaveProfileService::SaveProfileService(const ros::NodeHandle& private_node, const LiveParameters& parameters,
                                       TakeProfile take_profile)
    : parameters_(parameters),
      take_profile_(std::move(take_profile)),
      server_(calls_.advertise<Event>(
          private_node, "save_profile", kMaxRequest, [this](Event& event) { return onCall(event); },
          [](const std::string& reason, sweep_guard::SaveProfile::Response& response) {
            response.message = reason;
            return true;
          })) {}

// Answers errors by a message: a failed ROS call gives the caller none.
bool SaveProfileService::onCall(Event& event) {
  sweep_guard::SaveProfile::Response& response = event.getResponse();
  try {
    save(event.getRequest().name, response);
  } catch (const std::exception& error) {
    response.message = std::string("nothing was saved: ") + error.what();
  }
  ROS_INFO("~save_profile called by %s: %s", sweep_guard_core::printable(event.getCallerName()).c_str(),
           response.message.c_str());
  return true;
}

void SaveProfileService::save(const std::string& name, sweep_guard::SaveProfile::Response& response) {
  const std::string& configured = parameters_.initial().profile_file;
  if (name.empty() && configured.empty()) {
    throw sweep_guard_core::InvalidInput("prediction/profile is empty: send a name");
  }
  const std::filesystem::path file = name.empty() ? std::filesystem::path(configured) : profileNamed(name);
  writeProfile(file, *learned());
  response.success = true;
  response.path = file.string();
  response.message = "saved; set prediction/profile to " + response.path + " to begin with it";
}

std::unique_ptr<sweep_guard_core::Profile> SaveProfileService::learned() const {
  auto future = take_profile_();
  if (future.wait_for(kGuardTimeout) != std::future_status::ready) throw Error("the guard is busy: ask again");
  auto profile = future.get();
  if (!profile) throw Error("this predictor learns no profile: set prediction/predictor to direct");
  if (std::max(profile->translation.back().time, profile->rotation.back().time) < kMinTime) {
    throw Error("too little motion yet: move the tool for some seconds");
  }
  return profile;
}

}  // namespace sweep_guard_ros
