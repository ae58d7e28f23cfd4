#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/base/assets_path.h"
#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/trial.h"
#include "haptics/gate/plain_aisle.h"

namespace gearshift::lab {
namespace {

constexpr double kHardSpeed = 0.5, kGentleSpeed = 0.1;  // [m/s] speed of the first impact
constexpr double kMinsky = 0.5;                         // [1] damping / (stiffness x period), by the paper's eq (22)
constexpr double kDuration = 2.0;                       // [s]
constexpr double kJudgedTime = 0.2;                     // [s] last part of the run, in which the ripple is measured
constexpr double kCalmRipple = 0.3e-3;                  // [m] peak-to-peak limit: four counts of the paper's encoder
constexpr int kPhases = 16;                             // number of different impact times within a sampling period

// A lever that is thrown at a wall of the aisle.
struct Case {
  std::string tag, title;
  haptics::HapticConfig haptics;
  haptics::HandImpedance hand;  // this hand rests on the lever and does not push
  double speed = kHardSpeed;
};

struct Outcome {
  TrialRun run;  // the run with the largest ripple
  haptics::Gate gate;
  double ripple = 0.0;                 // [m] peak-to-peak motion at the end of `run`
  int calm = 0;                        // number of runs (one per phase) in which the lever came to rest
  double radius = 0.0;                 // [1] spectral radius of the loop while the lever is pressed against one wall
  double motor_energy_fraction = 0.0;  // [1] impact_energy_fraction(), averaged over the phases
};

// Energy that the motors supply in the first contact, divided by the impact energy. [1]
double impact_energy_fraction(const Trial& trial, const TrialRun& run) {
  const std::vector<TrialContact> all = contacts(run, trial.gate);
  if (all.empty()) return 0.0;
  const double mass = trial.lever.axis_x.mass + trial.lever.hand.mass;
  return all.front().energy / (0.5 * mass * all.front().speed * all.front().speed);
}

Outcome throw_lever(const Study& study, const Case& one) {
  const double wall = study.gate.half_aisle;
  Outcome worst;
  worst.gate = haptics::plain_aisle(wall, 0.030);
  for (int i = 0; i < kPhases; ++i) {
    Trial trial;
    trial.haptics = one.haptics;
    trial.lever = study.preset.lever;
    trial.lever.hand = one.hand;
    trial.gate = worst.gate;
    trial.start = before(wall, one.speed, haptics::period_s(one.haptics), (i + 0.5) / kPhases);
    trial.velocity = {one.speed, 0.0};
    trial.hand = carried_to(wall, one.speed, trial.lever.axis_x, haptics::HandTarget{});
    trial.duration = kDuration;
    TrialRun run = run_trial(trial);
    const double ripple = peak_to_peak(run, kJudgedTime);
    worst.calm += ripple < kCalmRipple;
    worst.radius = predicted_radius(trial, run.admitted);
    worst.motor_energy_fraction += impact_energy_fraction(trial, run) / kPhases;
    if (i > 0 && ripple <= worst.ripple) continue;
    worst.ripple = ripple;
    worst.run = std::move(run);
  }
  return worst;
}

// The wall of the preset "paper".
haptics::HapticConfig paper_wall() {
  return haptics::read_preset(base::find_asset("presets", "paper").string()).haptics;
}

haptics::HapticConfig with_damping(haptics::HapticConfig haptics) {
  haptics.tuning.wall_damping = kMinsky * haptics.tuning.wall_stiffness * haptics::period_s(haptics);
  return haptics;
}

haptics::HapticConfig at_rate(haptics::HapticConfig haptics, double rate) {
  haptics.rate = rate;
  return haptics;
}

// The paper's measures against oscillation, and the undamped wall for comparison.
std::vector<Case> make_cures(const haptics::HapticConfig& wall) {
  const haptics::HapticConfig damped = with_damping(wall);
  return {{"bare", "bare handle", wall, haptics::kBareHand, kHardSpeed},
          {"light", "light hand resting", wall, haptics::kLightHand, kHardSpeed},
          {"grip", "grip resting", wall, haptics::kGripHand, kHardSpeed},
          {"arm", "arm resting", wall, haptics::kArmHand, kHardSpeed},
          {"damped", "wall damping K T/2", damped, haptics::kBareHand, kHardSpeed},
          {"gentle", "lower speed", wall, haptics::kBareHand, kGentleSpeed},
          {"both", "lower speed and damping", damped, haptics::kBareHand, kGentleSpeed}};
}

// Describes contacts, ripple and energy of a case.
std::string describe(const Case& one, const Outcome& outcome) {
  return fmt::format(
      "{:g} m/s at {:g} Hz: {:.0f} contacts per second, {:.2f} mm peak-to-peak at the end; in the first impact the "
      "motors change the impact's energy by {:+.0f} %; calm in {} of {} phases; spectral radius {:.3f} while pressed "
      "to "
      "one wall",
      one.speed, one.haptics.rate, static_cast<double>(contacts(outcome.run, outcome.gate).size()) / kDuration,
      1e3 * outcome.ripple, 100.0 * outcome.motor_energy_fraction, outcome.calm, kPhases, outcome.radius);
}

std::string verdict(const Outcome& outcome) {
  if (outcome.calm == kPhases) return "calm";
  return outcome.calm > 0 ? "not always calm" : "not calm at this rate";
}

// ---- lowest rate at which a measure suffices ----

std::vector<double> rates() {
  std::vector<double> all;
  for (int i = 0; i <= 16; ++i) all.push_back(std::round(100.0 * std::pow(10.0, i / 16.0)));
  return all;
}

// ripple[cure][rate], in metres
std::vector<std::vector<double>> ripples(const Study& study, const haptics::HapticConfig& wall) {
  std::vector<std::vector<double>> all(make_cures(wall).size());
  for (const double rate : rates()) {
    report_progress(study, fmt::format("oscillation: {:g} Hz", rate));
    const std::vector<Case> cases = make_cures(at_rate(wall, rate));
    for (std::size_t i = 0; i < cases.size(); ++i) all[i].push_back(throw_lever(study, cases[i]).ripple);
  }
  return all;
}

// Lowest tested rate [Hz] for which the lever comes to rest at this rate and at all higher tested rates; 0 if none.
double sufficient_rate(const std::vector<double>& ripple) {
  double lowest = 0.0;
  for (std::size_t i = ripple.size(); i-- > 0 && ripple[i] < kCalmRipple;) lowest = rates()[i];
  return lowest;
}

// Lowest impact speed at which a lever without a hand keeps bouncing. [m/s]
double critical_speed(const Study& study, const haptics::HapticConfig& wall) {
  double calm = 0.0, bounces = kHardSpeed;
  while (bounces - calm > 0.002) {
    const double middle = 0.5 * (calm + bounces);
    (throw_lever(study, {"", "", wall, haptics::kBareHand, middle}).calm == kPhases ? calm : bounces) = middle;
  }
  return bounces;
}

// ---- figures ----

std::string curve_panel(const Case& one, const std::string& time, double wall) {
  return fmt::format(
      "set title \"{}, {:g} m/s, {:g} Hz\"\nplot {} with lines dashtype 2 linecolor \"{}\" notitle, -{} with "
      "lines dashtype 2 linecolor \"{}\" notitle, \"oscillation.csv\" using \"{}\":\"{}_x_mm\" with lines "
      "linewidth 1.1 linecolor \"{}\" notitle\n",
      one.title, one.speed, one.haptics.rate, wall, base::kSoftInk, wall, base::kSoftInk, time, one.tag,
      one.tag == "ours" ? base::kGearColour : base::kLockoutColour);
}

void draw_curves(const Study& study, const std::vector<Case>& cases, const std::vector<Outcome>& outcomes) {
  TrialTable table;
  const auto millimetres = [](const TrialSample& sample) { return 1e3 * sample.position.x; };
  std::string panels;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string time = cases[i].tag + "_time_s";
    table.add(time, outcomes[i].run, [](const TrialSample& sample) { return sample.time; });
    table.add(cases[i].tag + "_x_mm", outcomes[i].run, millimetres);
    panels += curve_panel(cases[i], time, 1e3 * study.gate.half_aisle);
  }
  table.write(study, "oscillation");
  draw(study,
       {"oscillation", 1100, 1000,
        fmt::format(
            "set multiplot layout 4,2 margins 0.07, 0.98, 0.06, 0.965 spacing 0.09, 0.075\nset xlabel \"time [s]\" "
            "offset 0,0.5\nset ylabel \"position [mm]\"\nset xrange [0:{:g}]\nset offsets 0, 0, graph 0.05, graph "
            "0.05\n{}unset multiplot\n",
            kDuration, panels)});
}

// Draws a row of squares per measure, which show at which rates the lever comes to rest.
void draw_rates(const Study& study, const std::vector<Case>& cases, const std::vector<std::vector<double>>& ripple) {
  TrialTable table;
  table.add("rate_hz", rates());
  std::string names, squares;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    std::vector<double> millimetres(ripple[i].size());
    std::transform(ripple[i].begin(), ripple[i].end(), millimetres.begin(), [](double metres) { return 1e3 * metres; });
    const std::string column = cases[i].tag + "_peak_to_peak_mm";
    table.add(column, std::move(millimetres));
    names += fmt::format("{}\"{}\" -{}", i == 0 ? "" : ", ", cases[i].title, i);
    for (const bool calm : {false, true}) {
      const char* title = calm ? "title \"comes to rest in every phase\"" : "title \"keeps bouncing in some phase\"";
      squares += fmt::format(
          "{} \"oscillation_rates.csv\" using \"rate_hz\":(column(\"{}\") {} {} ? -{} : 1/0) with points "
          "pointtype 5 pointsize 2.2 linecolor \"{}\" {}",
          squares.empty() ? "plot" : ",", column, calm ? "<" : ">=", 1e3 * kCalmRipple, i,
          calm ? base::kGearColour : base::kLockoutColour, i > 0 ? "notitle" : title);
    }
  }
  table.write(study, "oscillation_rates");
  draw(study,
       {"oscillation_rates", 900, 420,
        fmt::format("set logscale x\nset xrange [92:1090]\nset yrange [-6.6:0.6]\nset xtics (100, 150, 200, 300, "
                    "500, 1000)\nset ytics ({})\nset xlabel \"rate of the paper's wall [Hz]\"\nset key top center "
                    "outside horizontal\n{}\n",
                    names, squares)});
}

