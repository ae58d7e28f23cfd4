#include "app/lessons/simulated_driver/population.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <random>
#include <string>
#include <thread>

namespace gearshift::lessons {
namespace {

// [s] Longest time to read a prompt before acting on it: 1.05 s for reading and reaction (Green 2000), less 0.2 s.
constexpr double kMaxReadingTime = 0.85;
constexpr double kLimitQuantile = 0.96,
                 kLimitMargin = 1.3;  // [1] engineering values, set before the norms were checked
constexpr double kMinDistance = 1.0;  // [1] one standard deviation worse in every figure is no reason to fail
constexpr double kMinSpread = 1.1;    // [1] factor; people differ more than simulated drivers do (engineering value)

DriverSkill skill_in(const Population& population, std::uint64_t seed) {
  DriverSkill skill = skill_of(population.error);
  const DriverSkill practised;
  if (population.limbs == Limbs::hand) {
    DriverSkill hand = practised;
    hand.aim_noise = skill.aim_noise;
    hand.pace = skill.pace;
    hand.timing_spread = skill.timing_spread;
    skill = hand;
  } else if (population.limbs == Limbs::feet) {
    skill.aim_noise = practised.aim_noise;
    skill.pace = practised.pace;
  }
  std::mt19937_64 random(seed);  // `seed` itself is the driver's
  skill = in_style(skill, random(), population.style);
  if (population.mode == LessonMode::follow_me)
    skill.reading_time = kMaxReadingTime * static_cast<double>(random() >> 11) * 0x1.0p-53;
  return skill;
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double rank = q * static_cast<double>(values.size() - 1);
  const auto at = static_cast<std::size_t>(rank);
  const std::size_t next = std::min(at + 1, values.size() - 1);
  return values[at] + (rank - static_cast<double>(at)) * (values[next] - values[at]);
}

// Mean of a time over all shifts into a gear with the clutch [s]; 0 if there are none.
double mean_time(std::span<const LessonResult> results, double ShiftRecord::*time) {
  double sum = 0.0;
  int count = 0;
  for (const LessonResult& result : results) {
    for (const ShiftRecord& shift : result.shifts) {
      if (shift.missed || shift.to == haptics::kNeutralGear || shift.clutch_time <= 0.0) continue;
      sum += shift.*time;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

// Empty if a run lacks the figure.
std::optional<FigureNorm> figure_norm(std::span<const LessonResult> results, const RunFigure& figure) {
  double sum = 0.0, squares = 0.0;
  for (const LessonResult& result : results) {
    const std::optional<double> value = figure_of(result, figure);
    if (!value) return std::nullopt;
    const double x = figure_logarithm(figure, *value);
    sum += x;
    squares += x * x;
  }
  const auto n = static_cast<double>(results.size());
  const double mean = sum / n, variance = std::max(0.0, (squares - n * mean * mean) / (n - 1.0));
  return FigureNorm{rounded_for_norm(std::exp(mean)),
                    std::max(kMinSpread, rounded_for_norm(std::exp(std::sqrt(variance))))};
}

}  // namespace

std::vector<LessonResult> drive_population(const LessonDriveConfig& drive, const Population& population) {
  const auto count = static_cast<std::size_t>(std::max(0, population.drivers));
  std::vector<LessonResult> results(count);
  std::vector<std::uint64_t> seeds(count);
  std::mt19937_64 random(population.seed);
  for (std::uint64_t& seed : seeds) seed = random();
  std::atomic<std::size_t> next{0};
  std::exception_ptr problem;
  std::atomic_flag has_problem;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        LessonDriveConfig one = drive;
        one.skill = skill_in(population, seeds[i]);
        one.seed = seeds[i];
        one.mode = population.mode;
        one.guidance = 0.0;
        results[i] = drive_lesson(one);
      } catch (...) {
        if (!has_problem.test_and_set()) problem = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i) others.emplace_back(work);
    work();
  }
  if (problem) std::rethrow_exception(problem);
  return results;
}

Norm derive_norm(const LessonDriveConfig& drive, LessonMode mode) {
  LessonDriveConfig without = drive;
  without.lesson.norms.clear();
  const auto practised = [&](std::uint64_t seed) {
    std::vector<LessonResult> results = drive_population(without, {0.0, kNormDrivers, seed, mode});
    std::erase_if(results, [](const LessonResult& result) { return result.end != LessonEnd::done; });
    return results;
  };
  std::vector<LessonResult> results = practised(kNormSeed);
  Norm norm;
  norm.lesson = drive.lesson.key;
  norm.mode = mode;
  norm.car = drive.car.name;
  norm.path_length = rounded_for_norm(lesson_path_length(drive.lesson, driven_gate(drive.gate)));
  norm.clutch_lead = rounded_for_norm(mean_time(results, &ShiftRecord::clutch_lead));
  norm.clutch_lag = rounded_for_norm(mean_time(results, &ShiftRecord::clutch_lag));
  for (LessonResult& result : results) measure_figures(result, &norm);
  for (std::size_t i = 0; i < kFigureCount; ++i) norm.figures[i] = figure_norm(results, kRunFigures[i]);
  std::vector<double> distances;
  for (LessonResult& result : practised(kLimitSeed)) {
    measure_figures(result, &norm);
    distances.push_back(distance(result, norm));
  }
  norm.limit = rounded_for_norm(kLimitMargin * std::max(kMinDistance, quantile(distances, kLimitQuantile)));
  return norm;
}

}  // namespace gearshift::lessons
