#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/trial.h"
#include "haptics/device/scripted_hand.h"

namespace gearshift::lab {
namespace {

constexpr double kAimBefore = -0.020, kAimBehind = 0.030;  // [m] targets of the hand before and behind the wall (at 0)
constexpr double kStroke = 0.35, kRest = 0.20;             // [s]
constexpr double kFirstPart = 0.005;                       // [s] window of the rate-hardness

// A gripping hand pushes into the wall, rests there and pulls out again, as in the paper's Fig. 8.
TrialRun push_and_pull(const Study& study) {
  const std::vector<haptics::HandStroke> strokes{{{kAimBehind, 0.0}, kStroke, kRest},
                                                 {{kAimBefore, 0.0}, kStroke, kRest}};
  haptics::ScriptedHandConfig config;
  config.start = {kAimBefore, 0.0};
  haptics::ScriptedHand hand(config, strokes, haptics::period_s(study.preset.haptics));
  Trial trial;
  trial.haptics = study.preset.haptics;
  trial.lever = study.preset.lever;
  trial.lever.hand = haptics::kGripHand;
  trial.gate = wall_at_zero();
  trial.start = config.start;
  trial.hand = [&hand](double time, glm::dvec2 lever) { return hand.next(time, lever); };
  trial.duration = hand.duration();
  return run_trial(trial);
}

// Relation between the wall's measured force and the true penetration.
struct Reflection {
  double stiffness = 0.0;    // [N/m] slope
  double correlation = 0.0;  // [1]
  double residual = 0.0;     // [N] root mean square of force minus K x, for the wanted stiffness K and the depth x
  double peak = 0.0;         // [N]
  double depth = 0.0;        // [m] deepest
};

Reflection reflect(const TrialRun& run, double wanted) {
  std::vector<double> x, f;
  for (const TrialSample& sample : run.samples) {
    if (sample.position.x <= 0.0) continue;
    x.push_back(sample.position.x);
    f.push_back(sample.hand.x);
  }
  if (x.empty()) return {};
  const auto n = static_cast<double>(x.size());
  const double mx = std::reduce(x.begin(), x.end()) / n, mf = std::reduce(f.begin(), f.end()) / n;
  double xx = 0.0, xf = 0.0, ff = 0.0, residual_squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xf += (x[i] - mx) * (f[i] - mf);
    ff += (f[i] - mf) * (f[i] - mf);
    residual_squares += (f[i] - wanted * x[i]) * (f[i] - wanted * x[i]);
  }
  return {xf / xx, xf / std::sqrt(xx * ff), std::sqrt(residual_squares / n), *std::max_element(f.begin(), f.end()),
          *std::max_element(x.begin(), x.end())};
}

// Rate-hardness: fastest rise of the motor force within kFirstPart, over the impact speed, as in contact_rig.h. [N/m]
double rate_hardness(const TrialRun& run, const TrialContact& contact) {
  const auto ahead = static_cast<std::size_t>(std::lround(kFirstPart / run.period));
  double rise = 0.0;
  for (std::size_t i = 0; i + ahead < run.samples.size(); ++i) {
    const TrialSample &from = run.samples[i], &to = run.samples[i + ahead];
    if (from.time >= contact.begin - kFirstPart && from.time <= contact.begin + kFirstPart)
      rise = std::max(rise, (from.motor.x - to.motor.x) / kFirstPart);
  }
  return rise / contact.speed;
}

void draw_wall(const Study& study, const TrialRun& run) {
  TrialTable table;
  table.add("time_s", run, [](const TrialSample& sample) { return sample.time; });
  table.add("position_mm", run, [](const TrialSample& sample) { return 1e3 * sample.position.x; });
  table.add("sensor_force_n", run, [](const TrialSample& sample) { return sample.hand.x; });
  table.add("motor_force_n", run, [](const TrialSample& sample) { return -sample.motor.x; });
  table.add("drawn_lever_mm", run, [](const TrialSample& sample) { return 1e3 * sample.proxy.x; });
  table.write(study, "wall");
  draw(study, {"wall", 900, 640,
               fmt::format(R"gp(set multiplot layout 2,1 margins 0.09, 0.97, 0.09, 0.96 spacing 0.06
set key top right
set format x ""
set ylabel "position [mm]"
set offsets 0, 0, graph 0.15, graph 0.05
plot 0 with lines linecolor "{soft}" dashtype 2 title "the wall", \
  "wall.csv" using "time_s":"drawn_lever_mm" with lines linewidth 1.5 linecolor "{blue}" title "displayed lever", \
  "" using "time_s":"position_mm" with lines linewidth 1.5 linecolor "{red}" title "real lever"
set format x "%g"
set xlabel "time [s]"
set ylabel "force [N]"
plot "wall.csv" using "time_s":"motor_force_n" with lines linewidth 1.2 linecolor "{blue}" title "motors", \
  "" using "time_s":"sensor_force_n" \
    with lines linewidth 1.5 linecolor "{red}" title "hand, measured by the force sensor"
unset multiplot
)gp",
                           fmt::arg("soft", base::kSoftInk), fmt::arg("blue", base::kGearColour),
                           fmt::arg("red", base::kLockoutColour))});
}

}  // namespace

