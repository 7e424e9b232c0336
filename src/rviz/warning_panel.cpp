#include "rviz/warning_panel.h"

#include <ros/names.h>

#include <pluginlib/class_list_macros.hpp>

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "rviz/palette.h"
#include "rviz/traffic_light.h"

namespace sweep_guard_rviz {
namespace {

constexpr unsigned kRefreshesPerChart = 3;
constexpr size_t kMaxReasons = 4;
const char* const kTopic = "Warning Topic";
const char* const kMotionTopic = "Motion Status Topic";

QString bullets(const std::vector<std::string>& reasons, size_t max_count) {
  QStringList lines;
  for (size_t i = 0; i < std::min(max_count, reasons.size()); ++i)
    lines << QString::fromUtf8("\u2022 ") + reasons[i].c_str();
  if (reasons.size() > max_count) lines << QString("and %1 more").arg(reasons.size() - max_count);
  return lines.join('\n');
}

QLabel* makeLabel(QWidget* parent) {
  auto* const label = new QLabel(parent);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  return label;
}

}  // namespace

WarningPanel::WarningPanel(QWidget* parent)
    : rviz::Panel(parent),
      light_(new TrafficLight(this)),
      held_(makeLabel(this)),
      target_(makeLabel(this)),
      force_(makeLabel(this)),
      reasons_(makeLabel(this)),
      chart_(new StripChart(this)),
      acknowledge_(new QPushButton("I know", this)),
      enable_(new QPushButton(this)),
      reset_(new QPushButton("Reset", this)),
      outcome_(makeLabel(this)),
      topic_edit_(new QLineEdit(this)),
      motion_edit_(new QLineEdit(this)) {
  light_->setObjectName("light");
  held_->setObjectName("held");
  force_->setObjectName("force");
  acknowledge_->setObjectName("acknowledge");
  enable_->setObjectName("enable");
  reset_->setObjectName("reset");
  outcome_->setObjectName("outcome");
  layOut();
  connect(acknowledge_, &QPushButton::clicked, this, [this] {
    if (canAcknowledge()) call_.acknowledge(announceCall("acknowledge"), newest_->warning.mesh_id);
  });
  connect(enable_, &QPushButton::clicked, this, [this] { call_.setBool(announceCall("enable"), state_.disabled); });
  connect(reset_, &QPushButton::clicked, this, [this] { call_.trigger(announceCall("reset")); });
  connect(topic_edit_, &QLineEdit::editingFinished, this, [this] {
    if (topic_edit_->text().toStdString() == topic_) return;
    setTopic(topic_edit_->text().toStdString());
    Q_EMIT configChanged();
  });
  connect(motion_edit_, &QLineEdit::editingFinished, this, [this] {
    if (motion_edit_->text().toStdString() == motion_feed_.topic()) return;
    setMotionTopic(motion_edit_->text().toStdString());
    Q_EMIT configChanged();
  });
  setTopic("sweep_guard/warning");
  setMotionTopic("motion_guard/status");
  connect(&timer_, &QTimer::timeout, this, [this] { refresh(currentInstant()); });
  timer_.setTimerType(Qt::PreciseTimer);
  timer_.start(kPeriod);
}

WarningPanel::~WarningPanel() {
  // They emit editingFinished when they lose the focus, after the rest of the panel is destroyed.
  for (const QLineEdit* const edit : {topic_edit_, motion_edit_}) disconnect(edit, nullptr, this, nullptr);
}

void WarningPanel::layOut() {
  QFont bold = target_->font();
  bold.setBold(true);
  target_->setFont(bold);
  held_->setFont(bold);
  const int line = reasons_->fontMetrics().lineSpacing();
  for (QLineEdit* const edit : {topic_edit_, motion_edit_}) edit->setFocusPolicy(Qt::ClickFocus);
  acknowledge_->setToolTip(
      "Shows an amber warning of this workpiece with less emphasis for a while. This is no permission");
  reset_->setToolTip("Clears faults and forgets all poses, as after a start");

  auto* const place = new QWidget(this);
  place->setMinimumHeight(6 * line);  // keeps the widgets below in place
  auto* const texts = new QVBoxLayout(place);
  texts->setContentsMargins(9, 4, 9, 0);
  texts->addWidget(held_);
  texts->addWidget(target_);
  texts->addWidget(force_);
  texts->addWidget(reasons_);
  texts->addStretch();
  auto* const buttons = new QHBoxLayout;
  buttons->setContentsMargins(9, 0, 9, 0);
  buttons->addWidget(acknowledge_);
  buttons->addWidget(enable_);
  buttons->addWidget(reset_);
  auto* const topic = new QFormLayout;
  topic->setContentsMargins(9, 0, 9, 6);
  topic->addRow("Topic", topic_edit_);
  topic->addRow("Motion", motion_edit_);
  topic->addRow(outcome_);
  outcome_->hide();

  auto* const all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(light_, 3);
  all->addWidget(place);
  all->addWidget(chart_, 2);
  all->addLayout(buttons);
  all->addLayout(topic);
}

void WarningPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString topic;
  if (config.mapGetString(kTopic, &topic)) setTopic(topic.toStdString());
  if (config.mapGetString(kMotionTopic, &topic)) setMotionTopic(topic.toStdString());
}

void WarningPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue(kTopic, QString::fromStdString(topic_));
  config.mapSetValue(kMotionTopic, QString::fromStdString(motion_feed_.topic()));
}

void WarningPanel::setTopic(const std::string& topic) {
  topic_ = topic;
  heard_topic_ = topic;
  topic_edit_->setText(QString::fromStdString(topic));
  guard_.clear();
  newest_.reset();
  history_.clear();
  call_.drop();
  outcome_->hide();
  try {
    feed_.listen(topic);
    if (!topic.empty()) heard_topic_ = ros::names::resolve(topic);
    guard_ = ros::names::parentNamespace(heard_topic_);
  } catch (const ros::InvalidNameException& error) {
    showOutcome(error.what());
  }
  refresh(currentInstant());
}

void WarningPanel::setMotionTopic(const std::string& topic) {
  motion_edit_->setText(QString::fromStdString(topic));
  try {
    motion_feed_.listen(topic);
  } catch (const ros::InvalidNameException& error) {
    showOutcome(error.what());
  }
}

std::string WarningPanel::announceCall(const std::string& service) {
  std::string name = ros::names::append(guard_, service);
  showOutcome("waiting for " + name);
  return name;
}

void WarningPanel::showOutcome(const std::string& outcome) {
  outcome_->setText(QString::fromStdString(outcome));
  outcome_->show();
}

void WarningPanel::refresh(const Instant& now) {
  const std::vector<ReceivedWarning> warnings = feed_.take();
  if (!warnings.empty()) newest_ = warnings.back();
  state_ = panelState(newest_, now, heard_topic_);
  remember(warnings, now.steady);
  showState(now.steady);
  showForce();
  showMotion();
  if (const auto outcome = call_.takeOutcome()) showOutcome(*outcome);
}

void WarningPanel::remember(const std::vector<ReceivedWarning>& warnings, SteadyTime now) {
  for (const ReceivedWarning& each : warnings) {
    const PanelState shown = panelState(each, each.received, heard_topic_);
    history_.add({each.received.steady, shown.level, shown.silent ? std::nullopt : timeToCollision(each.warning)});
  }
  if (state_.silent) history_.add({now, WarningLevel::kUnknown, std::nullopt});
}

void WarningPanel::showState(SteadyTime now) {
  light_->show(state_);
  target_->setText(QString::fromStdString(state_.target));
  target_->setVisible(!state_.target.empty());
  reasons_->setText(bullets(state_.reasons, kMaxReasons));
  reasons_->setToolTip(state_.reasons.size() > kMaxReasons ? bullets(state_.reasons, state_.reasons.size())
                                                           : QString());
  enable_->setText(state_.disabled ? "Enable" : "Disable");
  const bool may_call = !guard_.empty() && !call_.busy();
  for (QPushButton* const button : {enable_, reset_}) button->setEnabled(may_call);
  acknowledge_->setEnabled(may_call && canAcknowledge());
  if (refreshes_++ % kRefreshesPerChart == 0) chart_->show(history_, now);
}

void WarningPanel::showForce() {
  const bool touches = state_.level == WarningLevel::kContact && newest_ && !newest_->warning.held;
  force_feed_.listen(touches && !guard_.empty() ? ros::names::append(guard_, "interaction") : "");
  const auto force = force_feed_.newest();
  const std::string text = force ? describe(*force) : "";
  force_->setText(QString::fromStdString(text));
  force_->setVisible(!text.empty());
}

void WarningPanel::showMotion() {
  const auto status = motion_feed_.newest();
  const HeldState held = status ? heldState(*status) : HeldState();
  if (held.text.empty()) return held_->hide();
  held_->setText(QString::fromStdString(held.text));
  held_->setStyleSheet("padding: 4px; color: white; background: " + heldColor(held.stopped).name());
  held_->show();
}

bool WarningPanel::canAcknowledge() const {
  return newest_ && state_.level == WarningLevel::kConsidered && !state_.acknowledged &&
         !newest_->warning.mesh_id.empty();
}

}  // namespace sweep_guard_rviz

PLUGINLIB_EXPORT_CLASS(sweep_guard_rviz::WarningPanel, rviz::Panel)
