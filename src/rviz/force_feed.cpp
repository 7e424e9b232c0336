#include "rviz/force_feed.h"

#include "rviz/force_text.h"

namespace sweep_guard_rviz {
namespace {

constexpr auto kSilent = std::chrono::milliseconds(500);

}  // namespace

void ForceFeed::listen(const std::string& topic) {
  if (topic == topic_) return;
  topic_ = topic;
  text_.clear();
  subscriber_.shutdown();
  if (topic.empty()) return;
  subscriber_ = node_.subscribe<sweep_guard::Interaction>(
      topic, 1, [this](const sweep_guard::Interaction::ConstPtr& interaction) {
        text_ = describe(*interaction);
        received_ = std::chrono::steady_clock::now();
      });
}

std::string ForceFeed::text() {
  queue_.callAvailable();
  return std::chrono::steady_clock::now() - received_ > kSilent ? "" : text_;
}

}  // namespace sweep_guard_rviz
