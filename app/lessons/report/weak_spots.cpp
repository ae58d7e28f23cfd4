#include "app/lessons/report/weak_spots.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>

#include "app/lessons/report/progress.h"

namespace gearshift::lessons {
namespace {

constexpr double kRare = 0.05 - 1e-9;  // [1] one-sided significance level: strictly below 5 %

double log_binomial(std::size_t k, std::size_t n) noexcept {
  const auto of = static_cast<double>(n), in = static_cast<double>(k);
  return std::lgamma(of + 1.0) - std::lgamma(in + 1.0) - std::lgamma(of - in + 1.0);
}

// Hypergeometric probabilities [1] that 0, 1, ... runs of the later half have the error.
std::vector<double> later_half_distribution(const LessonHalves& lesson) {
  const std::size_t with = lesson.earlier + lesson.recent, all = 2 * lesson.runs;
  std::vector<double> chances(std::min(with, lesson.runs) + 1, 0.0);
  for (std::size_t k = with > lesson.runs ? with - lesson.runs : 0; k < chances.size(); ++k)
    chances[k] =
        std::exp(log_binomial(k, with) + log_binomial(lesson.runs - k, all - with) - log_binomial(lesson.runs, all));
  return chances;
}

std::vector<double> distribution_of_sum(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> chances(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) chances[i + j] += a[i] * b[j];
  }
  return chances;
}

double per_ten(std::size_t count, std::size_t all) noexcept {
  return all == 0 ? 0.0 : 10.0 * static_cast<double>(count) / static_cast<double>(all);
}

std::vector<const LessonResult*> results_of(const LearnerHistory& history, const auto& counts) {
  std::vector<const LessonResult*> results;
  for (const RunRow& run : history.runs) {
    if (counts(run.result)) results.push_back(&run.result);
  }
  return results;
}

std::size_t shifts_of(std::span<const LessonResult* const> results) {
  std::size_t shifts = 0;
  for (const LessonResult* result : results) shifts += result->shifts.size();
  return shifts;
}

bool has(const LessonResult& result, ErrorKind kind) {
  return std::any_of(result.errors.begin(), result.errors.end(), [kind](const DrivingError& error) {
    return error.kind == kind && error.severity != Severity::note;
  });
}

using ByLesson = std::map<std::string, std::vector<const LessonResult*>>;

ByLesson by_lesson(std::span<const LessonResult* const> results) {
  ByLesson lessons;
  for (const LessonResult* result : results) lessons[result->lesson].push_back(result);
  return lessons;
}

std::vector<LessonHalves> halves_of(ErrorKind kind, const ByLesson& lessons) {
  std::vector<LessonHalves> all;
  for (const auto& [lesson, results] : lessons) {
    LessonHalves halves{results.size() / 2, 0, 0};
    for (std::size_t i = 0; i < halves.runs; ++i) {
      halves.earlier += has(*results[i], kind) ? 1 : 0;
      halves.recent += has(*results[results.size() - 1 - i], kind) ? 1 : 0;
    }
    if (halves.runs > 0) all.push_back(halves);
  }
  return all;
}

WeakSpot spot_of(ErrorKind kind, std::span<const LessonResult* const> results) {
  WeakSpot spot;
  spot.kind = kind;
  for (const LessonResult* result : results) {
    for (const DrivingError& error : result->errors) {
      if (error.kind != kind) continue;
      ++spot.by_severity[static_cast<std::size_t>(error.severity)], ++spot.count;
      if (is_graded(*result)) spot.points += error.points;
      if (is_graded(*result) && error.severity != Severity::note) ++spot.graded;
      if (!error.step.empty()) spot.newest_step = error;
    }
  }
  return spot;
}

// Sets the spot's rates in both halves, and its trend. The trend stays unknown if the error occurred only as a note, or
// only in runs outside both halves.
void compare(WeakSpot& spot, const std::vector<LessonHalves>& lessons) {
  LessonHalves sum;
  for (const LessonHalves& lesson : lessons) {
    sum.runs += lesson.runs;
    sum.earlier += lesson.earlier;
    sum.recent += lesson.recent;
  }
  spot.earlier = per_ten(sum.earlier, sum.runs);
  spot.recent = per_ten(sum.recent, sum.runs);
  if (sum.earlier + sum.recent > 0) spot.trend = trend_of(lessons);
}

// Counts the latest runs without the error. A lesson that never had it says nothing about it, and one whose own latest
// run had it shows that it is still there.
void count_clean_runs(WeakSpot& spot, std::span<const LessonResult* const> graded, const ByLesson& lessons) {
  std::size_t with = 0, runs = 0;
  for (const LessonResult* result : graded) {
    const std::vector<const LessonResult*>& same = lessons.at(result->lesson);
    const bool concerns =
        std::any_of(same.begin(), same.end(), [&](const LessonResult* r) { return has(*r, spot.kind); });
    if (!concerns) continue;
    if (has(*same.back(), spot.kind)) return void(spot.clean = 0);
    ++spot.clean;
    if (!has(*result, spot.kind)) continue;
    ++with, runs += spot.clean, spot.clean = 0;
  }
  if (with > 0 && clean_run_chance(with, runs, spot.clean) < kRare) spot.trend = Trend::gone;
}

}  // namespace

double clean_run_chance(std::size_t with, std::size_t runs, std::size_t clean) noexcept {
  double chance = 1.0;
  for (std::size_t i = 0; i < clean; ++i)
    chance *= static_cast<double>(runs - with + 1 + i) / static_cast<double>(runs + 2 + i);
  return chance;
}

Trend trend_of(std::span<const LessonHalves> lessons) {
  if (lessons.empty()) return Trend::unknown;
  std::vector<double> chances{1.0};
  std::size_t recent = 0;
  for (const LessonHalves& lesson : lessons) {
    chances = distribution_of_sum(chances, later_half_distribution(lesson));
    recent += lesson.recent;
  }
  double as_few = 0.0, as_many = 0.0;
  for (std::size_t k = 0; k < chances.size(); ++k) {
    if (k <= recent) as_few += chances[k];
    if (k >= recent) as_many += chances[k];
  }
  if (as_few < kRare) return Trend::falling;
  return as_many < kRare ? Trend::rising : Trend::unclear;
}

Weaknesses weaknesses(const LearnerHistory& history) {
  const auto results =
      results_of(history, [](const LessonResult& r) { return r.end != LessonEnd::running && r.is_complete; });
  const auto graded = results_of(history, is_graded);
  const ByLesson lessons = by_lesson(graded);
  Weaknesses found{shifts_of(results), {}};
  for (std::size_t i = 0; i < kErrorKindCount; ++i) {
    WeakSpot spot = spot_of(static_cast<ErrorKind>(i), results);
    if (spot.count == 0) continue;
    spot.per_ten = per_ten(spot.count - spot.by_severity[0], found.shifts);
    compare(spot, halves_of(spot.kind, lessons));
    count_clean_runs(spot, graded, lessons);
    found.spots.push_back(spot);
  }
  std::stable_sort(found.spots.begin(), found.spots.end(), [](const WeakSpot& a, const WeakSpot& b) {
    if ((a.trend == Trend::gone) != (b.trend == Trend::gone)) return b.trend == Trend::gone;
    return a.points != b.points ? a.points > b.points : a.count > b.count;
  });
  return found;
}

}  // namespace gearshift::lessons
