#include "ros/output/flush.h"

#include <ros/init.h>
#include <ros/poll_manager.h>

#include <condition_variable>
#include <memory>

#include "common/guarded_by.h"

namespace sweep_guard_ros {
namespace {

// roscpp sends in the rounds of its poll thread: one that runs already may have passed the publishers, the next takes the
// messages from them and then writes to the sockets, and the last one shows that this is done.
constexpr int kRounds = 3;
constexpr auto kMaxWait = std::chrono::milliseconds(200);

struct Rounds {
  sweep_guard_core::Mutex mutex;
  std::condition_variable_any changed;
  int count GUARDED_BY(mutex) = 0;
};

}  // namespace

void flush() {
  if (!ros::isStarted() || ros::isShuttingDown()) return;
  const auto rounds = std::make_shared<Rounds>();
  const auto& poll_manager = ros::PollManager::instance();
  const auto connection = poll_manager->addPollThreadListener([rounds, poll_manager] {
    const sweep_guard_core::Lock lock(rounds->mutex);
    ++rounds->count;
    rounds->changed.notify_all();
    if (rounds->count < kRounds) poll_manager->getPollSet().signal();
  });
  poll_manager->getPollSet().signal();
  {
    sweep_guard_core::Lock lock(rounds->mutex);
    const auto end = std::chrono::steady_clock::now() + kMaxWait;
    while (rounds->count < kRounds && rounds->changed.wait_until(lock, end) == std::cv_status::no_timeout) continue;
  }
  poll_manager->removePollThreadListener(connection);
}

}  // namespace sweep_guard_ros
