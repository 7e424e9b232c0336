#pragma once

#include <string>
#include <vector>

namespace sweep_guard_evaluation {

/// @throws sweep_guard_core::InvalidInput, saying what to install, if there is no gnuplot
void requireGnuplot();

/// Runs a script.
/// @throws sweep_guard_core::DeviceError if gnuplot fails
void runGnuplot(const std::string& script);

/// A text as gnuplot takes it literally, quotes included.
std::string gnuplotText(const std::string& text);

/// Colour of a predictor, `#rrggbb`: of Okabe and Ito's, which colour-blind people can tell apart.
std::string colourOf(const std::string& predictor);

/// A page of panels, in rows and columns, below a line with one legend for all.
class PlotPage {
 public:
  /// @param path  of the PNG file
  PlotPage(const std::string& path, size_t rows, size_t columns);

  /// Adds the legend: one entry for each predictor, then others.
  /// @param entries  of gnuplot's `keyentry`, such as "with lines lc rgb 'black' title 'median'"
  void addKey(const std::vector<std::string>& predictors, const std::vector<std::string>& entries);

  /// Adds a panel.
  /// @param row, column  from 0
  /// @param commands     what gnuplot shall do there: data, labels, and one `plot`
  void addPanel(size_t row, size_t column, const std::string& commands);

  const std::string& script() const { return script_; }

 private:
  void place(double left, double right, double bottom, double top);

  size_t columns_;
  double height_;  // [pixel]
  std::string script_;
};

}  // namespace sweep_guard_evaluation
