#pragma once

#include <string>
#include <vector>

namespace sweep_guard_recording {

/// Throws if gnuplot is not installed.
/// @throws sweep_guard_core::InvalidInput that says what to install
void requireGnuplot();

/// Runs a script.
/// @throws sweep_guard_core::DeviceError if gnuplot fails
void runGnuplot(const std::string& script);

/// Quotes a text so that gnuplot takes it literally.
std::string gnuplotText(const std::string& text);

/// Returns the color of a predictor, `#rrggbb`, from the palette of Okabe and Ito for color-blind readers.
std::string colorOf(const std::string& predictor);

/// Writes the script of a page: a legend, and panels in rows and columns below it.
class PlotPage {
 public:
  /// @param path  of the PNG file
  PlotPage(const std::string& path, size_t rows, size_t columns);

  /// Adds the legend: one entry for each predictor, then the others.
  /// @param entries  of gnuplot's `keyentry`, such as "with lines lc rgb 'black' title 'median'"
  void addKey(const std::vector<std::string>& predictors, const std::vector<std::string>& entries);

  /// Adds a panel.
  /// @param row, column  from 0
  /// @param commands     of gnuplot: data, labels, and one `plot`
  void addPanel(size_t row, size_t column, const std::string& commands);

  const std::string& script() const { return script_; }

 private:
  void place(double left, double right, double bottom, double top);

  size_t columns_;
  double height_;  // [pixel]
  std::string script_;
};

}  // namespace sweep_guard_recording
