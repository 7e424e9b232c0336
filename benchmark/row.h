#pragma once

#include <iosfwd>
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

/// Returns the names of the columns as a line.
std::string csvHeader();
std::string csvLine(const Row& row);

/// @throws InvalidInput if a line is not one of csvLine() or csvHeader()
std::vector<Row> readCsv(std::istream& csv);

}  // namespace sweep_guard_benchmark