std::string describe_sufficient_rate(const std::vector<double>& ripple) {
  const double rate = sufficient_rate(ripple);
  return rate > 0.0 ? fmt::format("sufficient at {:g} Hz and above", rate) : "not sufficient at any tested rate";
}

// Returns one finding per case, in the order of make_cures(). The last case is our default.
std::vector<Finding> findings(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                              const std::vector<std::vector<double>>& ripple) {
  std::vector<Finding> all;
  const auto row = [&](const char* paper, std::size_t i) {
    all.push_back(
        {paper, cases[i].title + ", " + describe(cases[i], outcomes[i]),
         i < ripple.size() ? verdict(outcomes[i]) + "; " + describe_sufficient_rate(ripple[i]) : verdict(outcomes[i])});
  };
  row("Section 3.1: \"the joystick might bounce between the walls when it hit the wall hard\"", 0);
  row("Section 3.1: \"alleviated with the operator's hand resting on the joystick\" (light hand)", 1);
  row("Section 3.1: the same statement (grip)", 2);
  row("Section 3.1: the same statement (arm)", 3);
  row("Section 3.1: \"by introducing the damping into the virtual wall\", B/(K T) > 0.5 of (22)", 4);
  row("Section 3.1: \"speed reduction of the joystick\"", 5);
  row("Section 3.1: \"with both speed reduction ... and damping ... stability under a violated passivity condition\"",
      6);
  row("(not in the paper) the preset's wall", 7);
  return all;
}

}  // namespace

