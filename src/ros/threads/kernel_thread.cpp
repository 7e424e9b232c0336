#include "ros/threads/kernel_thread.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

namespace sweep_guard_ros {
namespace {

using Activity = ThreadState::Activity;

sweep_guard_core::Duration read(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// The letter follows the name, which may hold anything.
char stateLetter(int stat_file) {
  char text[128];
  const ssize_t length = pread(stat_file, text, sizeof text - 1, 0);
  text[length < 0 ? 0 : length] = '\0';
  const char* const name_end = std::strrchr(text, ')');
  return name_end == nullptr || name_end[1] == '\0' ? '?' : name_end[2];
}

Activity activityOf(char letter) {
  if (letter == 'R') return Activity::kRunnable;
  return letter == 'S' || letter == 'D' ? Activity::kBlocked : Activity::kStopped;
}

}  // namespace

KernelThread::KernelThread() {
  pthread_getcpuclockid(pthread_self(), &clock_);
  char name[64];
  std::snprintf(name, sizeof name, "/proc/self/task/%ld/stat", syscall(SYS_gettid));
  stat_file_ = open(name, O_RDONLY | O_CLOEXEC);
}

KernelThread::~KernelThread() {
  if (stat_file_ >= 0) close(stat_file_);
}

ThreadState KernelThread::state() const { return {read(clock_), activityOf(stateLetter(stat_file_))}; }

}  // namespace sweep_guard_ros
