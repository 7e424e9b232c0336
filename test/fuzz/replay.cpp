// replay_inputs TARGET FOLDER...: runs a target on the files of folders, without libFuzzer: what was found once must not come again. The
// first folder has files.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "target.h"

namespace sweep_guard_fuzz {
namespace {

std::vector<std::uint8_t> contentsOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> read{std::istreambuf_iterator<char>(stream), {}};
  return {read.begin(), read.end()};
}

/// Returns how many files there are.
int runOn(const std::filesystem::path& folder, RunTarget run) {
  if (!std::filesystem::is_directory(folder)) return 0;  // nothing was found yet
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::cerr << entry.path().string() << std::endl;  // the last one is that of a crash
    const std::vector<std::uint8_t> bytes = contentsOf(entry.path());
    run(Input(bytes.data(), bytes.size()));
    ++count;
  }
  return count;
}

}  // namespace
}  // namespace sweep_guard_fuzz

int main(int argc, char** argv) {
  bool complete = argc > 2;
  for (int i = 2; i < argc; ++i) {
    const int count = sweep_guard_fuzz::runOn(argv[i], sweep_guard_fuzz::targets().at(argv[1]));
    std::cout << count << " inputs in " << argv[i] << std::endl;
    complete = complete && (i > 2 || count > 0);
  }
  return complete ? 0 : 1;
}
