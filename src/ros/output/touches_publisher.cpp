#include "ros/output/touches_publisher.h"

#include <sweep_guard/Touches.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::TriangleTouches;

sweep_guard::ObjectTouches touchesMsg(sweep_guard_core::ObjectTouches& object) {
  const auto ascending = [](const TriangleTouches& a, const TriangleTouches& b) { return a.triangle < b.triangle; };
  std::sort(object.triangles.begin(), object.triangles.end(), ascending);
  sweep_guard::ObjectTouches message;
  message.mesh_id = object.id;
  message.revision = object.revision;
  for (const TriangleTouches& touched : object.triangles) {
    message.triangles.push_back(touched.triangle);
    message.sweeps.push_back(touched.sweeps);
    message.depths.push_back(touched.depth);
  }
  message.jump_triangles = std::move(object.jump_triangles);
  return message;
}

}  // namespace

TouchesPublisher::TouchesPublisher(ros::NodeHandle private_node)
    : publisher_(private_node.advertise<sweep_guard::Touches>("touches", 1, /*latch=*/true)) {
  publisher_.publish(sweep_guard::Touches());
}

void TouchesPublisher::swept(const sweep_guard_core::SweepReport& report,
                             const sweep_guard_core::Workpieces& workpieces) {
  const sweep_guard_core::Lock lock(map_mutex_);
  map_.add(report, workpieces);
}

void TouchesPublisher::publishIfChanged() {
  const sweep_guard_core::Lock lock(publish_mutex_);
  publishLocked();
}

void TouchesPublisher::reset() {
  const sweep_guard_core::Lock lock(publish_mutex_);
  {
    const sweep_guard_core::Lock map_lock(map_mutex_);
    map_.clear();
  }
  publishLocked();
}

void TouchesPublisher::publishLocked() {
  const auto message = boost::make_shared<sweep_guard::Touches>();
  {
    const sweep_guard_core::Lock lock(map_mutex_);
    if (map_.changes() == published_) return;
    published_ = map_.changes();
    message->header.stamp = toMsg(map_.newest());
    map_.touches(objects_);
  }
  for (sweep_guard_core::ObjectTouches& object : objects_) message->objects.push_back(touchesMsg(object));
  publisher_.publish(message);
}

}  // namespace sweep_guard_ros
