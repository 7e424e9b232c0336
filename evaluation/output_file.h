#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace sweep_guard_evaluation {

/// Opens a file for the results before the work begins. Refuses it if it is not writable or is one of the inputs.
class OutputFile {
 public:
  /// @param path  empty: no file is requested
  /// @throws sweep_guard_core::InvalidInput  if the file is refused
  OutputFile(const std::string& path, const std::vector<std::string>& inputs);

  bool requested() const { return !path_.empty(); }

  /// @throws sweep_guard_core::InvalidInput  if the disk is full
  void write(const std::string& text);

 private:
  std::string path_;
  std::ofstream stream_;
};

}  // namespace sweep_guard_evaluation
