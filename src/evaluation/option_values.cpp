#include "evaluation/option_values.h"

namespace sweep_guard_evaluation {

namespace po = boost::program_options;

po::variables_map parseCommandLine(int argc, const char* const* argv, po::options_description options,
                                   std::vector<std::string>& files) {
  options.add_options()("file", po::value(&files));
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv)
                  .options(options)
                  .positional(po::positional_options_description().add("file", -1))
                  .style(po::command_line_style::default_style & ~po::command_line_style::allow_guessing)
                  .run(),
              values);
    po::notify(values);
  } catch (const po::error& error) {
    throw sweep_guard_core::InvalidInput(std::string(error.what()) + "; --help lists the options");
  }
  return values;
}

}  // namespace sweep_guard_evaluation
