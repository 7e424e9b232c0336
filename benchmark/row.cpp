#include "row.h"

#include <istream>
#include <sstream>
#include <stdexcept>

#include "evaluation/csv.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_evaluation::csvNumber;

template <typename Value>
std::string textOf(const std::optional<Value>& value) {
  return value ? csvNumber(static_cast<double>(*value)) : "";
}

std::optional<double> numberIn(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<double>(std::stod(text));
}

std::optional<size_t> countIn(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<size_t>(std::stoul(text));
}

Row rowIn(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line + ',');
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  if (fields.size() != 11) throw std::invalid_argument("11 fields expected");
  return {fields[0],
          fields[1],
          std::stoul(fields[2]),
          std::stoul(fields[3]),
          std::stod(fields[4]),
          std::stod(fields[5]),
          std::stod(fields[6]),
          numberIn(fields[7]),
          numberIn(fields[8]),
          countIn(fields[9]),
          countIn(fields[10])};
}

}  // namespace

Row makeRow(const std::string& work, const std::string& method, size_t triangles, size_t queries,
            const std::vector<double>& times) {
  const auto at = [&](double fraction) { return sweep_guard_core::quantile(times, fraction); };
  return {work, method, triangles, queries, at(0.5), at(0.1), at(0.9)};
}

std::string csvHeader() {
  return "work,method,triangles,queries,median_us,p10_us,p90_us,ratio_median,ratio_p10,misses,extras\n";
}

std::string csvLine(const Row& row) {
  return sweep_guard_evaluation::csvLine(
      {row.work, row.method, std::to_string(row.triangles), std::to_string(row.queries), csvNumber(row.median_us),
       csvNumber(row.p10_us), csvNumber(row.p90_us), textOf(row.ratio_median), textOf(row.ratio_p10),
       row.misses ? std::to_string(*row.misses) : "", row.extras ? std::to_string(*row.extras) : ""});
}

std::vector<Row> readCsv(std::istream& csv) {
  std::vector<Row> rows;
  for (std::string line; std::getline(csv, line);) {
    if (line + '\n' == csvHeader()) continue;
    try {
      rows.push_back(rowIn(line));
    } catch (const std::logic_error&) {
      throw sweep_guard_core::InvalidInput("not a line of benchmark results: " + line);
    }
  }
  return rows;
}

}  // namespace sweep_guard_benchmark
