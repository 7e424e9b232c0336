#include "evaluation/option_values.h"

#include <sstream>

namespace sweep_guard_evaluation {

namespace po = boost::program_options;

std::vector<std::string> splitAtCommas(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list + ',');
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

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
