#include "recording/gnuplot.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>

#include "sweep_guard/common/error.h"

namespace sweep_guard_recording {
namespace {

constexpr double kWidth = 1300.0;  // all in [pixel]
constexpr double kKeyHeight = 60.0;
constexpr double kRowHeight = 290.0;  // title and tics included
constexpr double kTitle = 35.0;
constexpr double kTics = 35.0;
constexpr double kBottom = 35.0;  // for the label of the axis
constexpr double kLeft = 110.0;
constexpr double kRight = 25.0;

// A gnuplot that ends early must not end this program.
class IgnoredPipeSignal {
 public:
  IgnoredPipeSignal() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~IgnoredPipeSignal() { std::signal(SIGPIPE, before_); }
  IgnoredPipeSignal(const IgnoredPipeSignal&) = delete;
  IgnoredPipeSignal& operator=(const IgnoredPipeSignal&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace

void requireGnuplot() {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
    throw sweep_guard_core::InvalidInput("plots need gnuplot; install it: apt-get install gnuplot-nox");
  }
}

void runGnuplot(const std::string& script) {
  const IgnoredPipeSignal ignored;
  FILE* const pipe = popen("gnuplot", "w");
  if (pipe == nullptr) throw sweep_guard_core::DeviceError("gnuplot cannot be started");
  const bool written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  if (pclose(pipe) != 0 || !written) throw sweep_guard_core::DeviceError("gnuplot failed; see its message above");
}

std::string gnuplotText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::string colorOf(const std::string& predictor) {
  static const std::map<std::string, std::string> kColors = {
      {"direct", "#0072B2"}, {"polynomial", "#D55E00"}, {"constant_velocity", "#009E73"}, {"hold", "#777777"}};
  const auto found = kColors.find(predictor);
  return found == kColors.end() ? "#CC79A7" : found->second;
}

PlotPage::PlotPage(const std::string& path, size_t rows, size_t columns)
    : columns_(columns), height_(kKeyHeight + static_cast<double>(rows) * kRowHeight + kBottom) {
  std::ostringstream begin;
  begin << "set terminal pngcairo size " << kWidth << ',' << height_ << " font 'sans,14'\n"
        << "set output " << gnuplotText(path) << "\nset multiplot\n";
  script_ = begin.str();
}

void PlotPage::addKey(const std::vector<std::string>& predictors, const std::vector<std::string>& entries) {
  place(0.0, kWidth, height_ - kKeyHeight, height_);
  script_ +=
      "set key center center horizontal maxrows 1 noenhanced\nunset tics\nunset border\nplot [0:1] [0:1] NaN notitle";
  for (const std::string& predictor : predictors) {
    script_ += ", keyentry with lines lw 4 lc rgb '" + colorOf(predictor) + "' title " + gnuplotText(predictor);
  }
  for (const std::string& entry : entries) script_ += ", keyentry " + entry;
  script_ += "\nunset key\nset tics\nset border\nset grid xtics ytics lt 1 lw 1 lc rgb '#d0d0d0'\n";
}

void PlotPage::addPanel(size_t row, size_t column, const std::string& commands) {
  const double width = (kWidth - kRight) / static_cast<double>(columns_);
  const double left = static_cast<double>(column) * width;
  const double top = height_ - kKeyHeight - static_cast<double>(row) * kRowHeight;
  place(left + kLeft, left + width, top - kRowHeight + kTics, top - kTitle);
  script_ += commands + '\n';
}

void PlotPage::place(double left, double right, double bottom, double top) {
  std::ostringstream margins;
  margins << "set lmargin at screen " << left / kWidth << "\nset rmargin at screen " << right / kWidth
          << "\nset bmargin at screen " << bottom / height_ << "\nset tmargin at screen " << top / height_ << '\n';
  script_ += margins.str();
}

}  // namespace sweep_guard_recording
