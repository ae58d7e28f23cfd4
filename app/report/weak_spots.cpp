#include "app/report/weak_spots.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "app/report/progress.h"

namespace gearshift {
namespace {

constexpr double kRare = 0.05;  // [1] chance, each way

struct Counts {
  std::array<std::size_t, kFaultKinds> faults{};
  std::size_t shifts = 0;
};

double binomial(std::size_t k, std::size_t n, double chance) noexcept {
  const auto of = static_cast<double>(n), in = static_cast<double>(k);
  const double ways = std::lgamma(of + 1.0) - std::lgamma(in + 1.0) - std::lgamma(of - in + 1.0);
  return std::exp(ways + in * std::log(chance) + (of - in) * std::log1p(-chance));
}

double per_ten_shifts(std::size_t count, std::size_t shifts) noexcept {
  return shifts == 0 ? 0.0 : 10.0 * static_cast<double>(count) / static_cast<double>(shifts);
}

std::vector<const LessonResult*> graded_results(const LearnerHistory& history) {
  std::vector<const LessonResult*> results;
  for (const ReportedRun& run : history.runs) {
    if (is_graded(run.row.result)) results.push_back(&run.row.result);
  }
  return results;
}

Counts counts_of(std::span<const LessonResult* const> results) {
  Counts counts;
  for (const LessonResult* result : results) {
    counts.shifts += result->shifts.size();
    for (const DriveFault& fault : result->faults) ++counts.faults[static_cast<std::size_t>(fault.kind)];
  }
  return counts;
}

// Number of runs in the earlier half: where the shifts before and after are most alike.
std::size_t middle(std::span<const LessonResult* const> results) {
  const std::size_t all = counts_of(results).shifts;
  std::size_t before = 0, best = 0, least = all;
  for (std::size_t i = 0; i < results.size(); ++i) {
    before += results[i]->shifts.size();
    const std::size_t apart = 2 * before > all ? 2 * before - all : all - 2 * before;
    if (apart < least) least = apart, best = i + 1;
  }
  return best;
}

WeakSpot spot_of(FaultKind kind, std::span<const LessonResult* const> results) {
  WeakSpot spot;
  spot.kind = kind;
  for (const LessonResult* result : results) {
    for (const DriveFault& fault : result->faults) {
      if (fault.kind != kind) continue;
      ++spot.by_severity[static_cast<std::size_t>(fault.severity)], ++spot.count;
      if (!fault.step.empty()) spot.newest_step = fault;
    }
    for (const Deduction& deduction : result->deductions) {
      if (deduction.fault < result->faults.size() && result->faults[deduction.fault].kind == kind)
        spot.points += deduction.points;
    }
  }
  return spot;
}

}  // namespace

Trend trend_of(std::size_t before, std::size_t shifts_before, std::size_t after, std::size_t shifts_after) noexcept {
  if (shifts_before == 0 || shifts_after == 0) return Trend::unknown;
  const double chance = static_cast<double>(shifts_after) / static_cast<double>(shifts_before + shifts_after);
  const std::size_t all = before + after;
  double as_few = 0.0, as_many = 0.0;
  for (std::size_t k = 0; k <= all; ++k) {
    const double p = binomial(k, all, chance);
    if (k <= after) as_few += p;
    if (k >= after) as_many += p;
  }
  if (as_few < kRare) return Trend::falling;
  return as_many < kRare ? Trend::rising : Trend::unclear;
}

Weaknesses weaknesses(const LearnerHistory& history) {
  const std::vector<const LessonResult*> results = graded_results(history);
  const std::span<const LessonResult* const> all(results);
  const std::size_t cut = middle(all);
  const Counts earlier = counts_of(all.first(cut)), lately = counts_of(all.subspan(cut));
  Weaknesses found{earlier.shifts + lately.shifts, {}};
  for (std::size_t i = 0; i < kFaultKinds; ++i) {
    const std::size_t before = earlier.faults[i], after = lately.faults[i];
    if (before + after == 0) continue;
    WeakSpot spot = spot_of(static_cast<FaultKind>(i), all);
    spot.earlier = per_ten_shifts(before, earlier.shifts);
    spot.lately = per_ten_shifts(after, lately.shifts);
    spot.per_ten = per_ten_shifts(before + after, found.shifts);
    spot.trend = trend_of(before, earlier.shifts, after, lately.shifts);
    found.spots.push_back(spot);
  }
  std::stable_sort(found.spots.begin(), found.spots.end(), [](const WeakSpot& a, const WeakSpot& b) {
    return a.points != b.points ? a.points > b.points : a.count > b.count;
  });
  return found;
}

}  // namespace gearshift
