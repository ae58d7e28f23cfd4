#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/trial.h"

namespace gearshift::lab {
namespace {

constexpr double kStrongest = 120.0, kRampTime = 4.0;  // [N] twice the paper's push; [s] duration of the ramp up to it
constexpr double kPaperPush = 60.0;                    // [N] section 3.1
constexpr double kStepTime = 1.0;                      // [s]

double ramp_push(double time) {
  return kStrongest * time / kRampTime;
}

// A hand pushes into the wall with a given force, and its spring pulls towards the wall's surface. If `overheated`, the
// motors deliver only their continuous force.
TrialRun push(const Study& study, const haptics::HandImpedance& hand, double (*force)(double), double duration,
              bool overheated) {
  Trial trial;
  trial.haptics = study.preset.haptics;
  trial.lever = study.preset.lever;
  trial.lever.hand = hand;
  if (overheated) trial.lever.actuator.peak_force = trial.lever.actuator.continuous_force;
  trial.gate = wall_at_zero();
  trial.hand = [force](double time, glm::dvec2) {
    haptics::HandTarget target;
    target.push = {force(time), 0.0};
    return target;
  };
  trial.duration = duration;
  return run_trial(trial);
}

double step_push(double) {
  return kPaperPush;
}

const TrialSample* first_with(const TrialRun& run, std::uint32_t flag) {
  for (const TrialSample& sample : run.samples) {
    if ((sample.flags & flag) != 0) return &sample;
  }
  return nullptr;
}

std::string describe_moment(const TrialSample* sample) {
  if (!sample) return "never";
  return fmt::format("after {:.2f} s, at a push of {:.1f} N, a sensor reading of {:.1f} N and a depth of {:.1f} mm",
                     sample->time, ramp_push(sample->time), sample->hand.x, 1e3 * sample->position.x);
}

// Largest distance of the displayed lever (proxy) beyond the wall. [m]
double drawn_outside(const TrialRun& run) {
  double max_distance = 0.0;
  for (const TrialSample& sample : run.samples) max_distance = std::max(max_distance, sample.proxy.x);
  return max_distance;
}

void draw_ramps(const Study& study, const TrialRun& bare, const TrialRun& grip) {
  TrialTable table;
  table.add("time_s", bare, [](const TrialSample& sample) { return sample.time; });
  table.add("push_n", bare, [](const TrialSample& sample) { return ramp_push(sample.time); });
  for (const TrialRun* run : {&bare, &grip}) {
    const std::string tag = run == &bare ? "bare" : "grip";
    table.add(tag + "_depth_mm", *run, [](const TrialSample& sample) { return 1e3 * sample.position.x; });
    table.add(tag + "_drawn_mm", *run, [](const TrialSample& sample) { return 1e3 * sample.proxy.x; });
    table.add(tag + "_sensor_n", *run, [](const TrialSample& sample) { return sample.hand.x; });
    table.add(tag + "_motor_n", *run, [](const TrialSample& sample) { return -sample.motor.x; });
  }
  table.write(study, "over_push");
  draw(study,
       {"over_push", 1100, 480,
        fmt::format(R"gp(set multiplot layout 1,2 margins 0.07, 0.98, 0.13, 0.95 spacing 0.1
set xlabel "push of the hand [N]"
set ylabel "depth in the wall [mm]"
set yrange [-3:100]
set key top left
plot {ghost} with lines dashtype 2 linecolor "{soft}" title "beyond this, the real hand is shown", \
  "over_push.csv" using "push_n":"bare_depth_mm" \
    with lines linewidth 1.5 linecolor "{orange}" title "push without hand impedance", \
  "" using "push_n":"grip_depth_mm" with lines linewidth 1.5 linecolor "{red}" title "gripping hand", \
  "" using "push_n":"grip_drawn_mm" with lines linewidth 1.5 linecolor "{blue}" title "displayed lever (proxy)"
set ylabel "force [N]"
set yrange [-5:150]
plot {warn} with lines dashtype 2 linecolor "{soft}" title "the warning's threshold", \
  "over_push.csv" using "push_n":"bare_sensor_n" \
    with lines linewidth 1.5 linecolor "{orange}" title "sensor, without impedance", \
  "" using "push_n":"grip_sensor_n" with lines linewidth 1.5 linecolor "{red}" title "sensor, gripping hand", \
  "" using "push_n":"grip_motor_n" with lines linewidth 1.5 linecolor "{blue}" title "motors, gripping hand"
unset multiplot
)gp",
                    fmt::arg("ghost", 1e3 * study.preset.haptics.ghost_offset), fmt::arg("soft", base::kSoftInk),
                    fmt::arg("orange", base::kBufferColour), fmt::arg("red", base::kLockoutColour),
                    fmt::arg("blue", base::kGearColour), fmt::arg("warn", study.preset.haptics.over_push.warn_above))});
}

void draw_steps(const Study& study, const TrialRun& peak, const TrialRun& overheated, const TrialRun& bare) {
  TrialTable table;
  const auto depth = [](const TrialSample& sample) { return 1e3 * sample.position.x; };
  table.add("time_s", peak, [](const TrialSample& sample) { return sample.time; });
  table.add("grip_peak_mm", peak, depth);
  table.add("grip_continuous_mm", overheated, depth);
  table.add("bare_peak_mm", bare, depth);
  table.write(study, "over_push_step");
  draw(study,
       {"over_push_step", 900, 440,
        fmt::format(R"gp(set xlabel "time [s]"
set ylabel "depth in the wall [mm]"
set yrange [-3:100]
set key outside right top
plot "over_push_step.csv" using "time_s":"bare_peak_mm" \
    with lines linewidth 1.5 linecolor "{orange}" title "without impedance, {peak:g} N", \
  "" using "time_s":"grip_continuous_mm" \
    with lines linewidth 1.5 linecolor "{red}" title "grip, motors at {rest:g} N", \
  "" using "time_s":"grip_peak_mm" with lines linewidth 1.5 linecolor "{blue}" title "grip, motors at {peak:g} N"
)gp",
                    fmt::arg("orange", base::kBufferColour), fmt::arg("red", base::kLockoutColour),
                    fmt::arg("blue", base::kGearColour), fmt::arg("peak", study.preset.lever.actuator.peak_force),
                    fmt::arg("rest", study.preset.lever.actuator.continuous_force))});
}

