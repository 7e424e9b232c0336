#include "rviz/warning_feed.h"

#include <utility>

namespace sweep_guard_rviz {
namespace {

constexpr std::uint32_t kQueued = 100;
constexpr size_t kKept = 10000;  // until they are taken

}  // namespace

WarningFeed::WarningFeed() : spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  spinner_.start();
}

WarningFeed::~WarningFeed() {
  subscriber_.shutdown();
  spinner_.stop();
}

void WarningFeed::listen(const std::string& topic) {
  subscriber_.shutdown();
  take();
  if (topic.empty()) return;
  subscriber_ = node_.subscribe<sweep_guard::Warning>(
      topic, kQueued, [this](const sweep_guard::Warning::ConstPtr& warning) { receive(*warning); });
}

std::vector<ReceivedWarning> WarningFeed::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(received_, {});
}

void WarningFeed::receive(const sweep_guard::Warning& warning) {
  const std::lock_guard lock(mutex_);
  if (received_.size() >= kKept) received_.erase(received_.begin(), received_.begin() + kKept / 2);
  received_.push_back({warning, currentInstant()});
}

}  // namespace sweep_guard_rviz
