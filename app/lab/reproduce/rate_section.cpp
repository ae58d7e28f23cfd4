#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/base/assets_path.h"
#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/trial.h"
#include "haptics/analysis/spectral_radius.h"

namespace gearshift::lab {
namespace {

constexpr double kSpeed = 0.3, kPush = 20.0;              // [m/s], [N]
constexpr double kRateDuration = 1.2, kRateJudged = 0.2;  // [s] durations of a run and of its last, evaluated part
constexpr double kSlowRate = 100.0;                       // [Hz] the paper's
constexpr haptics::HandTarget kPushing{{0.0, 0.0}, {0.0, 0.0}, {kPush, 0.0}, false, false};

struct RateCase {
  const char* tag;
  const char* title;
  haptics::HapticConfig haptics;
};

std::array<RateCase, 3> make_cases(const Study& study) {
  haptics::HapticConfig slow = study.preset.haptics;
  slow.rate = kSlowRate;
  return {RateCase{"paper", "the paper's wall, 100 Hz",
                   haptics::read_preset(base::find_asset("presets", "paper").string()).haptics},
          RateCase{"ours", "the preset's wall", study.preset.haptics},
          RateCase{"slow", "the preset's wall, limited for 100 Hz", slow}};
}

Trial wall_trial(const Study& study, const RateCase& one, const haptics::HandImpedance& hand) {
  Trial trial;
  trial.haptics = one.haptics;
  trial.lever = study.preset.lever;
  trial.lever.hand = hand;
  trial.gate = wall_at_zero();
  trial.duration = kRateDuration;
  return trial;
}

// The lever meets the wall at a steady speed, then the hand pushes it into the wall.
TrialRun impact(const Study& study, const RateCase& one, const haptics::HandImpedance& hand) {
  Trial trial = wall_trial(study, one, hand);
  trial.start = before(0.0, kSpeed, haptics::period_s(one.haptics));
  trial.velocity = {kSpeed, 0.0};
  trial.hand = carried_to(0.0, kSpeed, trial.lever.axis_x, kPushing);
  return run_trial(trial);
}

// Returns the position changes from sample to sample of a lever that is pressed into the wall, nearly at rest at
// kDepth. Near this depth the cycle is linear, and a small disturbance grows with the cycle's largest eigenvalue.
// Encoder quantisation is off, because it is not linear. The reversal limiter is off, so that the stiffness stays
// constant; for this, `allow_unstable` must be set.
std::vector<double> free_steps(const Study& study, const RateCase& one, const haptics::HandImpedance& hand,
                               const haptics::AdmittedTuning& admitted) {
  constexpr double kDepth = 0.002, kDisturbance = 1e-8, kRounding = 1e-15;  // [m]
  Trial trial = wall_trial(study, one, hand);
  trial.lever.encoder_counts = 0.0;
  trial.haptics.tuning = admitted.tuning;
  trial.haptics.contact.hold = admitted.hold;
  trial.haptics.contact.reversal_limiter = false;
  trial.haptics.contact.allow_unstable = true;
  haptics::HandTarget pushing;
  pushing.push = {kDepth * (admitted.tuning.wall_stiffness + trial.lever.axis_x.stiffness + hand.stiffness), 0.0};
  trial.start = {kDepth + kDisturbance, 0.0};
  trial.hand = [pushing](double, glm::dvec2) { return pushing; };
  const TrialRun run = run_trial(trial);
  std::vector<double> steps;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    const TrialSample& now = run.samples[i];
    const double step = now.position.x - run.samples[i - 1].position.x;
    const bool is_linear = std::abs(now.position.x - kDepth) < 0.1 * kDepth && std::abs(step) > kRounding;
    if (!is_linear) break;
    steps.push_back(step);
  }
  return steps;
}

// Number of states of the cycle without delay: two of the lever, the last sample, and the smoothed velocity.
constexpr std::size_t kMaxOrder = 4;

// The linear recurrence that best predicts each step from the previous steps.
struct Recurrence {
  double radius = 0.0;  // [1] magnitude of the recurrence's largest root
  double misfit = 0.0;  // [1] root mean square of the residuals, relative to the steps
};

using NormalEquations = std::array<std::array<double, kMaxOrder + 1>, kMaxOrder>;  // last column: right-hand side

NormalEquations solve(NormalEquations rows, std::size_t order) {
  for (std::size_t pivot = 0; pivot < order; ++pivot) {
    const double diagonal = rows[pivot][pivot];
    for (double& entry : rows[pivot]) entry /= diagonal;
    for (std::size_t row = 0; row < order; ++row) {
      const double factor = row == pivot ? 0.0 : rows[row][pivot];
      for (std::size_t column = 0; column <= kMaxOrder; ++column) rows[row][column] -= factor * rows[pivot][column];
    }
  }
  return rows;
}

// Fits the recurrence of this order by least squares. Each equation is divided by the size of its terms, so that early
// and late steps have equal weight.
Recurrence recurrence(const std::vector<double>& steps, std::size_t order) {
  NormalEquations normal{};
  double squares = 0.0, count = 0.0;
  for (std::size_t i = steps.size() / 4; i + order < steps.size(); ++i) {
    double scale = 0.0;
    for (std::size_t k = 0; k <= order; ++k) scale = std::max(scale, std::abs(steps[i + k]));
    const auto ago = [&](std::size_t k) { return steps[i + order - k] / scale; };
    for (std::size_t row = 0; row < order; ++row) {
      for (std::size_t column = 0; column < order; ++column) normal[row][column] += ago(row + 1) * ago(column + 1);
      normal[row][kMaxOrder] += ago(row + 1) * ago(0);
    }
    squares += ago(0) * ago(0);
    count += 1.0;
  }
  const NormalEquations found = solve(normal, order);
  std::array<double, kMaxOrder * kMaxOrder> companion{};  // column by column
  for (std::size_t k = 0; k < order; ++k) {
    squares -= found[k][kMaxOrder] * normal[k][kMaxOrder];
    companion[k * order] = found[k][kMaxOrder];
    if (k + 1 < order) companion[k * order + k + 1] = 1.0;
  }
  return {haptics::largest_eigenvalue({companion.data(), order * order}, static_cast<int>(order)),
          std::sqrt(std::max(0.0, squares) / count)};
}

// Growth of a disturbance per cycle [1]: the largest root of the lowest-order recurrence that fits the steps. 0 if
// there are too few steps.
double growth(const std::vector<double>& steps) {
  constexpr double kMaxMisfit = 1e-3;
  if (steps.size() < 3 * kMaxOrder) return 0.0;
  Recurrence found = recurrence(steps, 2);
  for (std::size_t order = 3; order <= kMaxOrder && found.misfit > kMaxMisfit; ++order)
    found = recurrence(steps, order);
  return found.radius;
}

struct Result {
  TrialRun run;
  double predicted = 0.0, measured = 0.0;  // [1] growth of a disturbance per cycle; 0 if not measured
};

Result examine(const Study& study, const RateCase& one, const haptics::HandImpedance& hand) {
  Result result;
  result.run = impact(study, one, hand);
  const haptics::AdmittedTuning& admitted = result.run.admitted;
  result.predicted = predicted_radius(wall_trial(study, one, hand), admitted);
  result.measured = growth(free_steps(study, one, hand, admitted));
  return result;
}

std::string describe(const RateCase& one, const Result& result) {
  const std::vector<TrialContact> all = contacts(result.run, wall_at_zero());
  return fmt::format(
      "{}, {:.0f} N/m and {:.3g} N s/m: {:.1f} mm deep, {} contact{}, {:.3f} mm peak-to-peak at the end; the "
      "motors added {:+.2f} mJ in the first contact",
      one.title, result.run.stiffness, result.run.admitted.tuning.wall_damping, 1e3 * deepest(result.run), all.size(),
      all.size() == 1 ? "" : "s", 1e3 * peak_to_peak(result.run, kRateJudged),
      all.empty() ? 0.0 : 1e3 * all.front().energy);
}

std::string radii(const Result& result) {
  if (result.measured == 0.0)
    return fmt::format("growth per cycle: {:.4f} predicted; the disturbance grows or decays too fast to be measured",
                       result.predicted);
  return fmt::format("growth per cycle: {:.4f} measured, {:.4f} predicted ({})", result.measured, result.predicted,
                     relative(result.measured, result.predicted));
}

void add_columns(TrialTable& table, const RateCase& one, const Result& result, const char* hand) {
  const std::string tag = fmt::format("{}_{}", one.tag, hand);
  table.add(tag + "_time_s", result.run, [](const TrialSample& sample) { return sample.time; });
  table.add(tag + "_x_mm", result.run, [](const TrialSample& sample) { return 1e3 * sample.position.x; });
  table.add(tag + "_motor_n", result.run, [](const TrialSample& sample) { return -sample.motor.x; });
}

std::string panel(const std::array<RateCase, 3>& cases, const char* hand, const char* title) {
  constexpr std::array<const char*, 3> kColours{base::kLockoutColour, base::kGearColour, base::kBufferColour};
  std::string text =
      fmt::format("set title \"{}\"\nplot 0 with lines dashtype 2 linecolor \"{}\" notitle", title, base::kSoftInk);
  for (std::size_t i = 0; i < cases.size(); ++i)
    text += fmt::format(
        ", \"rate.csv\" using \"{0}_{1}_time_s\":\"{0}_{1}_x_mm\" with lines linewidth 1.4 linecolor \"{2}\" title "
        "\"{3}\"",
        cases[i].tag, hand, kColours[i], cases[i].title);
  return text + "\n";
}

}  // namespace

