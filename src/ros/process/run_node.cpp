#include "ros/process/run_node.h"

#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include "common/run_program.h"
#include "ros/output/start_failure.h"
#include "ros/process/process.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

// Takes SIGINT, SIGTERM and the call `shutdown` of a node's XML-RPC interface (rosnode kill) as a request to end.
// roscpp's own handlers would close the publishers before the last warning. Once in a process, after ros::init() with
// NoSigintHandler and before the first node handle: of two handlers of a call, roscpp keeps the first.
class EndRequest {
 public:
  // @param time_to_end  that the process has from a request on
  explicit EndRequest(std::chrono::milliseconds time_to_end);
  ~EndRequest();  // the end is done
  EndRequest(const EndRequest&) = delete;
  EndRequest& operator=(const EndRequest&) = delete;

  // Returns when the end is requested. What is not done in time is left to the kernel, and the exit status is 0. Before this
  // call, a request ends the process at once.
  void await();

 private:
  const std::chrono::milliseconds time_to_end_;
};

std::array<int, 2> request_pipe;  // a signal handler may only write
std::atomic<bool> ends_at_once = true;

void endNow(int /*signal*/) { std::_Exit(EXIT_SUCCESS); }

void request(int signal = 0) {
  if (ends_at_once) endNow(signal);
  const int before = errno;
  const char byte = 0;
  [[maybe_unused]] const auto written = write(request_pipe[1], &byte, 1);
  errno = before;
}

void onShutdownCall(XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& result) {
  if (parameters.size() > 1) request();
  result = ros::xmlrpc::responseInt(1, "", 0);
}

void alarmIn(std::chrono::milliseconds time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  const itimerval timer{{}, {seconds.count(), std::chrono::microseconds(time - seconds).count()}};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

EndRequest::EndRequest(std::chrono::milliseconds time_to_end) : time_to_end_(time_to_end) {
  if (pipe(request_pipe.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  ros::XMLRPCManager::instance()->bind("shutdown", onShutdownCall);
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
  std::signal(SIGALRM, endNow);
}

EndRequest::~EndRequest() {
  ends_at_once = false;
  alarmIn(std::chrono::milliseconds(0));
}

void EndRequest::await() {
  ends_at_once = false;
  char byte = 0;
  while (read(request_pipe[0], &byte, 1) < 0 && errno == EINTR) continue;
  alarmIn(time_to_end_);
}

}  // namespace

int runNode(const char* name, int argc, char** argv, const std::function<std::shared_ptr<void>()>& start,
            std::chrono::milliseconds time_to_end) {
  return sweep_guard_core::runProgram(name, [&] {
    shareHeaps();
    logInUtf8();
    ros::init(argc, argv, name, ros::init_options::NoSigintHandler);  // throws at a refused name or remapping
    EndRequest end(time_to_end);
    const ros::NodeHandle alive;  // the console is silent without a handle
    keepToLoopback();
    try {
      const std::shared_ptr<void> node = start();
      end.await();
    } catch (const sweep_guard_core::Error& error) {
      reportStartFailure(ros::NodeHandle(), ros::this_node::getName(), error.what());
      return 2;
    }
    return 0;
  });
}

}  // namespace sweep_guard_ros
