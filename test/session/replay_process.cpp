#include "replay_process.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sweep_guard_session {

int freePort() {
  const int handle = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  EXPECT_EQ(bind(handle, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(handle);
  return ntohs(address.sin_port);
}

std::vector<std::vector<std::string>> readCsv(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> lines;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    lines.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) lines.back().push_back(field);
  }
  return lines;
}

std::string readText(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string replayBag(const std::filesystem::path& bag, const std::filesystem::path& folder,
                      const std::string& arguments, int port) {
  std::ostringstream command;
  command << "ROS_HOME=" << folder << " ROS_IP=127.0.0.1 ROS_MASTER_URI=http://127.0.0.1:" << port
          << " timeout 100 roslaunch -p " << port << " sweep_guard replay.launch bag:=" << bag
          << " output:=" << (folder / "report").string() << ' ' << arguments << " > " << folder / "printed.txt"
          << " 2>&1";
  EXPECT_EQ(std::system(command.str().c_str()), 0);
  return readText(folder / "printed.txt");
}

}  // namespace sweep_guard_session
