#include "row.h"

#include "common/csv.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::csvNumber;

std::string textOf(const std::optional<double>& value) { return value ? csvNumber(*value) : ""; }

}  // namespace

Row makeRow(const std::string& work, const std::string& method, size_t triangles, size_t queries,
            const std::vector<double>& times) {
  const auto at = [&](double fraction) { return sweep_guard_core::quantile(times, fraction); };
  return {work, method, triangles, queries, at(0.5), at(0.1), at(0.9)};
}

ResultFile::ResultFile(const std::string& path) : path_(path) {
  if (path.empty()) return;
  csv_.open(path, std::ios::app);
  if (csv_.tellp() == 0) {
    csv_ << "work,method,triangles,queries,median_us,p10_us,p90_us,ratio_median,ratio_p10,misses,extras\n";
  }
  if (!csv_) throw sweep_guard_core::InvalidInput(path + ": cannot write");
}

void ResultFile::write(const Row& row) {
  if (path_.empty()) return;
  csv_ << sweep_guard_core::csvLine({row.work, row.method, std::to_string(row.triangles), std::to_string(row.queries),
                                     csvNumber(row.median_us), csvNumber(row.p10_us), csvNumber(row.p90_us),
                                     textOf(row.ratio_median), textOf(row.ratio_p10),
                                     row.misses ? std::to_string(*row.misses) : "",
                                     row.extras ? std::to_string(*row.extras) : ""})
       << std::flush;
  if (!csv_) throw sweep_guard_core::InvalidInput(path_ + ": cannot write");
}

}  // namespace sweep_guard_benchmark
