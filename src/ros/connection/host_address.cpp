#include "ros/connection/host_address.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <map>

#include "common/guarded_by.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kMaxNames = 64;

int family() {
  const char* const ipv6 = std::getenv("ROS_IPV6");
  return ipv6 != nullptr && std::strcmp(ipv6, "on") == 0 ? AF_UNSPEC : AF_INET;
}

bool isNumeric(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return inet_pton(AF_INET, host.c_str(), bytes.data()) == 1 || inet_pton(AF_INET6, host.c_str(), bytes.data()) == 1;
}

/// A name that the C library resolves in a thread of its own. Must live until then.
class Lookup {
 public:
  explicit Lookup(std::string name) : name_(std::move(name)) {
    hints_.ai_family = family();
    hints_.ai_socktype = SOCK_STREAM;
    request_.ar_name = name_.c_str();
    request_.ar_request = &hints_;
    gaicb* requests[] = {&request_};
    started_ = getaddrinfo_a(GAI_NOWAIT, requests, 1, nullptr) == 0;
  }
  ~Lookup() {
    if (started_ && request_.ar_result != nullptr) freeaddrinfo(request_.ar_result);
  }
  Lookup(const Lookup&) = delete;
  Lookup& operator=(const Lookup&) = delete;

  bool done() { return !started_ || gai_error(&request_) != EAI_INPROGRESS; }
  std::optional<std::string> address() {  // once it is done
    std::array<char, NI_MAXHOST> text{};
    if (!started_ || gai_error(&request_) != 0) return std::nullopt;
    const addrinfo& first = *request_.ar_result;
    if (getnameinfo(first.ai_addr, first.ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0) {
      return std::nullopt;
    }
    return text.data();
  }

 private:
  const std::string name_;
  addrinfo hints_{};
  gaicb request_{};
  bool started_ = false;
};

/// Those that failed are forgotten.
class Lookups {
 public:
  std::optional<std::string> find(const std::string& host) {
    const sweep_guard_core::Lock lock(mutex_);
    if (lookups_.count(host) == 0 && lookups_.size() >= kMaxNames) forgetDone();
    if (lookups_.count(host) == 0 && lookups_.size() >= kMaxNames) return std::nullopt;
    const auto lookup = lookups_.try_emplace(host, host).first;
    if (!lookup->second.done()) return std::nullopt;
    auto address = lookup->second.address();
    if (!address) lookups_.erase(lookup);
    return address;
  }

 private:
  void forgetDone() REQUIRES(mutex_) {
    for (auto lookup = lookups_.begin(); lookup != lookups_.end();) {
      lookup = lookup->second.done() ? lookups_.erase(lookup) : std::next(lookup);
    }
  }

  sweep_guard_core::Mutex mutex_;
  std::map<std::string, Lookup> lookups_ GUARDED_BY(mutex_);
};

}  // namespace

std::optional<std::string> hostAddress(const std::string& host) {
  static Lookups& lookups = *new Lookups;  // never destroyed: a lookup may outlive main()
  return isNumeric(host) ? host : lookups.find(host);
}

}  // namespace sweep_guard_ros
