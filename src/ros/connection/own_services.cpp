#include "ros/connection/own_services.h"

#include "common/guarded_by.h"

namespace sweep_guard_ros {
namespace {

sweep_guard_core::Mutex services_mutex;
std::set<std::string> service_names GUARDED_BY(services_mutex);

}  // namespace

ros::ServiceServer advertiseOwn(ros::NodeHandle& node, ros::AdvertiseServiceOptions& options) {
  {
    const sweep_guard_core::Lock lock(services_mutex);
    service_names.insert(node.resolveName(options.service));
  }
  return node.advertiseService(options);
}

std::set<std::string> ownServices() {
  const sweep_guard_core::Lock lock(services_mutex);
  return service_names;
}

}  // namespace sweep_guard_ros
