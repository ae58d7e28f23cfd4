#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/assets_path.h"
#include "app/draw/gate_colours.h"
#include "app/reproduce/section.h"
#include "app/reproduce/study_files.h"
#include "app/reproduce/trial.h"
#include "haptics/gate/plain_aisle.h"

namespace gearshift {
namespace {

constexpr double kHard = 0.5, kGentle = 0.1;  // [m/s] of the first impact
constexpr double kMinsky = 0.5;               // (22): B / (K T) above about 0.5
constexpr double kDuration = 2.0;             // [s]
constexpr double kJudged = 0.2;               // [s] that are judged
constexpr double kCalm = 0.3e-3;              // [m] peak-to-peak: four counts of the paper's encoder
constexpr int kPhases = 16;                   // of the impact between two samples

// A lever thrown at a wall of the aisle.
struct Case {
  std::string tag, title;
  HapticConfig haptics;
  HandImpedance hand;  // rests on the lever, without a push
  double speed = kHard;
};

struct Outcome {
  TrialRun run;  // the worst of all phases
  Gate gate;
  double ripple = 0.0;  // [m] its last peak-to-peak
  int calm = 0;         // phases that came to rest
  double radius = 0.0;  // [1] pressed to one wall
  double given = 0.0;   // [1] by the motors in the first contact, of the impact's energy: mean of the phases
};

// What the motors gave the lever in the first contact, of the energy that it brought.
double share_given(const Trial& trial, const TrialRun& run) {
  const std::vector<TrialContact> all = contacts(run, trial.gate);
  if (all.empty()) return 0.0;
  const double mass = trial.lever.axis_x.mass + trial.lever.hand.mass;
  return all.front().energy / (0.5 * mass * all.front().speed * all.front().speed);
}

Outcome throw_lever(const Study& study, const Case& one) {
  const double wall = study.gate.half_aisle;
  Outcome worst;
  worst.gate = plain_aisle(wall, 0.030);
  for (int i = 0; i < kPhases; ++i) {
    Trial trial;
    trial.haptics = one.haptics;
    trial.lever = study.preset.lever;
    trial.lever.hand = one.hand;
    trial.gate = worst.gate;
    trial.start = before(wall, one.speed, period_s(one.haptics), (i + 0.5) / kPhases);
    trial.velocity = {one.speed, 0.0};
    trial.hand = carried_to(wall, one.speed, trial.lever.axis_x, HandTarget{});
    trial.duration = kDuration;
    TrialRun run = run_trial(trial);
    const double ripple = peak_to_peak(run, kJudged);
    worst.calm += ripple < kCalm;
    worst.radius = predicted_radius(trial, run.admitted);
    worst.given += share_given(trial, run) / kPhases;
    if (i > 0 && ripple <= worst.ripple) continue;
    worst.ripple = ripple;
    worst.run = std::move(run);
  }
  return worst;
}

// The paper's wall on the device of the study.
HapticConfig paper_wall() {
  return read_preset(find_asset("presets", "paper").string()).haptics;
}

HapticConfig with_damping(HapticConfig haptics) {
  haptics.tuning.wall_damping = kMinsky * haptics.tuning.wall_stiffness * period_s(haptics);
  return haptics;
}

HapticConfig at_rate(HapticConfig haptics, double rate) {
  haptics.rate = rate;
  return haptics;
}

// What the paper names against the oscillation, at one rate.
std::vector<Case> cures(const HapticConfig& wall) {
  const HapticConfig damped = with_damping(wall);
  return {{"bare", "bare handle", wall, kBareHand, kHard},
          {"light", "light hand resting", wall, kLightHand, kHard},
          {"grip", "grip resting", wall, kGripHand, kHard},
          {"arm", "arm resting", wall, kArmHand, kHard},
          {"damped", "wall damping K T/2", damped, kBareHand, kHard},
          {"gentle", "lower speed", wall, kBareHand, kGentle},
          {"both", "lower speed and damping", damped, kBareHand, kGentle}};
}

// Bounces, ripple and energy in words.
std::string words(const Case& one, const Outcome& outcome) {
  return fmt::format(
      "{:g} m/s at {:g} Hz: {:.0f} contacts a second, {:.2f} mm peak-to-peak at the end; the motors give {:+.0f} % of "
      "its energy to the first impact; calm in {} of {} phases; pressed to one wall the spectral radius is {:.3f}",
      one.speed, one.haptics.rate, static_cast<double>(contacts(outcome.run, outcome.gate).size()) / kDuration,
      1e3 * outcome.ripple, 100.0 * outcome.given, outcome.calm, kPhases, outcome.radius);
}

std::string verdict(const Outcome& outcome) {
  if (outcome.calm == kPhases) return "calm";
  return outcome.calm > 0 ? "not always" : "not at this rate";
}

// ---- the lowest rate at which a cure suffices ----

std::vector<double> rates() {
  std::vector<double> all;
  for (int i = 0; i <= 16; ++i) all.push_back(std::round(100.0 * std::pow(10.0, i / 16.0)));
  return all;
}

// ripple[cure][rate], in metres
std::vector<std::vector<double>> ripples(const Study& study, const HapticConfig& wall) {
  std::vector<std::vector<double>> all(cures(wall).size());
  for (const double rate : rates()) {
    tell(study, fmt::format("oscillation: {:g} Hz", rate));
    const std::vector<Case> cases = cures(at_rate(wall, rate));
    for (std::size_t i = 0; i < cases.size(); ++i) all[i].push_back(throw_lever(study, cases[i]).ripple);
  }
  return all;
}

// From here on upwards calm; 0 where not even the highest is.
double sufficient_rate(const std::vector<double>& ripple) {
  double enough = 0.0;
  for (std::size_t i = ripple.size(); i-- > 0 && ripple[i] < kCalm;) enough = rates()[i];
  return enough;
}

// Lowest speed at which the bare handle goes on bouncing. [m/s]
double critical_speed(const Study& study, const HapticConfig& wall) {
  double calm = 0.0, bounces = kHard;
  while (bounces - calm > 0.002) {
    const double middle = 0.5 * (calm + bounces);
    (throw_lever(study, {"", "", wall, kBareHand, middle}).calm == kPhases ? calm : bounces) = middle;
  }
  return bounces;
}

// ---- figures ----

std::string curve_panel(const Case& one, const std::string& time, double wall) {
  return fmt::format(
      "set title \"{}, {:g} m/s, {:g} Hz\"\nplot {} with lines dashtype 2 linecolor \"{}\" notitle, -{} with "
      "lines dashtype 2 linecolor \"{}\" notitle, \"oscillation.csv\" using \"{}\":\"{}_x_mm\" with lines "
      "linewidth 1.1 linecolor \"{}\" notitle\n",
      one.title, one.speed, one.haptics.rate, wall, kSoftInk, wall, kSoftInk, time, one.tag,
      one.tag == "ours" ? kGearColour : kLockoutColour);
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

// One row of squares per cure: does the lever come to rest?
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
      const char* title = calm ? "title \"comes to rest in every phase\"" : "title \"goes on in some phase\"";
      squares += fmt::format(
          "{} \"oscillation_rates.csv\" using \"rate_hz\":(column(\"{}\") {} {} ? -{} : 1/0) with points "
          "pointtype 5 pointsize 2.2 linecolor \"{}\" {}",
          squares.empty() ? "plot" : ",", column, calm ? "<" : ">=", 1e3 * kCalm, i,
          calm ? kGearColour : kLockoutColour, i > 0 ? "notitle" : title);
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

std::string enough(const std::vector<double>& ripple) {
  const double rate = sufficient_rate(ripple);
  return rate > 0.0 ? fmt::format("suffices from {:g} Hz", rate) : "suffices at no rate tried";
}

// One row a case, in the order of cures(); the last is ours.
std::vector<Finding> findings(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                              const std::vector<std::vector<double>>& ripple) {
  std::vector<Finding> all;
  const auto row = [&](const char* paper, std::size_t i) {
    all.push_back({paper, cases[i].title + ", " + words(cases[i], outcomes[i]),
                   i < ripple.size() ? verdict(outcomes[i]) + "; " + enough(ripple[i]) : verdict(outcomes[i])});
  };
  row("Section 3.1: \"the joystick might bounce between the walls when it hit the wall hard\"", 0);
  row("Section 3.1: \"alleviated with the operator's hand resting on the joystick\": light", 1);
  row("the same: grip", 2);
  row("the same: arm", 3);
  row("Section 3.1: \"by introducing the damping into the virtual wall\", B/(K T) > 0.5 of (22)", 4);
  row("Section 3.1: \"speed reduction of the joystick\"", 5);
  row("Section 3.1: \"with both speed reduction ... and damping ... stability under a violated passivity condition\"",
      6);
  row("(ours: the preset)", 7);
  return all;
}

}  // namespace

Section oscillation_section(const Study& study) {
  const HapticConfig wall = paper_wall();
  std::vector<Case> cases = cures(wall);
  cases.push_back({"ours", "ours, the preset's", study.preset.haptics, kBareHand, kHard});
  std::vector<Outcome> outcomes;
  outcomes.reserve(cases.size());
  for (const Case& one : cases) outcomes.push_back(throw_lever(study, one));
  const std::vector<std::vector<double>> ripple = ripples(study, wall);
  const double critical = critical_speed(study, wall);
  draw_curves(study, cases, outcomes);
  draw_rates(study, cures(wall), ripple);

  Section section{"oscillation", "Section 3.1: the wall's oscillation, and what calms it", "", {}, {}};
  section.text = fmt::format(
      "The lever is carried to a wall of an aisle {:g} mm wide and let go at the first sample in it; the wall is the "
      "paper's, {:g} N/m from the last sample at {:g} Hz (presets/paper.toml), on the preset's device. Each row is the "
      "worst of {} phases between impact and sample; calm is below {:g} mm peak-to-peak over the last {:g} s of {:g} "
      "s.",
      2e3 * study.gate.half_aisle, wall.tuning.wall_stiffness, wall.rate, kPhases, 1e3 * kCalm, kJudged, kDuration);
  section.findings = findings(cases, outcomes, ripple);
  section.findings[5].difference += fmt::format("; below {:.2f} m/s the bare handle always comes to rest", critical);
  section.pictures = {
      {"oscillation",
       "A lever thrown at the paper's wall, and what the paper names against its bouncing; last, ours. Dashed: "
       "the walls. The scales differ."},
      {"oscillation_rates", "The same against the rate: from which on each cure suffices."}};
  return section;
}

}  // namespace gearshift
