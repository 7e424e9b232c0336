#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace sweep_guard_ros {

/// Makes a folder for one test, on ROS_PACKAGE_PATH and with the package `robot` in it. The destructor removes it and
/// restores ROS_PACKAGE_PATH.
class PackageFolder {
 public:
  PackageFolder() : path_(std::filesystem::canonical(testing::TempDir()) / ("tool_" + std::to_string(getpid()))) {
    const char* const before = std::getenv("ROS_PACKAGE_PATH");
    if (before != nullptr) before_ = before;
    std::filesystem::create_directories(package());
    write("robot/package.xml",
          "<package format='2'><name>robot</name><version>0.0.0</version><description>-</description>"
          "<maintainer email='a@example.org'>-</maintainer><license>BSD</license></package>");
    setPackagePath(path_.string());
  }
  PackageFolder(const PackageFolder&) = delete;
  PackageFolder& operator=(const PackageFolder&) = delete;
  ~PackageFolder() {
    setPackagePath(before_);
    std::filesystem::remove_all(path_);
  }

  static void setPackagePath(const std::string& folders) { setenv("ROS_PACKAGE_PATH", folders.c_str(), 1); }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path package() const { return path_ / "robot"; }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
  std::string before_;
};

/// Returns a tetrahedron with corners at the origin and at 1 on each axis.
inline std::string tetrahedronObj() {
  return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
}

}  // namespace sweep_guard_ros
