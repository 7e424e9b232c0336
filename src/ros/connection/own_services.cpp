#include "ros/connection/own_services.h"

#include "common/guarded_by.h"

namespace sweep_guard_ros {
namespace {

struct OwnServices {
  sweep_guard_core::Mutex mutex;
  std::set<std::string> names GUARDED_BY(mutex);
};

OwnServices& advertised() {
  static OwnServices services;
  return services;
}

}  // namespace

ros::ServiceServer advertiseOwn(ros::NodeHandle& node, ros::AdvertiseServiceOptions& options) {
  {
    const sweep_guard_core::Lock lock(advertised().mutex);
    advertised().names.insert(node.resolveName(options.service));
  }
  return node.advertiseService(options);
}

std::set<std::string> ownServices() {
  const sweep_guard_core::Lock lock(advertised().mutex);
  return advertised().names;
}

}  // namespace sweep_guard_ros
