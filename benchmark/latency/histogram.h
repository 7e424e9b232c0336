#pragma once

#include <string>
#include <vector>

namespace sweep_guard_benchmark {

/// What a distribution is of.
struct HistogramTitle {
  std::string method;
  int triangles;
  std::string work;
};

/// Counts in twenty classes per decade, for a log scale.
struct Histogram {
  HistogramTitle title;
  std::vector<double> ms;      ///< middle of each class, ascending [ms]
  std::vector<double> shares;  ///< of the whole, in each class
};

/// Adds a distribution to a file, which is made where it is missing.
/// @throws sweep_guard_core::InvalidInput if it cannot be written
void appendHistogram(const std::string& path, const HistogramTitle& title, const std::vector<double>& milliseconds);

/// All of a file, in its order.
/// @throws sweep_guard_core::InvalidInput if it cannot be read
std::vector<Histogram> readHistograms(const std::string& path);

}  // namespace sweep_guard_benchmark
