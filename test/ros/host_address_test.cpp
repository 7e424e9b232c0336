#include "ros/connection/host_address.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace sweep_guard_ros {
namespace {

using namespace std::chrono_literals;

TEST(HostAddressTest, ANumericAddressIsItself) {
  EXPECT_EQ(hostAddress("192.0.2.1"), "192.0.2.1");
  EXPECT_EQ(hostAddress("::1"), "::1");
}

TEST(HostAddressTest, ANameIsResolvedToIpv4) {
  std::optional<std::string> address;
  for (int i = 0; i < 1000 && !address; ++i) {
    address = hostAddress("localhost");
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_EQ(address, "127.0.0.1");
  EXPECT_EQ(hostAddress("localhost"), address);
}

TEST(HostAddressTest, NamesThatCannotBeResolvedTakeNoTime) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(hostAddress("host" + std::to_string(i) + ".invalid"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 500ms);
}

}  // namespace
}  // namespace sweep_guard_ros
