#include "latency/histogram.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "sweep_guard/common/error.h"

namespace sweep_guard_benchmark {
namespace {

constexpr double kClasses = 20.0;  // per decade
constexpr double kMin = 1e-3;      // [ms]

}  // namespace

// Tab-separated, because the names contain commas.
void appendHistogram(const std::string& path, const HistogramTitle& title, const std::vector<double>& milliseconds) {
  std::map<int, double> counts;
  for (const double value : milliseconds) {
    counts[static_cast<int>(std::floor(kClasses * std::log10(std::max(value, kMin))))] += 1.0;
  }
  std::ofstream file(path, std::ios::app);
  if (counts.empty()) return;
  for (int number = counts.begin()->first; number <= counts.rbegin()->first; ++number) {
    file << title.method << '\t' << title.triangles << '\t' << title.work << '\t'
         << std::pow(10.0, (number + 0.5) / kClasses) << '\t'
         << counts[number] / static_cast<double>(milliseconds.size()) << '\n';
  }
  if (!file) throw sweep_guard_core::InvalidInput("cannot write " + path);
}

std::vector<Histogram> readHistograms(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw sweep_guard_core::InvalidInput("cannot read " + path);
  std::vector<Histogram> histograms;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    HistogramTitle title;
    std::string triangles;
    double middle = 0.0;
    double share = 0.0;
    std::getline(fields, title.method, '\t');
    std::getline(fields, triangles, '\t');
    std::getline(fields, title.work, '\t');
    if (!(fields >> middle >> share)) throw sweep_guard_core::InvalidInput(path + ": a line is not a class");
    title.triangles = std::stoi(triangles);
    const bool same = !histograms.empty() && histograms.back().title.work == title.work &&
                      histograms.back().title.method == title.method &&
                      histograms.back().title.triangles == title.triangles;
    if (!same) histograms.push_back({title, {}, {}});
    histograms.back().ms.push_back(middle);
    histograms.back().shares.push_back(share);
  }
  return histograms;
}

}  // namespace sweep_guard_benchmark
