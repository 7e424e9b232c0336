#include "ros/threads/kernel_thread.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <future>
#include <thread>

namespace sweep_guard_ros {
namespace {

using Activity = ThreadState::Activity;

/// No file can be opened while it lives.
class NoDescriptors {
 public:
  NoDescriptors() {
    getrlimit(RLIMIT_NOFILE, &limit_);
    const rlimit none{0, limit_.rlim_max};
    setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoDescriptors() { setrlimit(RLIMIT_NOFILE, &limit_); }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;

 private:
  rlimit limit_{};
};

TEST(KernelThreadTest, StateIsReadWithoutFreeDescriptors) {
  std::promise<const KernelThread*> begun;
  std::promise<void> go_on;
  std::thread thread([&] {
    const KernelThread self;
    begun.set_value(&self);
    go_on.get_future().wait();
  });
  const KernelThread& blocked = *begun.get_future().get();
  const KernelThread self;
  {
    const NoDescriptors none;
    for (int i = 0; i < 1000 && blocked.state().activity == Activity::kRunnable; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(blocked.state().activity, Activity::kBlocked);
    EXPECT_EQ(self.state().activity, Activity::kRunnable);
  }
  go_on.set_value();
  thread.join();
}

}  // namespace
}  // namespace sweep_guard_ros
