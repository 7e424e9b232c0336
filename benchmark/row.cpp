#include "row.h"

#include <istream>
#include <sstream>
#include <stdexcept>

#include "evaluation/csv.h"
#include "sweep_guard/common/error.h"

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
  Row row;
  row.work = fields[0];
  row.method = fields[1];
  row.triangles = std::stoul(fields[2]);
  row.queries = std::stoul(fields[3]);
  row.median_us = std::stod(fields[4]);
  row.p10_us = std::stod(fields[5]);
  row.p90_us = std::stod(fields[6]);
  row.ratio_median = numberIn(fields[7]);
  row.ratio_p10 = numberIn(fields[8]);
  row.misses = countIn(fields[9]);
  row.extras = countIn(fields[10]);
  return row;
}

}  // namespace

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