Section oscillation_section(const Study& study) {
  const haptics::HapticConfig wall = paper_wall();
  std::vector<Case> cases = make_cures(wall);
  cases.push_back({"ours", "the preset", study.preset.haptics, haptics::kBareHand, kHardSpeed});
  std::vector<Outcome> outcomes;
  outcomes.reserve(cases.size());
  for (const Case& one : cases) outcomes.push_back(throw_lever(study, one));
  const std::vector<std::vector<double>> ripple = ripples(study, wall);
  const double critical = critical_speed(study, wall);
  draw_curves(study, cases, outcomes);
  draw_rates(study, make_cures(wall), ripple);

  Section section{"oscillation", "Section 3.1: oscillation at a wall, and how to prevent it", "", {}, {}};
  section.text = fmt::format(
      "The lever is moved towards a wall of an aisle {:g} mm wide and released at the first sample inside the wall. "
      "The "
      "wall is the paper's, {:g} N/m held from sample to sample at {:g} Hz (presets/paper.toml), on the preset's "
      "device. "
      "Each row shows the worst of {} phases between impact and sample; calm means less than {:g} mm peak-to-peak in "
      "the last {:g} s of {:g} s.",
      2e3 * study.gate.half_aisle, wall.tuning.wall_stiffness, wall.rate, kPhases, 1e3 * kCalmRipple, kJudgedTime,
      kDuration);
  section.findings = findings(cases, outcomes, ripple);
  section.findings[5].difference += fmt::format("; below {:.2f} m/s the bare handle always comes to rest", critical);
  section.pictures = {
      {"oscillation",
       "A lever thrown at the paper's wall, with the measures that the paper names against bouncing; the last panel "
       "shows the preset. Dashed: the walls. The scales differ."},
      {"oscillation_rates", "The same measures at different rates: the lowest rate at which each measure suffices."}};
  return section;
}

}  // namespace gearshift::lab
