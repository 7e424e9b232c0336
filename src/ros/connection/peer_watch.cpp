#include "ros/connection/peer_watch.h"

#include <netdb.h>
#include <poll.h>
#include <ros/console.h>
#include <ros/network.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "ros/connection/host_address.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kPeerPeriod = std::chrono::milliseconds(100);
constexpr auto kLongestConnect = std::chrono::milliseconds(200);
constexpr int kLooksDown = 10;  // until a connection that is down is made anew: roscpp tries after 0.1, 0.3 and 0.7 s
constexpr auto kNewName = std::chrono::milliseconds(100);  // until a name is resolved for the first time

int millisecondsUntil(sweep_guard_core::SteadyTime end) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
  return std::max(0, static_cast<int>(left.count()));
}

/// Connects to an address without waiting.
class Probe {
 public:
  explicit Probe(const std::string& uri) { open(uri); }
  ~Probe() {
    if (socket_ >= 0) close(socket_);
  }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  bool begun() const { return socket_ >= 0; }  ///< false: the address is not known yet

  void open(const std::string& uri) {
    std::string host;
    std::uint32_t port = 0;
    if (!ros::network::splitURI(uri, host, port)) return;
    const auto address = hostAddress(host);
    if (!address) return;
    addrinfo hints{};
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (getaddrinfo(address->c_str(), std::to_string(port).c_str(), &hints, &found) != 0) return;
    socket_ = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ >= 0) static_cast<void>(connect(socket_, found->ai_addr, found->ai_addrlen));
    freeaddrinfo(found);
  }

  bool connected(sweep_guard_core::SteadyTime deadline) const {
    pollfd events{socket_, POLLOUT, 0};
    return begun() && poll(&events, 1, millisecondsUntil(deadline)) == 1 && events.revents == POLLOUT;
  }

 private:
  int socket_ = -1;
};

// A name that was never looked up is no sign of a broken link.
void beginOthers(std::map<std::string, Probe>& probes) {
  const auto begun = [](const auto& probe) { return probe.second.begun(); };
  if (std::all_of(probes.begin(), probes.end(), begun)) return;
  std::this_thread::sleep_for(kNewName);
  for (auto& [publisher, probe] : probes) {
    if (!probe.begun()) probe.open(publisher);
  }
}

}  // namespace

PeerWatch::PeerWatch(MasterThread& thread, std::function<bool()> input_may_be_silent)
    : input_may_be_silent_(std::move(input_may_be_silent)), call_(thread.call()) {
  thread.every(kPeerPeriod, [this] { checkOrLog(); });
}

void PeerWatch::checkOrLog() {
  try {
    check();
  } catch (const XmlRpc::XmlRpcException& error) {
    ROS_ERROR_THROTTLE(60.0, "the list of connections cannot be read: %s", error.getMessage().c_str());
  }
}

void PeerWatch::check() {
  connectPending();
  if (!input_may_be_silent_()) {
    out_of_reach_.clear();
    looks_down_.clear();
    return;
  }
  const auto links = publisherLinks(call_);
  if (!links) return;
  std::map<std::string, Probe> probes;
  for (const auto& [topic, publishers] : links->all) {
    for (const std::string& publisher : publishers) {
      if (publisher != ownUri()) probes.try_emplace(publisher, publisher);
    }
  }
  beginOthers(probes);
  const auto deadline = std::chrono::steady_clock::now() + kLongestConnect;  // for all of them together
  for (const auto& [publisher, probe] : probes) {
    if (!probe.connected(deadline)) {
      out_of_reach_.insert(publisher);
    } else if (out_of_reach_.erase(publisher) != 0) {
      connectAnew(publisher, links->all);
    } else if (staysDown(publisher, links->down)) {
      connectAnew(publisher, links->down);
    }
  }
}

bool PeerWatch::staysDown(const std::string& publisher, const PublishersOfTopics& down) {
  const auto holds = [&](const auto& topic) { return topic.second.count(publisher) != 0; };
  int& looks = looks_down_[publisher];
  looks = std::any_of(down.begin(), down.end(), holds) ? looks + 1 : 0;
  return looks > 0 && looks % kLooksDown == 0;
}

void PeerWatch::connectAnew(const std::string& publisher, const PublishersOfTopics& topics) {
  for (const auto& [topic, publishers] : topics) {
    if (publishers.count(publisher) == 0) continue;
    pending_[topic].insert(publisher);
    updatePublishers(call_, topic, /*added=*/{}, /*removed=*/{publisher});
  }
  connectPending();
  ROS_WARN_THROTTLE(10.0, "%s was out of reach and is connected anew", publisher.c_str());
}

// Until it succeeds: nobody else knows that they are to be connected.
void PeerWatch::connectPending() {
  for (auto topic = pending_.begin(); topic != pending_.end();) {
    topic = updatePublishers(call_, topic->first, topic->second) ? pending_.erase(topic) : std::next(topic);
  }
}

}  // namespace sweep_guard_ros