Section wall_section(const Study& study) {
  report_progress(study, "wall");
  const TrialRun run = push_and_pull(study);
  const double wanted = run.admitted.tuning.wall_stiffness;
  const Reflection reflection = reflect(run, wanted);
  draw_wall(study, run);

  Section section{"wall", "Fig. 8: pushing into a virtual wall and pulling out", "", {}, {}};
  section.text = fmt::format(
      "A gripping hand ({:g} kg, {:g} N s/m, {:g} N/m) aims from {:g} mm in front of the wall to {:g} mm behind it and "
      "back, at {:g} Hz with the preset's wall of {:g} N/m and {:g} N s/m. The force is measured by the paper's sensor "
      "in steps of {:.2f} N.",
      haptics::kGripHand.mass, haptics::kGripHand.damping, haptics::kGripHand.stiffness, -1e3 * kAimBefore,
      1e3 * kAimBehind, study.preset.haptics.rate, wanted, run.admitted.tuning.wall_damping,
      study.preset.lever.force_sensor.resolution_gw * haptics::kNewtonPerGramWeight);
  section.findings = {
      {"Section 3.1: \"we set the stiffness to be around 5000 N/m\"",
       fmt::format("{:.0f} N/m (slope of the sensor's force against the true penetration)", reflection.stiffness),
       relative(reflection.stiffness, 5000.0)},
      {"Section 4: \"the force response did reflect the penetration of the joystick into the wall\"",
       fmt::format("correlation {:.4f}; root mean square of force minus K x: {:.2f} N; peak {:.1f} N; {:.2f} mm deep",
                   reflection.correlation, reflection.residual, reflection.peak, 1e3 * reflection.depth),
       fmt::format("{:.1f} % of the peak", 100.0 * reflection.residual / reflection.peak)}};
  const std::vector<TrialContact> all_contacts = contacts(run, wall_at_zero());
  if (!all_contacts.empty()) {
    const double hardness = rate_hardness(run, all_contacts.front());
    section.findings.push_back(
        {"Section 4: \"a feeling of contacting with a stiff wall\"",
         fmt::format("rate-hardness {:.0f} N/m; the motors' force rises by {:.0f} N/s after a contact at {:.2f} m/s; "
                     "{} contact{}; the wall added {:+.2f} mJ to the lever's energy in total",
                     hardness, hardness * all_contacts.front().speed, all_contacts.front().speed, all_contacts.size(),
                     all_contacts.size() == 1 ? "" : "s",
                     1e3 * std::accumulate(all_contacts.begin(), all_contacts.end(), 0.0,
                                           [](double sum, const TrialContact& one) { return sum + one.energy; })),
         fmt::format("{:.2f} of the stiffness", hardness / wanted)});
  }
  section.pictures = {{"wall",
                       "As in Fig. 8, positions in free space are negative. The displayed lever stays at the wall "
                       "while the real lever is "
                       "inside the wall; the measured force follows the penetration."}};
  return section;
}

}  // namespace gearshift::lab
