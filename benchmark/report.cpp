// Prints the results of comparisons as tables, checks them against the requirements, and plots them.
//   report FILE.csv [--plots DIR]
// Exit status 1: one of our detectors missed a triangle, or named one beyond its stated inflation.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

#include "evaluation/gnuplot.h"
#include "row.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::InvalidInput;

bool isOurs(const std::string& method) {
  const std::vector<std::string>& names = sweep_guard_core::detectorNames();
  return std::any_of(names.begin(), names.end(), [&](const auto& name) { return method.rfind(name, 0) == 0; });
}

class Results {
 public:
  explicit Results(std::vector<Row> rows) : rows_(std::move(rows)) {}

  const std::vector<Row>& rows() const { return rows_; }

  /// @returns null if there is no such row
  const Row* find(const std::string& work, const std::string& method, size_t triangles, size_t queries) const {
    for (const Row& row : rows_) {
      if (row.work == work && row.method == method && row.triangles == triangles && row.queries == queries) return &row;
    }
    return nullptr;
  }

  /// Returns the methods in the order in which they were measured.
  std::vector<std::string> methods(const std::string& work, size_t queries) const {
    std::vector<std::string> methods;
    for (const Row& row : rows_) {
      if (row.work != work || row.queries != queries) continue;
      if (std::find(methods.begin(), methods.end(), row.method) == methods.end()) methods.push_back(row.method);
    }
    return methods;
  }

  std::set<size_t> sizes(const std::string& work) const {
    std::set<size_t> sizes;
    for (const Row& row : rows_) {
      if (row.work == work) sizes.insert(row.triangles);
    }
    return sizes;
  }

 private:
  std::vector<Row> rows_;
};

std::string cell(const Row* row) {
  if (row == nullptr) return "-";
  std::array<char, 60> text;
  std::snprintf(text.data(), text.size(), "%.3g", row->median_us);
  std::string cell = text.data();
  if (row->ratio_median) {
    std::snprintf(text.data(), text.size(), " (%.2g, %.2g)", *row->ratio_median, *row->ratio_p10);
    cell += text.data();
  }
  if (row->misses.value_or(0) > 0) cell += " misses";
  return cell;
}

void printTable(const Results& results, const std::string& work, size_t queries) {
  const std::vector<std::string> methods = results.methods(work, queries);
  if (methods.empty()) return;
  std::printf("\n%s, %zu queries: median us (ratio to %s: median, p10)\n| method |", work.c_str(), queries,
              kOurs.c_str());
  for (const size_t size : results.sizes(work)) std::printf(" %zu |", size);
  std::printf("\n|---|");
  for (size_t i = 0; i < results.sizes(work).size(); ++i) std::printf("---|");
  std::printf("\n");
  for (const std::string& method : methods) {
    std::printf("| %s |", method.c_str());
    for (const size_t size : results.sizes(work)) {
      std::printf(" %s |", cell(results.find(work, method, size, queries)).c_str());
    }
    std::printf("\n");
  }
}

/// A bound on one result.
struct Requirement {
  std::string text;
  std::optional<double> value;
  double bound;
  bool at_least;
};

constexpr size_t kSmall = 1600;
constexpr size_t kLarge = 99856;
constexpr size_t kHuge = 1000000;

std::vector<Requirement> peerRequirements(const Results& results) {
  struct Bounds {
    std::string method;
    double small_1, large_1, large_20;
  };
  static const std::vector<Bounds> kBounds = {{"FCL AABB", 15, 55, 15},
                                              {"Embree", 6, 24, 4.5},
                                              {"Bullet", 7, 33, 6},
                                              {"scalar", 2.4, 6.5, 22},
                                              {"OSMesa", 300, 1000, 2000}};
  std::vector<Requirement> requirements;
  const auto add = [&](const std::string& method, size_t triangles, size_t queries, double bound) {
    const Row* const row = results.find("ordered", method, triangles, queries);
    requirements.push_back(
        {method + " / ours, " + std::to_string(triangles) + " triangles, queries " + std::to_string(queries) + ", p10",
         row == nullptr ? std::nullopt : row->ratio_p10, bound, true});
  };
  for (const Bounds& bounds : kBounds) {
    add(bounds.method, kSmall, 1, bounds.small_1);
    add(bounds.method, kLarge, 1, bounds.large_1);
    add(bounds.method, kLarge, 20, bounds.large_20);
  }
  return requirements;
}

std::optional<double> inverse(const Row* row) {
  return row == nullptr ? std::nullopt : std::optional<double>(1.0 / *row->ratio_median);
}

std::optional<double> exponent(const Row* small, const Row* huge) {
  if (small == nullptr || huge == nullptr) return std::nullopt;
  const double triangles = static_cast<double>(huge->triangles) / static_cast<double>(small->triangles);
  return std::log(huge->median_us / small->median_us) / std::log(triangles);
}

std::vector<Requirement> memoryRequirements(const Results& results) {
  const auto read = [&](const std::string& work, size_t triangles, size_t queries) {
    return results.find(work, "memory read", triangles, queries);
  };
  const auto select = [&](size_t queries) -> std::optional<double> {
    const Row* const row = results.find("ordered", "select", kLarge, queries);
    return row == nullptr ? std::nullopt : row->ratio_median;
  };
  const Row* const update = read("update", kHuge, 0);
  return {{"memory read / update pass, 1000000 triangles", update == nullptr ? std::nullopt : update->ratio_median, 0.8,
           true},
          {"frame / memory read, 1000000 triangles", inverse(read("ordered", kHuge, 1)), 1.6, false},
          {"frame / memory read, 99856 triangles", inverse(read("ordered", kLarge, 1)), 5.0, false},
          {"exponent from 1600 to 1000000 triangles",
           exponent(results.find("ordered", kOurs, kSmall, 1), results.find("ordered", kOurs, kHuge, 1)), 0.9, false},
          {"select / halfspace, 99856 triangles, queries 1", select(1), 3.0, false},
          {"select / halfspace, 99856 triangles, queries 20", select(20), 5.0, false}};
}

