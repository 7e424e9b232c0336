#pragma once

#include <string>
#include <vector>

namespace sweep_guard_benchmark {

/// Names the measurements of a distribution.
struct HistogramTitle {
  std::string method;
  int triangles;
  std::string work;
};

/// A distribution in twenty classes per decade, for a log scale.
struct Histogram {
  HistogramTitle title;
  std::vector<double> ms;      ///< middle of each class, ascending [ms]
  std::vector<double> shares;  ///< fraction of all measurements in each class
};

/// Appends a distribution to a file, or creates the file.
/// @throws sweep_guard_core::InvalidInput if the file cannot be written
void appendHistogram(const std::string& path, const HistogramTitle& title, const std::vector<double>& milliseconds);

/// Reads all distributions of a file, in its order.
/// @throws sweep_guard_core::InvalidInput if the file cannot be read
std::vector<Histogram> readHistograms(const std::string& path);

}  // namespace sweep_guard_benchmark
