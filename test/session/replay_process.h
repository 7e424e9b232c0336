#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sweep_guard_session {

int freePort();  ///< for the moment

/// Plays a bag with replay.launch at a master of its own, and returns what it printed. Its report is in `folder`/report; what
/// it leaves in ROS_HOME is in `folder`, too.
/// @param arguments  further ones of the launch file
/// @param port       of the master
std::string replayBag(const std::filesystem::path& bag, const std::filesystem::path& folder,
                      const std::string& arguments, int port = freePort());

/// Returns the cells of a report's file by line.
std::vector<std::vector<std::string>> readCsv(const std::filesystem::path& path);

std::string readText(const std::filesystem::path& path);

}  // namespace sweep_guard_session
