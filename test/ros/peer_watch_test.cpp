// What the processes of guard and merger do about publishers that cannot be reached for a while.
#include <arpa/inet.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <ros/connection_manager.h>
#include <ros/header.h>
#include <ros/master.h>
#include <ros/xmlrpc_manager.h>
#include <signal.h>
#include <std_msgs/String.h>
#include <sweep_guard/Warning.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

#include "child_process.h"
#include "guard_probe.h"
#include "guard_process.h"
#include "ros/connection/publisher_links.h"

namespace sweep_guard_ros {
namespace {

using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kSetUp(60);          // roscpp pauses for up to 20 s before it tries again
constexpr std::chrono::seconds kConnectedAnew(10);  // of which the guard promises 7 at most

bool becomesTrue(const std::function<bool()>& fact, std::chrono::seconds limit = kSetUp) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (std::chrono::steady_clock::now() < end) {
    if (fact()) return true;
    ros::WallDuration(0.01).sleep();
  }
  return false;
}

std::string addressOf(const std::string& node) {
  const auto found = xmlRpc().call(ros::master::getURI(), "lookupNode", {XmlRpcValue(node)});
  return found && found->success ? static_cast<std::string>(found->value) : "";
}

/// A second address of this process, where it can be made unreachable. Topics are connected as before.
class Address : public XmlRpc::XmlRpcServerMethod {
 public:
  /// @param topics  TCP port that subscribers are sent to; 0: that of this process
  explicit Address(int topics = 0)
      : XmlRpcServerMethod("requestTopic"),
        topics_(topics != 0 ? topics : static_cast<int>(ros::ConnectionManager::instance()->getTCPPort())) {
    server_.addMethod(this);
    open();
  }

  void open() { server_.bindAndListen(port_), port_ = server_.get_port(); }
  void close() { server_.shutdown(); }
  void serveFor(double seconds) { server_.work(seconds); }
  std::string uri(const std::string& host = "127.0.0.1") const {
    return "http://" + host + ":" + std::to_string(port_);
  }
  int requests() const { return requests_; }

  void execute(XmlRpcValue& /*request*/, XmlRpcValue& answer) override {
    ++requests_;
    answer[0] = 1;
    answer[1] = "";
    answer[2][0] = "TCPROS";
    answer[2][1] = "127.0.0.1";
    answer[2][2] = topics_;
  }

 private:
  XmlRpc::XmlRpcServer server_;
  const int topics_;
  int port_ = 0;
  int requests_ = 0;
};

// Tells a node that this process and another address publish a topic.
bool announce(const std::string& node, const std::string& topic, const std::string& uri) {
  XmlRpcValue publishers;
  publishers[0] = ros::XMLRPCManager::instance()->getServerURI();
  publishers[1] = uri;
  const auto answer = xmlRpc().call(addressOf(node), "publisherUpdate", {XmlRpcValue(topic), publishers});
  return answer && answer->success;
}

bool publishPoses(const std::string& uri) { return announce("/sweep_guard", "/tool_pose", uri); }

bool isConnectedAnew(Address& address) {
  return becomesTrue(
      [&] {
        address.close();
        ros::WallDuration(0.5).sleep();
        address.open();
        address.serveFor(0.5);
        return address.requests() == 2;
      },
      kConnectedAnew);
}

/// A port that accepts subscribers.
class Port {
 public:
  Port() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listener_, 8) != 0 ||
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      throw std::runtime_error("no port");
    }
    port_ = ntohs(address.sin_port);
  }
  virtual ~Port() { close(listener_); }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  int port() const { return port_; }

 protected:
  void start() {
    thread_ = std::thread([this] {
      for (int subscriber = 0; (subscriber = accept(listener_, nullptr, nullptr)) >= 0; close(subscriber)) {
        serve(subscriber);
      }
    });
  }
  void stop() {
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
  }

 private:
  virtual void serve(int subscriber) const = 0;

  const int listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int port_ = 0;
  std::thread thread_;
};

/// Each subscriber is disconnected at once.
class ClosedStream : public Port {
 public:
  ClosedStream() { start(); }
  ~ClosedStream() override { stop(); }

 private:
  void serve(int /*subscriber*/) const override {}
};

/// Each subscriber to poses gets a header, and then the length of a message of two gigabytes.
class TornStream : public Port {
 public:
  TornStream() { start(); }
  ~TornStream() override { stop(); }

