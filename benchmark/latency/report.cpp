#include "latency/report.h"

#include <array>
#include <cstdio>
#include <fstream>

#include "common/csv.h"
#include "latency/requirements.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::quantile;

std::string methodOf(const Settings& settings) {
  std::string method = settings.detector;
  for (const std::string& parameter : settings.parameters) method += ' ' + parameter;
  method += ", " + settings.transport;
  return settings.label.empty() ? method : method + ", " + settings.label;
}

std::array<double, 4> quantilesOf(const LatencyRow& row) {
  const auto at = [&](double fraction) { return quantile(row.milliseconds, fraction); };
  return {at(0.5), at(0.9), at(0.99), at(1.0)};
}

void print(const Requirement& required) {
  std::printf("%s  %s: %.3g %s\n", required.met ? "pass" : "FAIL", required.figure.c_str(), required.value,
              required.bound.c_str());
}

void appendFigures(const Settings& settings, const Measurement& measured, const std::vector<LatencyRow>& rows) {
  const bool is_new = !std::ifstream(settings.csv).good();
  std::ofstream file(settings.csv, std::ios::app);
  if (is_new) {
    file << csvLine({"work", "method", "triangles", "count", "per_second", "p50_ms", "p90_ms", "p99_ms", "max_ms",
                     "unswept", "sweeps_made", "sweeps_asked", "processor_share", "resident_mb", "growth_mb", "load"});
  }
  for (const LatencyRow& row : rows) {
    const auto [p50, p90, p99, max] = quantilesOf(row);
    file << csvLine({row.work, methodOf(settings), std::to_string(settings.triangles),
                     std::to_string(row.milliseconds.size()), csvNumber(measured.perSecond(row.milliseconds.size())),
                     csvNumber(p50), csvNumber(p90), csvNumber(p99), csvNumber(max),
                     std::to_string(holes(measured.messages.contacts)), std::to_string(measured.messages.sweeps_made),
                     std::to_string(measured.messages.sweeps_asked), csvNumber(measured.processorShare()),
                     csvNumber(measured.after.resident_mb), csvNumber(measured.growthMb()), csvNumber(measured.load)});
  }
  if (!file) throw InvalidInput("--csv: cannot write " + settings.csv);
}

// By the steady clock, so also while a thread waits for a processor. The rest of the process is roscpp's and services'.
void printStages(const Measurement& measured) {
  const std::vector<StageShare> stages = stagesOf(measured);
  if (stages.empty()) return;
  double rest = 100.0 * measured.processorShare();
  std::printf("of a processor's time:");
  for (const auto& [stage, percent] : stages) {
    std::printf(" %s %.1f %%,", stage.c_str(), percent);
    rest -= percent;
  }
  std::printf(" rest %.1f %%\n", rest);
}

void appendStages(const Settings& settings, const Measurement& measured) {
  const bool is_new = !std::ifstream(settings.stages).good();
  std::ofstream file(settings.stages, std::ios::app);
  if (is_new) file << csvLine({"method", "triangles", "stage", "percent_of_a_processor", "processor_share"});
  for (const auto& [stage, percent] : stagesOf(measured)) {
    file << csvLine({methodOf(settings), std::to_string(settings.triangles), stage, csvNumber(percent),
                     csvNumber(measured.processorShare())});
  }
  if (!file) throw InvalidInput("--stages: cannot write " + settings.stages);
}

}  // namespace

void print(const Settings& settings, const Measurement& measured, const std::vector<LatencyRow>& rows) {
  std::printf(
      "\n%d triangles, %s; load %.1f [ms]\n| | count | per second | p50 | p90 | p99 | max "
      "|\n|---|---|---|---|---|---|---|\n",
      settings.triangles, methodOf(settings).c_str(), measured.load);
  for (const LatencyRow& row : rows) {
    const auto [p50, p90, p99, max] = quantilesOf(row);
    std::printf("| %s | %zu | %.1f | %.2f | %.2f | %.2f | %.2f |\n", row.work.c_str(), row.milliseconds.size(),
                measured.perSecond(row.milliseconds.size()), p50, p90, p99, max);
  }
  std::printf(
      "pose to warning: the age of a warning when it is received, mostly one repeated at 20 Hz; p99 "
      "of %zu\n",
      rows[2].milliseconds.size());
  std::printf(
      "poses: %zu sent, %zu covered; sweeps: %.1f per second, %zu of them met something; intervals unswept: %zu\n",
      posesOf(measured).size(), rows[0].milliseconds.size(), sweepsPerSecond(measured), measured.messages.met,
      holes(measured.messages.contacts));
  std::printf("warnings: %zu, %zu of them not CLEAR\n", rows[2].milliseconds.size(), unclearWarnings(measured));
  std::printf("predicted sweeps: %zu made of %zu; predictions with all sweeps: %zu\n", measured.messages.sweeps_made,
              measured.messages.sweeps_asked, measured.messages.whole_predictions);
  std::printf("guard's process: %.0f %% of a processor, %.1f MB, %+.1f MB during the measurement\n",
              100.0 * measured.processorShare(), measured.after.resident_mb, measured.growthMb());
  printStages(measured);
  for (const Requirement& required : requirementsOn(settings, measured, rows)) print(required);
  std::fflush(stdout);
}

void save(const Settings& settings, const Measurement& measured, const std::vector<LatencyRow>& rows) {
  if (!settings.csv.empty()) appendFigures(settings, measured, rows);
  if (!settings.stages.empty()) appendStages(settings, measured);
  if (settings.histogram.empty()) return;
  // Tab-separated, because the names contain commas.
  std::ofstream file(settings.histogram, std::ios::app);
  for (const LatencyRow& row : rows) {
    for (const auto& [middle_ms, share] : histogram(row.milliseconds)) {
      file << methodOf(settings) << '\t' << settings.triangles << '\t' << row.work << '\t' << middle_ms << '\t' << share
           << '\n';
    }
  }
  if (!file) throw InvalidInput("--histogram: cannot write " + settings.histogram);
}

}  // namespace sweep_guard_benchmark
