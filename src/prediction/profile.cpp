#include "prediction/profile.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string_view>

#include "common/number_text.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr const char* kHeader = "sweep_guard_profile 1";
constexpr const char* kPredictor = "predictor direct";
constexpr const char* kEnd = "end";
constexpr double kMaxNumber = 1e12;
constexpr double kRounding = 1e-9;  // of an eigenvalue, relative to the largest

// What the numbers belong to.
std::string layout() {
  std::string text = "horizons";
  for (const double ahead : kLearnedHorizons) text += ' ' + shortestText(ahead);
  text += "\nregressors";
  for (const std::string& name : regressorNames()) text += ' ' + name;
  return text;
}

// Calls visit(key, first number, count) for each line of numbers.
template <typename P, typename Visit>
void forEachLine(P& profile, Visit&& visit) {
  visit("speeds", profile.speeds.squares.data(), 2);
  visit("speeds_time", &profile.speeds.time, 1);
  const auto visitRegression = [&](const std::string& key, auto& learned) {
    visit(key + "_information", learned.information.data(), learned.information.size());
    visit(key + "_projection", learned.projection.data(), learned.projection.size());
    visit(key + "_errors", learned.errors.data(), learned.errors.size());
    visit(key + "_time", &learned.time, 1);
  };
  for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
    const std::string ahead = shortestText(kLearnedHorizons[i]);
    visitRegression("translation_" + ahead, profile.translation[i]);
    visitRegression("rotation_" + ahead, profile.rotation[i]);
    visit("errors_" + ahead, profile.errors[i].data(), profile.errors[i].size());
  }
}

class Lines {
 public:
  explicit Lines(const std::string& text) : rest_(text) {}
  explicit Lines(std::string&&) = delete;

  std::string_view next() {
    ++number_;
    const size_t end = rest_.find('\n');
    if (end == std::string_view::npos) refuse("it is not complete");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }
  bool empty() const { return rest_.empty(); }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw InvalidInput("line " + std::to_string(number_) + " of the profile: " + reason);
  }

 private:
  std::string_view rest_;
  int number_ = 0;
};

void expectLine(Lines& lines, const std::string& wanted, const std::string& otherwise) {
  if (lines.next() != wanted) lines.refuse(otherwise);
}

double toNumber(std::string_view& words, const Lines& lines) {
  if (words.empty() || words.front() != ' ') lines.refuse("a number is missing");
  words.remove_prefix(1);
  const std::string_view word = words.substr(0, words.find(' '));
  const std::optional<double> number = parseNumber<double>(word);
  if (!number || !(std::abs(*number) <= kMaxNumber)) lines.refuse("it has a number that cannot be");
  words.remove_prefix(word.size());
  return *number;
}

// @param words  after the key
void readNumbers(std::string_view words, double* numbers, Eigen::Index count, const Lines& lines) {
  for (Eigen::Index i = 0; i < count; ++i) numbers[i] = toNumber(words, lines);
  if (!words.empty()) lines.refuse("it has too many numbers");
}

bool canBeLearned(const DisplacementRegression<PoseSpace::kAxes>::Learned& learned) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(learned.information, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd& eigenvalues = solver.eigenvalues();
  const bool semi_definite = eigenvalues.minCoeff() >= -kRounding * eigenvalues.maxCoeff();
  return semi_definite && (learned.errors >= 0.0).all() && learned.time >= 0.0;
}

bool canBeLearned(const Profile& profile) {
  bool good = (profile.speeds.squares >= 0.0).all() && profile.speeds.time > 0.0;
  for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
    good = good && canBeLearned(profile.translation[i]) && canBeLearned(profile.rotation[i]) &&
           (profile.errors[i] >= 0.0).all();
  }
  return good;
}

}  // namespace

std::string toText(const Profile& profile) {
  std::string text = std::string(kHeader) + '\n' + kPredictor + '\n' + layout() + '\n';
  forEachLine(profile, [&](const std::string& key, const double* numbers, Eigen::Index count) {
    text += key;
    for (Eigen::Index i = 0; i < count; ++i) text += ' ' + shortestText(numbers[i]);
    text += '\n';
  });
  return text + kEnd + '\n';
}

Profile profileFromText(const std::string& text) {
  Lines lines(text);
  if (text.size() > kMaxProfileSize) lines.refuse("it is too long");
  expectLine(lines, kHeader,
             std::string("it does not begin with '") + kHeader + "', so it is none or of another version");
  expectLine(lines, kPredictor, std::string("it is not of '") + kPredictor + "'");
  const std::string expected = layout() + '\n';
  for (Lines wanted(expected); !wanted.empty();) {
    const std::string line(wanted.next());
    expectLine(lines, line, "it is of other horizons or regressors than '" + line + "'");
  }
  Profile profile;
  forEachLine(profile, [&](const std::string& key, double* numbers, Eigen::Index count) {
    const std::string_view line = lines.next();
    if (line.substr(0, key.size()) != key) lines.refuse("it does not begin with '" + key + "'");
    readNumbers(line.substr(key.size()), numbers, count, lines);
  });
  expectLine(lines, kEnd, "it is not the end");
  if (!lines.empty()) lines.refuse("it is not the last one");
  if (!canBeLearned(profile)) lines.refuse("it ends numbers that no operator has taught");
  return profile;
}

}  // namespace sweep_guard_core