Section rate_section(const Study& study) {
  report_progress(study, "rate");
  const std::array<RateCase, 3> cases = make_cases(study);
  Section section{"rate", "Section 3.1: 5000 N/m at 100 Hz, the paper's wall and the preset's", "", {}, {}};
  section.text = fmt::format(
      "The lever meets the wall at {:g} m/s and is then pushed with {:g} N, once without hand impedance and once "
      "with that of a gripping hand. Three walls are tested: the paper's (presets/paper.toml, which allows unstable "
      "values), the preset's, and the preset's at {:g} Hz with the stiffness that is accepted at that rate. The growth "
      "per cycle of a tiny "
      "disturbance of the pressed lever is measured in the same simulation and compared with the predicted spectral "
      "radius; a wall with a radius above 1 is unstable.",
      kSpeed, kPush, kSlowRate);
  TrialTable table;
  for (const haptics::NamedHand& named :
       {haptics::NamedHand{"bare", haptics::kBareHand}, haptics::NamedHand{"grip", haptics::kGripHand}}) {
    for (const RateCase& one : cases) {
      const Result result = examine(study, one, named.hand);
      add_columns(table, one, result, named.name.data());
      const bool is_paper = &one == &cases.front();
      section.findings.push_back(
          {is_paper ? "Section 3.1: \"around 5000 N/m ... the constraint for the passivity condition, "
                      "specified in Eq. (21), is violated\""
                    : "(not in the paper)",
           fmt::format("{}, {}", named.name == "bare" ? "without hand impedance" : "gripping hand",
                       describe(one, result)),
           radii(result)});
    }
  }
  table.write(study, "rate");
  draw(study,
       {"rate", 1100, 520,
        fmt::format("set multiplot layout 1,2 margins 0.07, 0.98, 0.12, 0.82 spacing 0.09\nset xlabel \"time [s]\"\n"
                    "set ylabel \"position, the wall at 0 [mm]\"\nset key at screen 0.5, 0.98 center top horizontal\n"
                    "{}unset key\n{}unset multiplot\n",
                    panel(cases, "bare", "push without hand impedance"), panel(cases, "grip", "gripping hand"))});
  section.pictures = {{"rate",
                       "A push of 20 N into the wall: the lever bounces at the paper's wall at 100 Hz, but comes to "
                       "rest at the preset's wall. At 100 Hz, the preset's wall is softened until it is stable."}};
  return section;
}

}  // namespace gearshift::lab
