#pragma once

#include <string>
#include <string_view>

namespace sweep_guard_core {

/// Returns the name of a tf frame without the slash that names had at their front before tf2, if it has one.
std::string withoutSlash(std::string_view frame);

/// Returns whether two names are those of one tf frame, with such a slash or without. Does not allocate.
bool isSameFrame(std::string_view a, std::string_view b);

}  // namespace sweep_guard_core
