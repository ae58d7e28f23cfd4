// Figures of how smoothly a lesson was driven, and how far they are from those of practised drivers.
//
// A norm describes practised simulated drivers in one lesson, mode and car. It stands in norms/simulated.toml beside the
// lesson's file, where `gearshift bench --norms` writes it. Lessons without a norm are judged by their errors only.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/lesson_result.h"

namespace gearshift::lessons {

inline constexpr std::size_t kFigureCount = std::size(kRunFigures);

// The logarithm of a figure of practised drivers is normally distributed.
struct FigureNorm {
  double typical = 1.0;  // geometric mean, in the figure's unit, > 0
  double spread = 1.0;   // [1] factor of one standard deviation, > 1
};

struct Norm {
  std::string lesson;  // key
  LessonMode mode = LessonMode::by_yourself;
  std::string car;           // name of the car
  double path_length = 0.0;  // [m] shortest path of the lever through the lesson's gears; differs between gates
  double clutch_lead = 0.0;  // [s] mean ShiftRecord::clutch_lead of practised drivers
  double clutch_lag = 0.0;   // [s] mean ShiftRecord::clutch_lag
  std::array<std::optional<FigureNorm>, kFigureCount>
      figures{};       // of kRunFigures; empty: not every practised run has it
  double limit = 1.0;  // [1] largest distance() that passes
};

// Reads a file of norms. Throws FileError.
std::vector<Norm> read_norms(const std::filesystem::path& file);
std::vector<Norm> parse_norms(std::string_view text, const std::string& file_name);
std::string norms_text(std::span<const Norm> norms);  // the content of such a file
double rounded_for_norm(double value);                // to the four digits that the file has

// Sets the result's figures, except `jerk_peak`, from its shifts. `norm` may be null; then the times of the clutch are
// not compared and stay empty.
void measure_figures(LessonResult& result, const Norm* norm);

double figure_logarithm(const RunFigure& figure,
                        double value) noexcept;  // of the value, or of the smallest that counts
std::optional<double> figure_of(const LessonResult& result, const RunFigure& figure) noexcept;

// Root mean square over the norm's figures of how many standard deviations each is worse than typical: 0 to kMaxDeviation.
// A better figure counts as 0, a missing one as kMaxDeviation. Only practised drivers make a norm, so it needs no
// model of unskilled ones (one-class classification: Tax, Duin. Support Vector Data Description. 2004).
double distance(const LessonResult& result, const Norm& norm) noexcept;
// The same over the figures of the hand, or of the feet, only.
double limb_distance(const LessonResult& result, const Norm& norm, bool of_lever) noexcept;
inline constexpr double kMaxDeviation = 5.0;  // [1] one slip must not outweigh all else (engineering value)

// A figure and its norm, also as text.
struct FigureLine {
  const RunFigure* figure = nullptr;
  double measured = 0.0;                 // in the unit of the figure's name
  std::optional<double> typical, upper;  // of practised drivers; 19 of 20 stay below `upper`; empty without a norm
  std::string_view label;                // "Largest jerk"
  std::string value;                     // "87 m/s³"
  std::string norm;                      // "up to 34": 19 of 20 practised drivers; empty without a norm
  bool is_worse = false;                 // worse than the norm
};
std::vector<FigureLine> figure_lines(const LessonResult& result, const Norm* norm);

// The figure that is farthest from its norm; null if the run has none of the norm's figures.
const RunFigure* worst_figure(const LessonResult& result, const Norm& norm) noexcept;
std::string worst_figure_sentence(const LessonResult& result, const Norm& norm);

// Says on every page with such figures where the norm is from.
inline constexpr std::string_view kNormOrigin = "The norm is of practised simulated drivers, not of people.";

}  // namespace gearshift::lessons
