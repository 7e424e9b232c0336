#include "ros/output/flush.h"

#include <ros/init.h>
#include <ros/poll_manager.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>

namespace sweep_guard_ros {
namespace {

// roscpp sends in the rounds of its poll thread: one that runs already may have passed the publishers, the next takes the
// messages from them and then writes to the sockets, and the last one shows that this is done.
constexpr int kRounds = 3;
constexpr auto kMaxWait = std::chrono::milliseconds(200);

struct Rounds {
  std::mutex mutex;
  std::condition_variable changed;
  int count = 0;
};

}  // namespace

void flush() {
  if (!ros::isStarted() || ros::isShuttingDown()) return;
  const auto rounds = std::make_shared<Rounds>();
  const auto& poll_manager = ros::PollManager::instance();
  const auto connection = poll_manager->addPollThreadListener([rounds, poll_manager] {
    const std::lock_guard lock(rounds->mutex);
    ++rounds->count;
    rounds->changed.notify_all();
    if (rounds->count < kRounds) poll_manager->getPollSet().signal();
  });
  poll_manager->getPollSet().signal();
  {
    std::unique_lock lock(rounds->mutex);
    rounds->changed.wait_for(lock, kMaxWait, [&] { return rounds->count >= kRounds; });
  }
  poll_manager->removePollThreadListener(connection);
}

}  // namespace sweep_guard_ros
