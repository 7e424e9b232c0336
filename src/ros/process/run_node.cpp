#include "ros/process/run_node.h"

#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <thread>

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
  void run();

  const std::chrono::milliseconds time_to_end_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool awaited_ = false;
  bool requested_ = false;
  bool done_ = false;
  std::thread thread_;
};

std::array<int, 2> request_pipe;  // a signal handler may only write

void request(int /*signal*/ = 0) {
  const int before = errno;
  const char byte = 0;
  [[maybe_unused]] const auto written = write(request_pipe[1], &byte, 1);
  errno = before;
}

void onShutdownCall(XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& result) {
  if (parameters.size() > 1) request();
  result = ros::xmlrpc::responseInt(1, "", 0);
}

EndRequest::EndRequest(std::chrono::milliseconds time_to_end) : time_to_end_(time_to_end) {
  if (pipe(request_pipe.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  ros::XMLRPCManager::instance()->bind("shutdown", onShutdownCall);
  thread_ = std::thread([this] { run(); });
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
}

EndRequest::~EndRequest() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  changed_.notify_all();
  request();
  thread_.join();
}

void EndRequest::await() {
  std::unique_lock lock(mutex_);
  awaited_ = true;
  changed_.wait(lock, [this] { return requested_; });
}

void EndRequest::run() {
  char byte = 0;
  while (read(request_pipe[0], &byte, 1) < 0 && errno == EINTR) continue;
  std::unique_lock lock(mutex_);
  requested_ = true;
  changed_.notify_all();
  const auto done = [this] { return done_; };
  if (!done() && (!awaited_ || !changed_.wait_for(lock, time_to_end_, done))) std::_Exit(EXIT_SUCCESS);
}

}  // namespace

int runNode(const char* name, int argc, char** argv, const std::function<std::shared_ptr<void>()>& start,
            std::chrono::milliseconds time_to_end) {
  return sweep_guard_core::runProgram(name, [&] {
    shareHeaps();
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
