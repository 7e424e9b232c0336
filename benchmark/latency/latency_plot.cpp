// Plots the distributions that `latency --histogram` wrote: one panel for each method and size.
//   latency_plot HISTOGRAMS PNG
#include <algorithm>
#include <iostream>
#include <map>
#include <sstream>

#include "evaluation/gnuplot.h"
#include "latency/histogram.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_evaluation::gnuplotText;
using sweep_guard_evaluation::PlotPage;

// Colors of Okabe and Ito, which color-blind people can tell apart.
const std::map<std::string, std::string> kColors = {
    {"pose to contacts", "#0072B2"}, {"pose to prediction", "#E69F00"}, {"pose to warning", "#D55E00"}};

std::string lineOf(const std::string& work) { return "with histeps lw 2 lc rgb '" + kColors.at(work) + "'"; }

std::string panel(const std::string& title, const std::vector<Histogram>& histograms) {
  std::ostringstream data;
  std::ostringstream plots;
  for (size_t i = 0; i < histograms.size(); ++i) {
    data << "$data" << i << " << EOD\n";
    for (size_t k = 0; k < histograms[i].ms.size(); ++k) {
      data << histograms[i].ms[k] << ' ' << 100.0 * histograms[i].shares[k] << '\n';
    }
    data << "EOD\n";
    plots << (i == 0 ? "plot " : ", ") << "$data" << i << ' ' << lineOf(histograms[i].title.work) << " notitle";
  }
  return data.str() + "set logscale x\nset xrange [0.03:1000]\nset yrange [0:*]\nset format x '%g'\n" +
         "set xtics font ',11'\nset ylabel '%'\n" + "set title " + gnuplotText(title) +
         " noenhanced font ',11' offset -3\n" + plots.str();
}

void draw(const std::string& source, const std::string& path) {
  std::map<std::pair<int, std::string>, std::vector<Histogram>> panels;
  std::vector<std::string> methods;
  std::vector<int> sizes;
  for (const Histogram& histogram : readHistograms(source)) {
    if (kColors.count(histogram.title.work) == 0) continue;
    panels[{histogram.title.triangles, histogram.title.method}].push_back(histogram);
    const auto addNew = [](auto& all, const auto& one) {
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
    };
    addNew(methods, histogram.title.method);
    addNew(sizes, histogram.title.triangles);
  }
  PlotPage page(path, sizes.size(), methods.size());
  std::vector<std::string> key;
  key.reserve(kColors.size());
  for (const auto& [work, color] : kColors)
    key.push_back("with lines lw 4 lc rgb '" + color + "' title " + gnuplotText(work));
  page.addKey({}, key);
  for (size_t row = 0; row < sizes.size(); ++row) {
    for (size_t column = 0; column < methods.size(); ++column) {
      const auto found = panels.find({sizes[row], methods[column]});
      if (found == panels.end()) continue;
      const std::string label = row + 1 == sizes.size() ? "set xlabel '[ms]'\n" : "";
      page.addPanel(row, column,
                    label + panel(std::to_string(sizes[row]) + " triangles, " + methods[column], found->second));
    }
  }
  sweep_guard_evaluation::runGnuplot(page.script());
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "latency_plot HISTOGRAMS PNG\n";
    return 2;
  }
  try {
    sweep_guard_evaluation::requireGnuplot();
    sweep_guard_benchmark::draw(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "latency_plot: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
