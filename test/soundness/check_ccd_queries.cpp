#include <exception>
#include <iostream>

#include "soundness/ccd_queries.h"

namespace {

int check(int count, char** files) {
  sweep_guard_core::soundness::CcdTally all;
  for (int i = 0; i < count; ++i) {
    all.add(sweep_guard_core::soundness::checkCcdQueries(files[i], std::cout));
  }
  std::cout << "farthest extra " << all.farthest_extra << " of its size apart\n";
  std::cout << "queries " << all.queries << " positives " << all.positives << " misses " << all.misses << " extras "
            << all.extras << '\n';
  return all.misses == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') {
    std::cerr
        << "usage: check_ccd_queries FILE...\n"
           "Runs the narrow phase on queries of continuous collision detection with known truth: files of\n"
           "Sample-Queries, in folders edge-edge or vertex-face. Exit status: 0, 1 if one was missed, 2 wrong usage.\n";
    return 2;
  }
  try {
    return check(argc - 1, argv + 1);
  } catch (const std::exception& error) {
    std::cerr << "check_ccd_queries: " << error.what() << '\n';
    return 2;
  }
}
