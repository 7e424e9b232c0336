#include "latency/requirements.h"

#include <optional>

#include "common/csv.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::csvNumber;

constexpr double kMinSweepsPerSecond = 30.0;  // of a million triangles

// From pose to warning over TCPROS, on a quiet machine [ms].
std::optional<double> maxP99(const Settings& settings) {
  if (settings.transport != "tcpros") return std::nullopt;
  if (settings.triangles <= 1600) return 2.0;
  if (settings.triangles <= 20'000) return 4.0;
  if (settings.triangles <= 100'000) return 10.0;
  return std::nullopt;
}

Requirement latencyWithin(double bound, const std::vector<double>& milliseconds) {
  const double p99 = sweep_guard_core::quantile(milliseconds, 0.99);
  const std::string samples = std::to_string(milliseconds.size());
  return {"pose to warning, p99 of " + samples + " [ms], on a quiet machine", p99, "<= " + csvNumber(bound),
          p99 <= bound};
}

}  // namespace

std::vector<Requirement> requirementsOn(const Settings& settings, const Measurement& measured,
                                        const std::vector<LatencyRow>& rows) {
  const auto unswept = static_cast<double>(holes(measured.messages.contacts));
  std::vector<Requirement> required = {{"intervals unswept", unswept, "= 0", unswept == 0.0}};
  if (const std::optional<double> bound = maxP99(settings)) {
    required.push_back(latencyWithin(*bound, rows[2].milliseconds));
  }
  if (settings.transport == "nodelet" && settings.triangles >= 1'000'000) {
    const double sweeps = sweepsPerSecond(measured);
    required.push_back(
        {"sweeps per second", sweeps, ">= " + csvNumber(kMinSweepsPerSecond), sweeps >= kMinSweepsPerSecond});
  }
  return required;
}

}  // namespace sweep_guard_benchmark
