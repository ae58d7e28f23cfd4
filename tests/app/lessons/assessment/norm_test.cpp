// Figures of a run against the norm of practised drivers, and the file of norms.
#include "app/lessons/assessment/norm.h"

#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/suggest.h"
#include "haptics/files/file_error.h"

using namespace gearshift::lessons;

namespace {

ShiftRecord shift_with(double lead, double lag, double rev_error, double path, double impulse) {
  ShiftRecord shift;
  shift.to = 2;
  shift.clutch_time = 0.5;
  shift.clutch_lead = lead;
  shift.clutch_lag = lag;
  shift.rev_error = rev_error;
  shift.path_efficiency = path;
  shift.impulse = impulse;
  return shift;
}

constexpr const char* kFile = R"([[norm]]
lesson = "a"
mode = "follow_me"
car = "hatchback"
path_length_m = 0.125
clutch_lead_s = 0.1
clutch_lag_s = 0.3
limit = 1.5
clutch_heat_j = { typical = 1000, spread = 2 }
impulse_n_s = { typical = 4, spread = 1.5 }
)";

Norm norm_in(const std::string& text) {
  return parse_norms(text, "norms.toml").at(0);
}

}  // namespace

TEST_CASE("figures of a run by hand: root mean squares of times and revs, geometric means of path and impulse") {
  LessonResult result;
  result.slip_energy = 500.0;
  result.figures.jerk_peak = 20.0;
  result.shifts = {shift_with(0.13, 0.3, 3.0, 1.0, 2.0), shift_with(0.06, 0.3, -4.0, 1.44, 8.0)};
  result.shifts.push_back(shift_with(-5.0, -5.0, 900.0, 1.2, 4.0));
  result.shifts[2].to = gearshift::haptics::kNeutralGear;  // counts only for path and impulse
  Norm norm;
  norm.clutch_lead = 0.1;
  norm.clutch_lag = 0.3;
  measure_figures(result, &norm);
  CHECK(*figure_of(result, kRunFigures[0]) == 500.0);
  CHECK(*figure_of(result, kRunFigures[1]) == 20.0);
  CHECK(*result.figures.rev_error == doctest::Approx(std::sqrt(12.5)));
  CHECK(*result.figures.clutch_lead_error == doctest::Approx(std::sqrt(0.00125)));
  CHECK(*result.figures.clutch_lag_error == doctest::Approx(0.0));
  CHECK(*result.figures.path_efficiency == doctest::Approx(1.2));  // cube root of 1.44 * 1.2
  CHECK(*result.figures.impulse == doctest::Approx(4.0));          // cube root of 64
  measure_figures(result, nullptr);
  CHECK_FALSE(result.figures.clutch_lead_error);
  result.shifts.clear();
  measure_figures(result, &norm);
  CHECK_FALSE(result.figures.path_efficiency);
}

TEST_CASE(
    "the distance is the root mean square of deviations; better than typical is none, a missing figure the most") {
  const Norm norm = norm_in(kFile);
  LessonResult result;
  const auto distance_at = [&](double heat, double impulse) {
    result.slip_energy = heat;
    result.figures.impulse = impulse;
    return distance(result, norm);
  };
  CHECK(distance_at(1000.0, 4.0) == 0.0);
  CHECK(distance_at(10.0, 0.1) == 0.0);
  CHECK(distance_at(2000.0, 4.0) == doctest::Approx(std::sqrt(0.5)));
  CHECK(distance_at(4000.0, 6.0) == doctest::Approx(std::sqrt(2.5)));
  CHECK(distance_at(1e9, 4.0) == doctest::Approx(kMaxDeviation / std::sqrt(2.0)));
  result.figures.impulse.reset();
  CHECK(distance(result, norm) == doctest::Approx(kMaxDeviation));
}

TEST_CASE("each figure is shown beside the value that 19 of 20 practised drivers stay below") {
  const Norm norm = norm_in(kFile);
  LessonResult result;
  result.slip_energy = 4000.0;
  result.figures.impulse = 4.0;
  const std::vector<FigureLine> lines = figure_lines(result, &norm);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].label == "Clutch heat");
  CHECK(lines[0].value == "4.00 kJ");
  CHECK(lines[0].norm == "up to 3.13 kJ");  // 1 kJ times 2^1.645
  CHECK(lines[0].is_worse);
  CHECK_FALSE(lines[1].is_worse);
  CHECK(figure_lines(result, nullptr)[0].norm.empty());
  CHECK(worst_figure_sentence(result, norm) ==
        "Not yet as smooth as practised drivers. Farthest off: Clutch heat, 4.00 kJ (norm: up to 3.13 kJ).");
}

TEST_CASE("a file of norms is read as it was written, and a bad one is refused with its line") {
  const std::vector<Norm> norms = parse_norms(kFile, "norms.toml");
  REQUIRE(norms.size() == 1);
  CHECK(norms[0].mode == LessonMode::follow_me);
  CHECK(norms[0].figures[0]->spread == 2.0);
  CHECK_FALSE(norms[0].figures[1]);
  const std::string text = norms_text(norms);
  CHECK(norms_text(parse_norms(text, "norms.toml")) == text);
  CHECK(text.substr(text.find("[[norm]]")) == kFile);
  const auto refused = [](std::string bad, const std::string& from, const std::string& to, const char* why) {
    CHECK_THROWS_WITH_AS(parse_norms(bad.replace(bad.find(from), from.size(), to), "norms.toml"),
                         doctest::Contains(why), gearshift::haptics::FileError);
  };
  refused(kFile, "limit = 1.5", "limit = 0", "norms.toml:8: limit = 0");
  refused(kFile, "spread = 2 ", "spread = 0.5 ", "norms.toml:9: spread = 0.5");
  refused(kFile, "follow_me", "guided", "norms.toml:3: mode");
  refused(kFile, "path_length_m", "path_length", "path_length_m");
  CHECK(rounded_for_norm(1234.56) == 1235.0);
  CHECK(rounded_for_norm(-0.0123456) == -0.01235);
}

TEST_CASE("each shipped lesson has a norm in both modes, for the car that it is driven in by default") {
  for (const std::string_view key : kTeachingOrder) {
    const Lesson lesson = read_lesson(GEARSHIFT_ASSETS "/lessons/" + std::string(key) + ".toml");
    CAPTURE(key);
    for (const LessonMode mode : {LessonMode::follow_me, LessonMode::by_yourself}) {
      const Norm* norm = norm_of(lesson, mode);
      REQUIRE(norm != nullptr);  // `gearshift bench --norms` makes it
      CHECK(norm->car == (lesson.car.empty() ? "hatchback" : lesson.car));
      CHECK((norm->path_length > 0.0 || key == "stalled_in_a_junction"));  // which stays in first
    }
  }
  CHECK(norm_of(Lesson{}, LessonMode::follow_me) == nullptr);
}
