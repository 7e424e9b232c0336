#include "ros/process/process.h"

#include <malloc.h>
#include <netinet/in.h>
#include <pthread.h>
#include <ros/console.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kHeadroom = 256;                 // [MiB]
constexpr std::uint64_t kShortestSlice = 100000;  // [ns]

// As in linux/sched/types.h, which clashes with sched.h on older systems.
struct SchedulingAttributes {
  std::uint32_t size;
  std::uint32_t policy;
  std::uint64_t flags;
  std::int32_t nice;
  std::uint32_t priority;
  std::uint64_t runtime;  // of SCHED_OTHER: the time slice [ns]
  std::uint64_t deadline;
  std::uint64_t period;
};

[[maybe_unused]] size_t addressSpace() {  // [MiB]
  std::ifstream statm("/proc/self/statm");
  size_t pages = 0;
  statm >> pages;
  return pages * static_cast<size_t>(sysconf(_SC_PAGESIZE)) >> 20U;
}

bool listensOn(int socket, int port) {
  int listens = 0;
  socklen_t size = sizeof listens;
  if (getsockopt(socket, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size) != 0 || listens == 0) return false;
  sockaddr_in address{};
  size = sizeof address;
  return getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0 && ntohs(address.sin_port) == port;
}

bool isLoopback(const std::string& host) { return host == "localhost" || host == "::1" || host.rfind("127.", 0) == 0; }

}  // namespace

void logInUtf8() { std::setlocale(LC_CTYPE, "C.UTF-8"); }

// roscpp has no setting for the address of its server, and does not hand out the socket.
void keepToLoopback() {
  if (!isLoopback(ros::network::getHost())) return;
  const auto port = static_cast<int>(ros::XMLRPCManager::instance()->getServerPort());
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", unreadable)) {
    const int socket = std::stoi(entry.path().filename());
    if (!listensOn(socket, port)) continue;
    constexpr char kLoopback[] = "lo";
    if (setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, kLoopback, sizeof kLoopback) == 0) return;
  }
  ROS_WARN("other hosts can call this node, although ROS_IP or ROS_HOSTNAME names the loopback interface");
}

// SCHED_RESET_ON_FORK: threads started by this one do not inherit the priority.
std::string requestRealTime(int priority, const std::string& parameter) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters);
  if (error == 0) return {};
  return "real-time priority " + std::to_string(priority) + " is refused: " + std::generic_category().message(error) +
         ". Allow it with the line 'USER - rtprio " + std::to_string(priority) +
         "' in /etc/security/limits.conf and a new login, or set " + parameter + " to 0";
}

void limitRealTime(sweep_guard_core::Duration longest) {
  rlimit limit{};
  getrlimit(RLIMIT_RTTIME, &limit);
  const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(longest).count();
  limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(microseconds));
  setrlimit(RLIMIT_RTTIME, &limit);
}

void setPrompt() {
  prctl(PR_SET_TIMERSLACK, 1UL);  // [ns]
  SchedulingAttributes attributes{};
  if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
  attributes.runtime = kShortestSlice;
  syscall(SYS_sched_setattr, 0, &attributes, 0);
}

void setIdle() {
  const sched_param parameters{};
  pthread_setschedparam(pthread_self(), SCHED_IDLE, &parameters);
}

// On Linux, setpriority() is of one thread.
void setNice(int nice) { setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), nice); }

void shareHeaps() {
#ifdef M_ARENA_MAX  // glibc
  mallopt(M_ARENA_MAX, 2);
#endif
}

void keepFreedMemory() {
#ifdef M_MMAP_THRESHOLD  // glibc, which refuses more than 32 MiB
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 32 << 20);
#endif
}

void limitMemory(size_t max_memory) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  if (max_memory == 0) return;
  const size_t taken = addressSpace();
  if (taken + kHeadroom > max_memory) {
    throw sweep_guard_core::InvalidInput("limits/memory is " + std::to_string(max_memory) +
                                         " MiB, and the guard takes " + std::to_string(taken) +
                                         " MiB of address space already: set more, or 0 for no limit");
  }
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, rlim_t{max_memory} << 20U);
  if (setrlimit(RLIMIT_AS, &limit) != 0) throw sweep_guard_core::DeviceError("cannot limit the memory of the process");
#else
  static_cast<void>(max_memory);
#endif
}

}  // namespace sweep_guard_ros
