#include <iostream>

#include "common/run_program.h"
#include "evaluation/closed_loop_options.h"
#include "evaluation/closed_loop_report.h"
#include "evaluation/output_file.h"
#include "evaluation/progress.h"

namespace sweep_guard_evaluation {
namespace {

int run(int argc, char** argv) {
  const ClosedLoopOptions options = parseClosedLoopOptions(argc, argv);
  if (options.help) {
    std::cout << closedLoopUsage();
    return 0;
  }
  std::vector<sweep_guard_recording::Recording> recordings;
  size_t steps = 0;
  for (const std::string& file : options.files) {
    recordings.push_back(sweep_guard_recording::readRecording(file, options.topic));
    steps += recordings.back().poses.size();
  }
  OutputFile csv(options.csv, options.files);
  size_t left_out = 0;
  std::vector<ClosedLoopCount> counts;
  {
    ProgressBar bar("closed loop", steps);
    counts = countClosedLoops(recordings, options, left_out, [&](size_t poses) { bar.advance(poses); });
  }
  const std::vector<ClosedLoopCount> sums = summed(counts);
  counts.insert(counts.end(), sums.begin(), sums.end());
  if (csv.requested()) csv.write(closedLoopCsv(counts));
  std::cout << closedLoopTable(counts);
  if (left_out > 0) std::cout << left_out << " placements left out: the tool was too fast to be stopped at the begin\n";
  return keepsItsPromise(sums) ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_evaluation

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("evaluate_closed_loop", [&] { return sweep_guard_evaluation::run(argc, argv); });
}
