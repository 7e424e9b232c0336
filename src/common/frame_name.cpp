#include "common/frame_name.h"

namespace sweep_guard_core {
namespace {

std::string_view bare(std::string_view frame) { return frame.substr(frame.find_first_not_of('/') == 1 ? 1 : 0); }

}  // namespace

std::string withoutSlash(std::string_view frame) { return std::string(bare(frame)); }

bool isSameFrame(std::string_view a, std::string_view b) { return bare(a) == bare(b); }

}  // namespace sweep_guard_core
