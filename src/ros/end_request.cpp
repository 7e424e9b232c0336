#include "ros/end_request.h"

#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

namespace sweep_guard_ros {
namespace {

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

}  // namespace

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

}  // namespace sweep_guard_ros