 private:
  void serve(int subscriber) const override {
    ros::M_string header{{"callerid", "/torn"},
                         {"md5sum", ros::message_traits::md5sum<geometry_msgs::PoseStamped>()},
                         {"type", "geometry_msgs/PoseStamped"}};
    boost::shared_array<std::uint8_t> fields;
    std::uint32_t size = 0;
    ros::Header::write(header, fields, size);
    const std::string length(reinterpret_cast<const char*>(&size), sizeof size);
    const std::string answer =
        length + std::string(reinterpret_cast<const char*>(fields.get()), size) + "\xff\xff\xff\x7f";
    char received[4096];
    if (recv(subscriber, received, sizeof received, 0) <= 0) return;
    send(subscriber, answer.data(), answer.size(), MSG_NOSIGNAL);
    while (recv(subscriber, received, sizeof received, 0) > 0) {
    }
  }
};

bool registerPoses(const std::string& node, const std::string& uri) {
  XmlRpcValue request;
  request[0] = node;
  request[1] = "/tool_pose";
  request[2] = "geometry_msgs/PoseStamped";
  request[3] = uri;
  XmlRpcValue answer;
  XmlRpc::XmlRpcClient master(ros::master::getHost().c_str(), static_cast<int>(ros::master::getPort()), "/");
  return master.execute("registerPublisher", request, answer) && static_cast<int>(answer[0]) == 1;
}

// It may have registered a moment ago, since the connections were read.
TEST(PublisherLinksTest, AnUpdateKeepsThePublishersThatItDoesNotName) {
  std::map<std::string, ChildProcess> publishers;
  for (const char* const name : {"one", "two"}) {
    publishers.try_emplace(name, std::vector<std::string>{"rostopic", "pub", "-l", "/links", "std_msgs/String", "text",
                                                          std::string("__name:=") + name});
  }
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe(
      "/links", 1, +[](const std_msgs::String::ConstPtr&) {});
  const auto connected = [] { return (*connectedPublishers(xmlRpc()))["/links"]; };
  ASSERT_TRUE(becomesTrue([&] { return connected().size() == 2; }));
  const std::string one = addressOf("/one");
  const std::string two = addressOf("/two");
  EXPECT_TRUE(updatePublishers(xmlRpc(), "/links", {}, {one}));
  EXPECT_EQ(connected(), Publishers{two});
  EXPECT_TRUE(updatePublishers(xmlRpc(), "/links", {one}));
  EXPECT_TRUE(becomesTrue([&] { return connected() == Publishers{one, two}; }));
}

/// Takes the numbers of sockets that were closed for others, which are open.
class TakenNumbers {
 public:
  TakenNumbers() {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) throw std::runtime_error("no sockets");
    numbers_ = {pair[0], pair[1]};
    while (numbers_.size() < 100) numbers_.push_back(dup(pair[0]));
  }
  ~TakenNumbers() {
    for (const int number : numbers_) close(number);
  }
  TakenNumbers(const TakenNumbers&) = delete;
  TakenNumbers& operator=(const TakenNumbers&) = delete;

 private:
  std::vector<int> numbers_;
};

// roscpp names a socket by its number also after it has closed it.
TEST(PublisherLinksTest, AClosedConnectionIsDownAlsoWhereAnotherSocketHasItsNumber) {
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe(
      "/closed", 1, +[](const std_msgs::String::ConstPtr&) {});
  const ClosedStream stream;
  Address address(stream.port());
  ASSERT_TRUE(announce(ros::this_node::getName(), "/closed", address.uri()));
  const auto isDown = [&] { return (*publisherLinks(xmlRpc())).down["/closed"] == Publishers{address.uri() + "/"}; };
  ASSERT_TRUE(becomesTrue([&] { return address.serveFor(0.1), isDown(); }));
  const TakenNumbers numbers;
  EXPECT_TRUE(isDown());
}

struct Silence {
  const char* name;
  std::function<void(GuardProbe&)> begin;
};
void PrintTo(const Silence& silence, std::ostream* out) { *out << silence.name; }

class PeerWatchTest : public testing::TestWithParam<Silence> {};