void print(const Requirement& requirement) {
  const char* const relation = requirement.at_least ? ">=" : "<=";
  if (!requirement.value) {
    std::printf("not measured  %s %s %g\n", requirement.text.c_str(), relation, requirement.bound);
    return;
  }
  const bool passes =
      requirement.at_least ? *requirement.value >= requirement.bound : *requirement.value <= requirement.bound;
  std::printf("%-12s  %s: %.3g %s %g\n", passes ? "pass" : "FAIL", requirement.text.c_str(), *requirement.value,
              relation, requirement.bound);
}

void printRequirements(const Results& results) {
  std::printf("\nRequirements, with AVX-512, on a quiet machine; medians unless marked p10:\n");
  for (const Requirement& requirement : peerRequirements(results)) print(requirement);
  for (const Requirement& requirement : memoryRequirements(results)) print(requirement);
}

// @returns whether there were none
bool printErrors(const Results& results) {
  bool right = true;
  for (const Row& row : results.rows()) {
    const bool wrong = row.misses.value_or(0) + row.extras.value_or(0) > 0;
    if (!wrong || !isOurs(row.method)) continue;
    right = false;
    std::printf("WRONG: %s: %s, %zu triangles, %zu queries: %zu misses, %zu extras\n", row.method.c_str(),
                row.work.c_str(), row.triangles, row.queries, *row.misses, *row.extras);
  }
  std::printf("%s\n", right ? "our detectors: no misses, no extras" : "our detectors: WRONG, see above");
  return right;
}

// One of the colors of Okabe and Ito, which color-blind people can tell apart; dashed from the ninth on.
std::string style(size_t index) {
  static const std::vector<std::string> kColors = {"#000000", "#E69F00", "#56B4E9", "#009E73",
                                                   "#B0A000", "#0072B2", "#D55E00", "#CC79A7"};
  std::ostringstream style;
  style << "lw 2 lc rgb '" << kColors[index % kColors.size()] << "' pt " << 1 + index << " ps 1.2";
  if (index >= kColors.size()) style << " dt 2";
  return style.str();
}

void plot(const Results& results, const std::string& work, size_t queries, const std::string& folder) {
  using sweep_guard_evaluation::gnuplotText;
  std::string name = work;
  std::replace(name.begin(), name.end(), ' ', '_');
  std::ostringstream script;
  std::ostringstream data;
  script << "set terminal pngcairo size 1100,750 font 'sans,13'\nset output "
         << gnuplotText(folder + "/time_" + name + "_" + std::to_string(queries) + ".png")
         << "\nset logscale xy\nset format y '10^{%T}'\nset format x '10^{%T}'\nset grid lt 1 lc rgb '#d0d0d0'\n"
         << "set key outside right top noenhanced\nset xlabel 'triangles'\n"
         << "set ylabel 'update and " << queries << (queries == 1 ? " query" : " queries")
         << " [µs], median, p10 to p90'\n"
         << "set title " << gnuplotText(work + " mesh") << "\n";
  std::vector<std::string> methods = results.methods(work, queries);
  std::stable_partition(methods.begin(), methods.end(), [&](const auto& method) { return method == kOurs; });
  size_t index = 0;
  for (const std::string& method : methods) {
    const bool limit = method.rfind("memory read", 0) == 0;
    const std::string gray = method == "memory read" ? "#808080" : "#b0b0b0";
    const std::string look = limit ? "lw 3 dt 3 lc rgb '" + gray + "'" : style(index);
    script << (method == methods.front() ? "plot " : ", ") << "'-' with " << (limit ? "lines " : "yerrorlines ") << look
           << " title " << gnuplotText(method);
    for (const size_t size : results.sizes(work)) {
      const Row* const row = results.find(work, method, size, queries);
      if (row == nullptr) continue;
      data << size << ' ' << row->median_us << ' ' << row->p10_us << ' ' << row->p90_us << '\n';
    }
    data << "e\n";
    if (!limit) ++index;
  }
  sweep_guard_evaluation::runGnuplot(script.str() + '\n' + data.str());
}

int run(const std::vector<std::string>& arguments) {
  const bool plots = arguments.size() == 3 && arguments[1] == "--plots";
  if (arguments.size() != 1 && !plots) throw InvalidInput("usage: report FILE.csv [--plots DIR]");
  std::ifstream csv(arguments[0]);
  if (!csv) throw InvalidInput(arguments[0] + ": cannot read");
  const Results results(readCsv(csv));
  printTable(results, "update", 0);
  for (const char* const work : {"ordered", "shuffled", "no hit", "one hit"}) {
    for (const size_t queries : {size_t{1}, size_t{20}}) printTable(results, work, queries);
  }
  printRequirements(results);
  const bool right = printErrors(results);
  if (plots) {
    sweep_guard_evaluation::requireGnuplot();
    for (const char* const work : {"ordered", "shuffled"}) {
      for (const size_t queries : {size_t{1}, size_t{20}}) plot(results, work, queries, arguments[2]);
    }
  }
  return right ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  try {
    return sweep_guard_benchmark::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "report: " << error.what() << '\n';
    return 2;
  }
}
