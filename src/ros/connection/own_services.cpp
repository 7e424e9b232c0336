#include "ros/connection/own_services.h"

#include <mutex>

namespace sweep_guard_ros {
namespace {

struct OwnServices {
  std::mutex mutex;
  std::set<std::string> names;
};

OwnServices& advertised() {
  static OwnServices services;
  return services;
}

}  // namespace

ros::ServiceServer advertiseOwn(ros::NodeHandle& node, ros::AdvertiseServiceOptions& options) {
  {
    const std::lock_guard lock(advertised().mutex);
    advertised().names.insert(node.resolveName(options.service));
  }
  return node.advertiseService(options);
}

std::set<std::string> ownServices() {
  const std::lock_guard lock(advertised().mutex);
  return advertised().names;
}

}  // namespace sweep_guard_ros