// Publishers of poses: the guard connects to the address anew once it answers again.
TEST_P(PeerWatchTest, ConnectsAnewToAPublisherThatWasOutOfReach) {
  ChildProcess guard(guardWith({"_timing/mesh_timeout:=inf"}));
  GuardProbe probe(/*drives_clock=*/false);
  probe.place(squareAt("square", {0, 0, -1}, ros::Time::now()));
  GetParam().begin(probe);
  Address address;
  ASSERT_TRUE(publishPoses(address.uri()));
  ASSERT_TRUE(becomesTrue([&] { return address.serveFor(0.3), address.requests() == 1; }));
  EXPECT_TRUE(isConnectedAnew(address));
  guard.signal(SIGTERM);
  EXPECT_EQ(guard.wait(), 0);
  ros::param::del("/sweep_guard");
}

TEST(MergerPeerWatchTest, ConnectsAnewToAGuardThatWasOutOfReach) {
  ChildProcess merger(program("warning_merger_node", {"__name:=merger", "_guards:=[/far]"}));
  const ros::Publisher guard = ros::NodeHandle().advertise<sweep_guard::Warning>("/far/warning", 1);
  ASSERT_TRUE(becomesTrue([&] { return guard.getNumSubscribers() == 1; }));
  Address address;
  ASSERT_TRUE(announce("/merger", "/far/warning", address.uri()));
  ASSERT_TRUE(becomesTrue([&] { return address.serveFor(0.3), address.requests() == 1; }));
  EXPECT_TRUE(isConnectedAnew(address));
  merger.signal(SIGTERM);
  EXPECT_EQ(merger.wait(), 0);
  ros::param::del("/merger");
}

// roscpp takes the stream for lost, disconnects and does not come back.
TEST(TornPublisherTest, IsConnectedAnew) {
  ChildProcess guard(guardWith({}));
  const GuardProbe probe(/*drives_clock=*/false);
  const TornStream stream;
  Address address(stream.port());
  ASSERT_TRUE(registerPoses("/torn", address.uri()));
  ASSERT_TRUE(becomesTrue([&] { return address.serveFor(0.3), address.requests() >= 1; }));
  EXPECT_TRUE(becomesTrue([&] { return address.serveFor(0.3), address.requests() >= 2; }, kConnectedAnew));
  guard.signal(SIGTERM);
  EXPECT_EQ(guard.wait(), 0);
  ros::param::del("/sweep_guard");
}

// roscpp by itself would try again after 0.1 s to 20 s, at the same port, and ask for no other.
TEST(ClosedPublisherTest, IsAskedAgainForItsPort) {
  ChildProcess guard(guardWith({}));
  const GuardProbe probe(/*drives_clock=*/false);
  const ClosedStream stream;
  Address address(stream.port());
  ASSERT_TRUE(publishPoses(address.uri()));
  ASSERT_TRUE(becomesTrue([&] { return address.serveFor(0.3), address.requests() >= 1; }));
  EXPECT_TRUE(becomesTrue([&] { return address.serveFor(0.3), address.requests() >= 3; }, kConnectedAnew));
  guard.signal(SIGTERM);
  EXPECT_EQ(guard.wait(), 0);
  ros::param::del("/sweep_guard");
}

// The guard has not looked up this spelling before.
TEST(NamedPublisherTest, StaysConnectedWhileItsNameIsLookedUp) {
  ChildProcess guard(guardWith({}));
  const GuardProbe probe(/*drives_clock=*/false);
  Address address;
  ASSERT_TRUE(publishPoses(address.uri("LocalHost")));
  ASSERT_TRUE(becomesTrue([&] { return address.serveFor(0.3), address.requests() == 1; }));
  address.serveFor(1.0);
  EXPECT_EQ(address.requests(), 1);
  guard.signal(SIGTERM);
  EXPECT_EQ(guard.wait(), 0);
  ros::param::del("/sweep_guard");
}

INSTANTIATE_TEST_SUITE_P(Silent, PeerWatchTest,
                         testing::Values(Silence{"BeforeTheFirstPose", [](GuardProbe&) {}},
                                         Silence{"AfterAPose",
                                                 [](GuardProbe& probe) {
                                                   probe.move(poseAt({0, 0, 0.5}, ros::Time::now()));
                                                 }},
                                         Silence{"WhileDisabled", [](GuardProbe& probe) { probe.enable(false); }}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sweep_guard_ros
