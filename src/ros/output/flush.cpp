#include "ros/output/flush.h"

#include <ros/init.h>
#include <ros/poll_manager.h>

#include <chrono>
#include <future>
#include <memory>

namespace sweep_guard_ros {
namespace {

// roscpp sends in the rounds of its poll thread: one that runs already may have passed the publishers, the next takes the
// messages from them and then writes to the sockets, and the last one shows that this is done.
constexpr int kRounds = 3;
constexpr auto kMaxWait = std::chrono::milliseconds(200);

}  // namespace

void flush() {
  if (!ros::isStarted() || ros::isShuttingDown()) return;
  const auto done = std::make_shared<std::promise<void>>();
  const auto& poll_manager = ros::PollManager::instance();
  const auto connection = poll_manager->addPollThreadListener([done, poll_manager, rounds = 0]() mutable {
    if (++rounds == kRounds) done->set_value();
    if (rounds < kRounds) poll_manager->getPollSet().signal();
  });
  poll_manager->getPollSet().signal();
  done->get_future().wait_for(kMaxWait);
  poll_manager->removePollThreadListener(connection);
}

}  // namespace sweep_guard_ros