void add_ramp_findings(const Study& study, const TrialRun& bare, const TrialRun& grip, Section& section) {
  const haptics::SimulatedLeverConfig& lever = study.preset.lever;
  const double stiffness = grip.admitted.tuning.wall_stiffness, depth = lever.actuator.peak_force / stiffness;
  const TrialSample* saturated = first_with(grip, haptics::kFlagSaturated);
  section.findings.push_back(
      {"Section 2.2: the motors give 3.8 N m, which is 31.7 N at 0.12 m, so with a wall of 5000 N/m they saturate at a "
       "depth of 6.3 mm",
       fmt::format("saturation without hand impedance {}; with a grip {}",
                   describe_moment(first_with(bare, haptics::kFlagSaturated)), describe_moment(saturated)),
       fmt::format("{:.1f} N divided by {:g} N/m is {:.2f} mm{}", lever.actuator.peak_force, stiffness, 1e3 * depth,
                   saturated ? fmt::format(", measured {} with a grip", relative(saturated->position.x, depth)) : "")});
  section.findings.push_back(
      {"Section 3.1: \"the system will send out a sound warning when a very large pushing force occurs\", above 60 N",
       fmt::format("warning from a measured {:g} N: without hand impedance {}; with a grip {}",
                   study.preset.haptics.over_push.warn_above, describe_moment(first_with(bare, haptics::kFlagOverPush)),
                   describe_moment(first_with(grip, haptics::kFlagOverPush))),
       "once the wall gives way, a gripping hand is held back by its own spring, so the sensor reads 60 N only at the "
       "stop; therefore saturation triggers the warning, too"});
  section.findings.push_back(
      {"Section 3.1: \"retain the image of the joystick within the aisle\"",
       fmt::format("the displayed lever is at most {:.3g} mm outside the aisle; the real hand is shown from a depth of "
                   "{:g} mm: without hand impedance {}; with a grip {}",
                   1e3 * std::max(drawn_outside(bare), drawn_outside(grip)), 1e3 * study.preset.haptics.ghost_offset,
                   describe_moment(first_with(bare, haptics::kFlagGhost)),
                   describe_moment(first_with(grip, haptics::kFlagGhost))),
       "the paper calls this \"useful, when the real and virtual feeling were not that much different\", but gives no "
       "distance"});
}

void add_step_finding(const Study& study, const TrialRun& peak, const TrialRun& overheated, const TrialRun& bare,
                      Section& section) {
  const haptics::SimulatedLeverConfig& lever = study.preset.lever;
  const double stop = lever.yoke.radius * std::sin(lever.yoke.theta_limit);
  section.findings.push_back(
      {"Section 3.1: a push \"up to more than 60 N ... may bend the joystick and make the virtual wall collapse\"",
       fmt::format(
           "sudden push of {:g} N: {:.0f} mm deep with a grip and {:g} N from the motors, {:.0f} mm with a grip "
           "and {:g} N, {:.0f} mm without hand impedance; the stop is at {:.0f} mm",
           kPaperPush, 1e3 * deepest(peak), lever.actuator.peak_force, 1e3 * deepest(overheated),
           lever.actuator.continuous_force, 1e3 * deepest(bare), 1e3 * stop),
       fmt::format("the wall can resist {:.0f} % of this push with the peak force and {:.0f} % continuously",
                   100.0 * lever.actuator.peak_force / kPaperPush,
                   100.0 * lever.actuator.continuous_force / kPaperPush)});
}

}  // namespace

Section over_push_section(const Study& study) {
  report_progress(study, "over-push");
  const TrialRun bare = push(study, haptics::kBareHand, ramp_push, kRampTime, false);
  const TrialRun grip = push(study, haptics::kGripHand, ramp_push, kRampTime, false);
  const TrialRun peak = push(study, haptics::kGripHand, step_push, kStepTime, false);
  const TrialRun overheated = push(study, haptics::kGripHand, step_push, kStepTime, true);
  const TrialRun thrown = push(study, haptics::kBareHand, step_push, kStepTime, false);
  draw_ramps(study, bare, grip);
  draw_steps(study, peak, overheated, thrown);

  Section section{"over_push", "Section 3.1: a push above 60 N", "", {}, {}};
  section.text = fmt::format(
      "A push against the preset's wall grows from 0 to {:g} N in {:g} s, once without hand impedance and once "
      "with "
      "a gripping hand whose spring ({:g} N/m) holds it at the wall. A sudden push of {:g} N follows. Lever, loop and "
      "warning are the preset's.",
      kStrongest, kRampTime, haptics::kGripHand.stiffness, kPaperPush);
  add_ramp_findings(study, bare, grip, section);
  add_step_finding(study, peak, overheated, thrown, section);
  section.pictures = {
      {"over_push",
       "Depth and forces against the push: the wall holds until the motors saturate; the displayed lever stays in the "
       "aisle."},
      {"over_push_step", "A sudden push of 60 N: how far the wall gives way, for two limits of the motors' force."}};
  return section;
}

}  // namespace gearshift::lab
