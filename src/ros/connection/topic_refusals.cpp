#include "ros/connection/topic_refusals.h"

#include <algorithm>
#include <map>
#include <utility>

namespace sweep_guard_ros {

std::shared_ptr<TopicRefusals> TopicRefusals::of(const std::string& topic) {
  static sweep_guard_core::Mutex mutex;
  static std::map<std::string, std::weak_ptr<TopicRefusals>> of_topics;
  const sweep_guard_core::Lock lock(mutex);
  std::weak_ptr<TopicRefusals>& known = of_topics[topic];
  auto refusals = known.lock();
  if (!refusals) known = refusals = std::make_shared<TopicRefusals>();
  return refusals;
}

std::shared_ptr<TopicRefusals::Report> TopicRefusals::add(std::function<void(const std::string&)> report) {
  auto added = std::make_shared<Report>(std::move(report));
  const sweep_guard_core::Lock lock(mutex_);
  const auto is_gone = [](const auto& one) { return one.expired(); };
  reports_.erase(std::remove_if(reports_.begin(), reports_.end(), is_gone), reports_.end());
  reports_.push_back(added);
  return added;
}

std::vector<std::weak_ptr<TopicRefusals::Report>> TopicRefusals::reports() const {
  const sweep_guard_core::Lock lock(mutex_);
  return reports_;
}

void TopicRefusals::pass(const std::string& reason) {
  for (const auto& report : reports()) {
    if (const auto open = report.lock()) open->pass(reason);
  }
}

}  // namespace sweep_guard_ros
