#include "recording/recording.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "common/number_text.h"
#include "recording/bag.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_recording {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::StampedPose;

namespace {

constexpr std::uintmax_t kMaxFile = 256U << 20U;

constexpr std::size_t kColumns = 8;
constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kMaxPrinted = 40;
constexpr double kMinQuaternion = 1e-10;

using Columns = std::array<long double, kColumns>;

std::string_view nextWord(std::string_view* line) {
  line->remove_prefix(std::min(line->find_first_not_of(kBlanks), line->size()));
  const std::string_view word = line->substr(0, line->find_first_of(kBlanks));
  line->remove_prefix(word.size());
  return word;
}

/// Shortens a word and replaces control characters, which a terminal would obey.
std::string printable(std::string_view word) {
  std::string text(word.substr(0, kMaxPrinted));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return word.size() > kMaxPrinted ? text + "..." : text;
}

long double toNumber(std::string_view word) {
  const std::optional<long double> number = sweep_guard_core::parseNumber<long double>(word);
  if (!number || !std::isfinite(static_cast<double>(*number))) {
    throw InvalidInput("'" + printable(word) + "' is not a finite number; correct or remove the line");
  }
  return *number;
}

Columns toColumns(std::string_view line) {
  Columns columns{};
  std::size_t count = 0;
  for (std::string_view word = nextWord(&line); !word.empty(); word = nextWord(&line), ++count) {
    if (count < kColumns) columns[count] = toNumber(word);
  }
  if (count != kColumns) {
    throw InvalidInput(std::to_string(count) +
                       " numbers instead of the 8 of 'stamp tx ty tz qx qy qz qw'; correct or remove the line");
  }
  return columns;
}

sweep_guard_core::Time toStamp(long double seconds) {
  using LongSeconds = std::chrono::duration<long double>;
  constexpr long double kMaxSize = LongSeconds(sweep_guard_core::Duration::max()).count() / 2;
  if (std::fabs(seconds) > kMaxSize) throw InvalidInput("stamp is out of range; stamps are seconds");
  return sweep_guard_core::Time(std::chrono::round<sweep_guard_core::Duration>(LongSeconds(seconds)));
}

StampedPose toPose(const Columns& columns) {
  const auto column = [&columns](std::size_t i) { return static_cast<double>(columns[i]); };
  const Eigen::Quaterniond rotation(column(7), column(4), column(5), column(6));
  const double length = rotation.coeffs().stableNorm();
  if (!(length > kMinQuaternion)) throw InvalidInput("quaternion is zero; correct or remove the line");
  StampedPose pose;
  pose.stamp = toStamp(columns[0]);
  pose.X_WT.translation() << column(1), column(2), column(3);
  pose.X_WT.linear() = Eigen::Quaterniond(rotation.coeffs() / length).toRotationMatrix();
  return pose;
}

}  // namespace

std::string readFile(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw InvalidInput(path + ": no such file; check the path, and give nodes an absolute one");
  if (!std::filesystem::is_regular_file(status)) throw InvalidInput(path + ": not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw InvalidInput(path + ": " + error.message());
  if (size > kMaxFile) throw InvalidInput(path + ": larger than 256 MiB; give a smaller file");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw InvalidInput(path + ": cannot be read; check its permissions");
  return bytes;
}

std::vector<StampedPose> readMotionFile(const std::string& path) {
  std::istringstream text(readFile(path));
  std::vector<StampedPose> poses;
  int line_number = 0;
  for (std::string line; std::getline(text, line);) {
    ++line_number;
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string::npos || line[begin] == '#') continue;
    try {
      const StampedPose pose = toPose(toColumns(line));
      if (!poses.empty() && pose.stamp < poses.back().stamp) {
        throw InvalidInput("stamp is earlier than the previous one; sort the lines by their stamps");
      }
      poses.push_back(pose);
    } catch (const InvalidInput& error) {
      throw InvalidInput(path + ":" + std::to_string(line_number) + ": " + error.what());
    }
  }
  if (poses.empty()) {
    throw InvalidInput(path + ":" + std::to_string(line_number) +
                       ": no pose in the file; give lines 'stamp tx ty tz qx qy qz qw'");
  }
  return poses;
}

Recording readRecording(const std::string& path, const std::string& topic, const std::string& command) {
  const std::string name = std::filesystem::path(path).stem();
  if (!isBag(path)) return {name, readMotionFile(path)};
  return {name, readBag(path, topic), command.empty() ? std::vector<StampedPose>() : readBag(path, command)};
}

}  // namespace sweep_guard_recording
