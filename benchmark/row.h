#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace sweep_guard_benchmark {

/// The detector that the others are compared with: our fastest.
inline const std::string kOurs = "halfspace";

/// One line of the results.
struct Row {
  std::string work;
  std::string method;
  size_t triangles = 0;
  size_t queries = 0;
  double median_us = 0.0;
  double p10_us = 0.0;
  double p90_us = 0.0;
  std::optional<double> ratio_median = {};  ///< of this method's time to ours, frame by frame
  std::optional<double> ratio_p10 = {};
  std::optional<size_t> misses = {};  ///< triangles met and not named, over all frames; empty: no queries
  std::optional<size_t> extras = {};  ///< triangles named and not met
};

/// Returns a row with the quantiles of `times` [us].
Row makeRow(const std::string& work, const std::string& method, size_t triangles, size_t queries,
            const std::vector<double>& times);

/// A CSV file to which rows are appended.
class ResultFile {
 public:
  /// @param path  empty: rows are dropped
  /// @throws InvalidInput if the file cannot be written, as does write()
  explicit ResultFile(const std::string& path);

  void write(const Row& row);

 private:
  std::string path_;
  std::ofstream csv_;
};

}  // namespace sweep_guard_benchmark
