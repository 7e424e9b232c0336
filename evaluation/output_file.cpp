#include "evaluation/output_file.h"

#include <filesystem>
#include <system_error>

#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::InvalidInput;

OutputFile::OutputFile(const std::string& path, const std::vector<std::string>& inputs) : path_(path) {
  if (path.empty()) return;
  std::error_code none;
  for (const std::string& input : inputs) {
    if (!std::filesystem::equivalent(path, input, none)) continue;
    throw InvalidInput(path + ": is an input and would be overwritten; give another file");
  }
  stream_.open(path);
  if (!stream_) throw InvalidInput(path + ": cannot be written; check folder and permissions");
}

void OutputFile::write(const std::string& text) {
  stream_ << text << std::flush;
  if (!stream_) throw InvalidInput(path_ + ": cannot be written; is the disk full?");
}

}  // namespace sweep_guard_evaluation
