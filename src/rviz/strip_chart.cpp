#include "rviz/strip_chart.h"

#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "rviz/palette.h"

namespace sweep_guard_rviz {
namespace {

constexpr double kLeft = 30.0;
constexpr double kRight = 6.0;
constexpr double kTop = 16.0;
constexpr double kBottom = 16.0;
constexpr double kSteps = 26.0;  // height of the level steps
constexpr double kGap = 8.0;

const QColor kPaper(22, 24, 27);
const QColor kRule(58, 62, 68);
const QColor kInk(170, 175, 182);
const QColor kCurve(235, 238, 242);

double secondsBetween(SteadyTime from, SteadyTime to) { return std::chrono::duration<double>(to - from).count(); }

double step(WarningLevel level) {
  constexpr double kShares[] = {0.3, 0.12, 0.55, 0.8, 1.0};  // of kSteps; unknown is hatched
  return kShares[static_cast<size_t>(level)];
}

// Maps times and levels to places on the widget.
class Axes {
 public:
  Axes(const QSize& size, double longest, SteadyTime now)
      : now_(now),
        curve_(kLeft, kTop, size.width() - kLeft - kRight, size.height() - kTop - kBottom - kSteps - kGap),
        steps_(kLeft, curve_.bottom() + kGap, curve_.width(), kSteps),
        most_(std::max(1.0, std::ceil(longest))) {}

  double x(SteadyTime time) const { return xBefore(secondsBetween(time, now_)); }
  double xBefore(double seconds) const {
    const double share = std::min(1.0, seconds / std::chrono::duration<double>(kHistory).count());
    return curve_.right() - share * curve_.width();
  }
  double y(double time) const { return curve_.bottom() - time / most_ * curve_.height(); }
  const QRectF& curve() const { return curve_; }
  const QRectF& steps() const { return steps_; }
  double most() const { return most_; }

 private:
  SteadyTime now_;
  QRectF curve_;
  QRectF steps_;
  double most_;
};

void drawRules(QPainter& painter, const Axes& axes) {
  painter.setPen(kRule);
  for (const double time : {0.0, 0.5 * axes.most(), axes.most()}) {
    painter.drawLine(QPointF(axes.curve().left(), axes.y(time)), QPointF(axes.curve().right(), axes.y(time)));
  }
  for (int before = 0; before <= 20; before += 5) {
    painter.drawLine(QPointF(axes.xBefore(before), kTop), QPointF(axes.xBefore(before), axes.steps().bottom()));
  }
  painter.setPen(kInk);
  for (const double time : {0.0, axes.most()}) {
    painter.drawText(QRectF(0.0, axes.y(time) - 8.0, kLeft - 4.0, 16.0), Qt::AlignRight | Qt::AlignVCenter,
                     QString::number(time) + " s");
  }
  painter.drawText(QRectF(kLeft, 0.0, axes.curve().width(), kTop), Qt::AlignLeft | Qt::AlignVCenter,
                   "time to collision");
  const QRectF below(kLeft, axes.steps().bottom(), axes.steps().width(), kBottom);
  painter.drawText(below, Qt::AlignLeft | Qt::AlignVCenter, "-20 s");
  painter.drawText(below, Qt::AlignCenter, "level");
  painter.drawText(below, Qt::AlignRight | Qt::AlignVCenter, "now");
}

void drawLevel(QPainter& painter, const Axes& axes, WarningLevel level, double from, double to) {
  const QRectF& place = axes.steps();
  const double height = step(level) * place.height();
  const QRectF bar(from, place.bottom() - height, std::max(1.0, to - from), height);
  painter.fillRect(bar,
                   level == WarningLevel::kUnknown ? QBrush(colorOf(level), Qt::BDiagPattern) : QBrush(colorOf(level)));
  QColor shade = colorOf(level);
  shade.setAlpha(level == WarningLevel::kClear || level == WarningLevel::kUnknown ? 0 : 50);
  painter.fillRect(QRectF(from, axes.curve().top(), bar.width(), axes.curve().height()), shade);
}

void drawLevels(QPainter& painter, const Axes& axes, const std::deque<LevelHistory::Sample>& samples) {
  for (size_t begin = 0; begin < samples.size();) {
    const WarningLevel level = samples[begin].level;
    size_t end = begin + 1;
    while (end < samples.size() && samples[end].level == level) ++end;
    drawLevel(painter, axes, level, axes.x(samples[begin].since),
              end < samples.size() ? axes.x(samples[end].since) : axes.xBefore(0.0));
    begin = end;
  }
}

// The line has gaps where there is no time to collision.
void drawTimes(QPainter& painter, const Axes& axes, const std::deque<LevelHistory::Sample>& samples) {
  QPolygonF line;
  for (const LevelHistory::Sample& sample : samples) {
    if (sample.time) {
      line << QPointF(axes.x(sample.since), axes.y(*sample.time));
      continue;
    }
    painter.drawPolyline(line);
    line.clear();
  }
  painter.drawPolyline(line);
}

}  // namespace

void LevelHistory::add(Sample sample) {
  if (!samples_.empty()) sample.since = std::max(sample.since, samples_.back().since);
  samples_.push_back(sample);
  while (samples_.size() > 1 && samples_[1].since + kHistory < sample.since) samples_.pop_front();
}

double LevelHistory::longestTime() const {
  double longest = 0.0;
  for (const Sample& sample : samples_) longest = std::max(longest, sample.time.value_or(0.0));
  return longest;
}

StripChart::StripChart(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void StripChart::show(const LevelHistory& history, SteadyTime now) {
  history_ = history;
  now_ = now;
  update();
}

void StripChart::paintEvent(QPaintEvent* /*event*/) {
  const Axes axes(size(), history_.longestTime(), now_);
  QPainter painter(this);
  painter.fillRect(rect(), kPaper);
  QFont font = painter.font();
  font.setPixelSize(10);
  painter.setFont(font);
  drawRules(painter, axes);

  drawLevels(painter, axes, history_.samples());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(kCurve, 1.6));
  drawTimes(painter, axes, history_.samples());
}

}  // namespace sweep_guard_rviz
