#include "app/lessons/assessment/norm.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"
#include "haptics/files/toml_text.h"

namespace gearshift::lessons {
namespace {

constexpr double kNineteenOfTwenty = 1.645;  // [1] standard deviations: 95 % of a normal distribution lie below

const std::optional<FigureNorm>& values_of(const Norm& norm, const RunFigure& figure) noexcept {
  return norm.figures[static_cast<std::size_t>(&figure - kRunFigures)];
}

constexpr haptics::Range kPositive{0.0, 1e9}, kTime{-10.0, 10.0}, kSpread{1.0, 100.0};

const std::vector<std::string>& mode_keys() {
  static const std::vector<std::string> keys{std::string(to_string(LessonMode::follow_me)),
                                             std::string(to_string(LessonMode::by_yourself))};
  return keys;
}

Norm read_norm(const haptics::TomlTable& table) {
  Norm norm;
  norm.lesson = table.text("lesson");
  norm.mode = table.choice("mode", mode_keys()) == mode_keys()[0] ? LessonMode::follow_me : LessonMode::by_yourself;
  norm.car = table.text("car");
  norm.path_length = table.number("path_length_m", kPositive);
  norm.clutch_lead = table.number("clutch_lead_s", kTime);
  norm.clutch_lag = table.number("clutch_lag_s", kTime);
  norm.limit = table.number("limit", {1e-3, kMaxDeviation});
  for (std::size_t i = 0; i < kFigureCount; ++i) {
    if (!table.has(kRunFigures[i].name)) continue;
    const haptics::TomlTable values = table.table(kRunFigures[i].name);
    norm.figures[i] = FigureNorm{values.number("typical", {1e-9, 1e9}), values.number("spread", kSpread)};
    values.reject_unknown_keys();
  }
  table.reject_unknown_keys();
  return norm;
}

// Standard deviations by which the figure is worse than typical [1], 0 to kMaxDeviation.
double deviation(const LessonResult& result, const RunFigure& figure, const FigureNorm& norm) noexcept {
  const std::optional<double> value = figure_of(result, figure);
  if (!value) return kMaxDeviation;
  const double ratio = std::max(*value, figure.floor) / norm.typical;
  return std::clamp(std::log(ratio) / std::log(norm.spread), 0.0, kMaxDeviation);
}

std::string format_figure(const RunFigure& figure, double value) {
  return fmt::format("{:.{}f}{}", figure.scale * value, figure.decimals, figure.unit);
}

// The value that 19 of 20 practised drivers stay below.
double upper_value(const FigureNorm& norm) noexcept {
  return norm.typical * std::pow(norm.spread, kNineteenOfTwenty);
}

struct Mean {
  double sum = 0.0;
  int count = 0;
  void add(double value) noexcept { sum += value, ++count; }
  std::optional<double> value() const noexcept { return count > 0 ? std::optional(sum / count) : std::nullopt; }
};

std::optional<double> root(std::optional<double> square) noexcept {
  return square ? std::optional(std::sqrt(*square)) : std::nullopt;
}

std::optional<double> exp_of(std::optional<double> logarithm) noexcept {
  return logarithm ? std::optional(std::exp(*logarithm)) : std::nullopt;
}

// Root mean square of the deviations of the figures that count; 0 if there are none.
double distance_over(const LessonResult& result, const Norm& norm, auto counts) noexcept {
  Mean squares;
  for (const RunFigure& figure : kRunFigures) {
    const std::optional<FigureNorm>& values = values_of(norm, figure);
    if (!values || !counts(figure)) continue;
    const double by = deviation(result, figure, *values);
    squares.add(by * by);
  }
  return std::sqrt(squares.value().value_or(0.0));
}

}  // namespace

std::vector<Norm> read_norms(const std::filesystem::path& file) {
  return parse_norms(haptics::read_text_file(file), file.string());
}

std::vector<Norm> parse_norms(std::string_view text, const std::string& file_name) {
  std::vector<Norm> norms;
  const haptics::TomlTable root_table = haptics::TomlTable::parse(text, file_name);
  for (const haptics::TomlTable& table : root_table.tables("norm")) norms.push_back(read_norm(table));
  root_table.reject_unknown_keys();
  return norms;
}

double rounded_for_norm(double value) {
  return std::strtod(fmt::format("{:.3e}", value).c_str(), nullptr);
}

std::string norms_text(std::span<const Norm> norms) {
  std::string text =
      "# Figures of practised simulated drivers, each with its geometric mean and the factor of one standard "
      "deviation,\n"
      "# and the largest distance from them that passes. `gearshift bench --norms FILE` wrote this file.\n";
  for (const Norm& norm : norms) {
    text += fmt::format(
        "\n[[norm]]\nlesson = {}\nmode = {}\ncar = {}\npath_length_m = {}\nclutch_lead_s = {}\n"
        "clutch_lag_s = {}\nlimit = {}\n",
        haptics::toml_string(norm.lesson), haptics::toml_string(to_string(norm.mode)), haptics::toml_string(norm.car),
        haptics::toml_number(norm.path_length), haptics::toml_number(norm.clutch_lead),
        haptics::toml_number(norm.clutch_lag), haptics::toml_number(norm.limit));
    for (const RunFigure& figure : kRunFigures) {
      const std::optional<FigureNorm>& values = values_of(norm, figure);
      if (!values) continue;
      text += fmt::format("{} = {{ typical = {}, spread = {} }}\n", figure.name, haptics::toml_number(values->typical),
                          haptics::toml_number(values->spread));
    }
  }
  return text;
}

void measure_figures(LessonResult& result, const Norm* norm) {
  Mean rev, lead, lag, path, impulse;
  for (const ShiftRecord& shift : result.shifts) {
    path.add(std::log(shift.path_efficiency));
    impulse.add(std::log(std::max(shift.impulse, kMinImpulse)));
    if (shift.missed || shift.to == haptics::kNeutralGear) continue;
    rev.add(shift.rev_error * shift.rev_error);
    if (shift.clutch_time <= 0.0 || norm == nullptr) continue;
    lead.add((shift.clutch_lead - norm->clutch_lead) * (shift.clutch_lead - norm->clutch_lead));
    lag.add((shift.clutch_lag - norm->clutch_lag) * (shift.clutch_lag - norm->clutch_lag));
  }
  RunFigures& figures = result.figures;
  figures.rev_error = root(rev.value());
  figures.clutch_lead_error = root(lead.value());
  figures.clutch_lag_error = root(lag.value());
  figures.path_efficiency = exp_of(path.value());
  figures.impulse = exp_of(impulse.value());
}

std::optional<double> figure_of(const LessonResult& result, const RunFigure& figure) noexcept {
  return figure.member == nullptr ? result.slip_energy : result.figures.*figure.member;
}

double figure_logarithm(const RunFigure& figure, double value) noexcept {
  return std::log(std::max(value, figure.floor));
}

double distance(const LessonResult& result, const Norm& norm) noexcept {
  return distance_over(result, norm, [](const RunFigure&) { return true; });
}

double limb_distance(const LessonResult& result, const Norm& norm, bool of_lever) noexcept {
  return distance_over(result, norm, [of_lever](const RunFigure& figure) { return figure.of_lever == of_lever; });
}

std::vector<FigureLine> figure_lines(const LessonResult& result, const Norm* norm) {
  std::vector<FigureLine> lines;
  for (const RunFigure& figure : kRunFigures) {
    const std::optional<double> value = figure_of(result, figure);
    if (!value) continue;
    FigureLine line{&figure, *value, {}, {}, figure.label, format_figure(figure, *value), {}};
    if (const auto values = norm != nullptr ? values_of(*norm, figure) : std::nullopt) {
      line.typical = values->typical;
      line.upper = upper_value(*values);
      line.norm = "up to " + format_figure(figure, *line.upper);
      line.is_worse = *value > *line.upper;
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

const RunFigure* worst_figure(const LessonResult& result, const Norm& norm) noexcept {
  const RunFigure* worst = nullptr;
  double most = -1.0;
  for (const RunFigure& figure : kRunFigures) {
    const std::optional<FigureNorm>& values = values_of(norm, figure);
    if (!values || !figure_of(result, figure)) continue;
    const double by = deviation(result, figure, *values);
    if (by > most) worst = &figure, most = by;
  }
  return worst;
}

std::string worst_figure_sentence(const LessonResult& result, const Norm& norm) {
  const RunFigure* worst = worst_figure(result, norm);
  if (worst == nullptr) return "You did not use the clutch as practised drivers do.";
  return fmt::format("Not yet as smooth as practised drivers. Farthest off: {}, {} (norm: up to {}).", worst->label,
                     format_figure(*worst, *figure_of(result, *worst)),
                     format_figure(*worst, upper_value(*values_of(norm, *worst))));
}

}  // namespace gearshift::lessons
