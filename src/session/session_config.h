#pragma once

#include <string>
#include <vector>

namespace sweep_guard_session {

/// Says in words with which parameters a session is played: one line for the file, then one for each recording of the black box
/// whose own file, beside it, differs. If the file belongs to none of the recordings it was chosen for all, and there is one line.
/// None without a file.
/// @param config  file of the parameters that the guard has
/// @param bags    files of the session
std::vector<std::string> describeConfig(const std::string& config, const std::vector<std::string>& bags);

}  // namespace sweep_guard_session
