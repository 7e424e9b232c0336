#include "ros/peer_watch.h"

#include <netdb.h>
#include <poll.h>
#include <ros/console.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>
#include <sys/socket.h>
#include <unistd.h>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using XmlRpc::XmlRpcValue;

constexpr auto kPeriod = std::chrono::milliseconds(100);
constexpr int kLongestConnect = 200;  // [ms]
constexpr auto kLongestCall = std::chrono::milliseconds(500);

std::string ownUri() { return ros::XMLRPCManager::instance()->getServerURI(); }

/// Connects to an address without waiting.
class Probe {
 public:
  explicit Probe(const std::string& uri) {
    std::string host;
    std::uint32_t port = 0;
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (!ros::network::splitURI(uri, host, port)) return;
    if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) return;
    socket_ = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ >= 0) static_cast<void>(connect(socket_, found->ai_addr, found->ai_addrlen));
    freeaddrinfo(found);
  }
  ~Probe() {
    if (socket_ >= 0) close(socket_);
  }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  bool connected(int wait) const {
    pollfd events{socket_, POLLOUT, 0};
    return socket_ >= 0 && poll(&events, 1, wait) == 1 && events.revents == POLLOUT;
  }

 private:
  int socket_ = -1;
};

}  // namespace

PeerWatch::PeerWatch(const sweep_guard_core::WarningMonitor& monitor)
    : monitor_(monitor), call_(kLongestCall, stopping_) {}

PeerWatch::~PeerWatch() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void PeerWatch::start(Supervisor& supervisor) {
  top_ = &supervisor.add({"peers", /*watched=*/false});
  thread_ = std::thread([this] { run(); });
}

void PeerWatch::run() {
  top_->enter();
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, kPeriod, [this] { return stopping_.load(); })) {
    lock.unlock();
    top_->run([this] { checkOrLog(); });
    lock.lock();
  }
}

void PeerWatch::checkOrLog() {
  try {
    check();
  } catch (const XmlRpc::XmlRpcException& error) {
    ROS_ERROR_THROTTLE(60.0, "the list of connections cannot be read: %s", error.getMessage().c_str());
  }
}

void PeerWatch::check() {
  if (!inputIsStale()) return out_of_reach_.clear();
  const Topics topics = connections();
  std::map<std::string, Probe> probes;
  for (const auto& [topic, publishers] : topics) {
    for (const std::string& publisher : publishers) probes.try_emplace(publisher, publisher);
  }
  int wait = kLongestConnect;  // for all of them together
  for (const auto& [publisher, probe] : probes) {
    const bool connected = probe.connected(wait);
    if (!connected) wait = 0;
    if (!connected) {
      out_of_reach_.insert(publisher);
    } else if (out_of_reach_.erase(publisher) != 0) {
      connectAnew(publisher, topics);
    }
  }
}

bool PeerWatch::inputIsStale() {
  monitor_.warning(now(), warning_);
  return (warning_.reasons & (sweep_guard_core::kPoseStale | sweep_guard_core::kMeshStale)) != 0;
}

// Asks this node, as another node would.
PeerWatch::Topics PeerWatch::connections() const {
  Topics topics;
  const auto answer = call_.call(ownUri(), "getBusInfo", {});
  for (int i = 0; answer && i < answer->value.size(); ++i) {
    const XmlRpcValue& connection = answer->value[i];
    const std::string& publisher = connection[1];
    const std::string& direction = connection[2];
    if (direction == "i" && publisher != ownUri()) topics[connection[4]].insert(publisher);
  }
  return topics;
}

void PeerWatch::connectAnew(const std::string& publisher, const Topics& connections) const {
  for (const auto& [topic, publishers] : connections) {
    if (publishers.count(publisher) == 0) continue;
    std::set<std::string> others = publishers;
    others.erase(publisher);
    setPublishers(topic, others);
    setPublishers(topic, publishers);
  }
  ROS_WARN("%s was out of reach and is connected anew", publisher.c_str());
}

void PeerWatch::setPublishers(const std::string& topic, const std::set<std::string>& publishers) const {
  XmlRpcValue all;
  all.setSize(0);
  for (const std::string& publisher : publishers) all[all.size()] = publisher;
  call_.call(ownUri(), "publisherUpdate", {XmlRpcValue(topic), all});
}

}  // namespace sweep_guard_ros
