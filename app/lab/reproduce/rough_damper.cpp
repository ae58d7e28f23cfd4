#include "app/lab/reproduce/rough_damper.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "app/lab/reproduce/element_trial.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/virtual_element.h"

namespace gearshift::lab {
namespace {

struct Roughness {
  double speed = 0.0;         // [m/s] largest
  double acceleration = 0.0;  // [m/s^2] largest
  double peak = 0.0;          // [N] largest force
  double step = 0.0;          // [N] largest change of the force from one period to the next
  std::vector<ElementHold> curve;
};

struct Stroke {
  double half, duration;  // [m], [s]
};
constexpr Stroke kSlowStroke{0.015, 0.8}, kFastStroke{0.045, 0.12};

Roughness roughness(const Study& study, double rate, const haptics::AxisModel& element, Stroke stroke,
                    double loop_damping) {
  Trial trial = free_trial(study, rate);
  trial.haptics.tuning.aisle_damping = loop_damping;
  trial.start = {-stroke.half, 0.0};
  VirtualElement load(element, {}, trial.start, {});
  haptics::HandStroke stroke_across;
  stroke_across.to = {stroke.half, 0.0};
  stroke_across.duration = stroke.duration;
  stroke_across.dwell = 0.5 * stroke.duration;
  Roughness rough;
  rough.curve = holds_of(run_with_hand(trial, {stroke_across}, &load), 0);
  for (std::size_t i = 1; i < rough.curve.size(); ++i) {
    const ElementHold& hold = rough.curve[i];
    rough.speed = std::max(rough.speed, std::abs(hold.actual.y));
    rough.acceleration = std::max(rough.acceleration, std::abs(hold.actual.z));
    rough.peak = std::max(rough.peak, std::abs(hold.force));
    rough.step = std::max(rough.step, std::abs(hold.force - rough.curve[i - 1].force));
  }
  return rough;
}

void add_curve(TrialTable& table, const std::string& tag, const Roughness& rough, double damping) {
  std::vector<double> time, force, ideal;
  for (const ElementHold& hold : rough.curve) {
    time.push_back(1e3 * hold.time);
    force.push_back(hold.force);
    ideal.push_back(damping * hold.actual.y);
  }
  table.add(tag + "_time_ms", std::move(time));
  table.add(tag + "_force_n", std::move(force));
  table.add(tag + "_ideal_n", std::move(ideal));
}

std::string damper_panel(const char* title, const char* tag, double rate, const std::string& ranges) {
  const bool filtered = rate != kPaperRate;
  std::string curves = fmt::format(
      "plot \"rough_damper.csv\" using \"{0}_time_ms\":\"{0}_force_n\" with steps linewidth 1.3 linecolor \"{1}\" "
      "title \"{2:g} Hz, velocity "
      "from two samples\"",
      tag, rate == kPaperRate ? base::kLockoutColour : base::kGearColour, rate);
  if (filtered)
    curves += fmt::format(
        ", \"\" using \"{0}_filtered_time_ms\":\"{0}_filtered_force_n\" with steps linewidth 1.3 "
        "linecolor \"{1}\" title \"filtered damping of the loop\"",
        tag, base::kBufferColour);
  curves += fmt::format(
      ", \"\" using \"{0}_time_ms\":\"{0}_ideal_n\" with lines dashtype 2 linecolor \"{1}\" title \"ideal: B v\"\n",
      tag, base::kInk);
  return fmt::format("set title \"{}\"\n{}{}", title, ranges, curves);
}

// Results for the emulated damper at 100 Hz and at the preset's rate, for the loop's filtered damping, and for a
// spring. `slow` and `fast` are the two hand movements.
struct RoughRuns {
  double rate = 0.0, damping = 0.0, stiffness = 0.0;  // [Hz] preset's rate, [N s/m] of the damper, [N/m] of the spring
  Roughness slow, fast;                               // at 100 Hz
  Roughness slow_preset, fast_preset, slow_filtered, fast_filtered;
  Roughness spring_run;  // the spring with the fast movement at 100 Hz
};

RoughRuns rough_runs(const Study& study) {
  const haptics::AxisModel& handle = study.preset.lever.axis_x;
  RoughRuns runs;
  runs.rate = study.preset.haptics.rate;
  runs.damping = kElementFraction * handle.damping;
  runs.stiffness = kElementFraction * element_limits(handle, 1.0 / kPaperRate).spring;
  const haptics::AxisModel damper{0.0, runs.damping, 0.0}, spring{0.0, 0.0, runs.stiffness}, nothing{};
  runs.slow = roughness(study, kPaperRate, damper, kSlowStroke, 0.0);
  runs.fast = roughness(study, kPaperRate, damper, kFastStroke, 0.0);
  runs.slow_preset = roughness(study, runs.rate, damper, kSlowStroke, 0.0);
  runs.fast_preset = roughness(study, runs.rate, damper, kFastStroke, 0.0);
  runs.slow_filtered = roughness(study, runs.rate, nothing, kSlowStroke, runs.damping);
  runs.fast_filtered = roughness(study, runs.rate, nothing, kFastStroke, runs.damping);
  runs.spring_run = roughness(study, kPaperRate, spring, kFastStroke, 0.0);
  return runs;
}

void write_runs(const Study& study, const RoughRuns& runs) {
  TrialTable table;
  add_curve(table, "slow_100hz", runs.slow, runs.damping);
  add_curve(table, "fast_100hz", runs.fast, runs.damping);
  add_curve(table, "slow_preset", runs.slow_preset, runs.damping);
  add_curve(table, "fast_preset", runs.fast_preset, runs.damping);
  add_curve(table, "slow_preset_filtered", runs.slow_filtered, runs.damping);
  add_curve(table, "fast_preset_filtered", runs.fast_filtered, runs.damping);
  table.write(study, "rough_damper");
}

void draw_runs(const Study& study, const RoughRuns& runs) {
  const std::string full_range = "set xrange [*:*]\nset yrange [*:*]\n";
  const std::string slow_part =
      fmt::format("set xrange [300:500]\nset yrange [{}:{}]\n", -0.3 * runs.slow.peak, 1.15 * runs.slow.peak);
  draw(study, {"rough_damper", 1100, 780,
               fmt::format(
                   "set multiplot layout 2,2 margins 0.07, 0.98, 0.08, 0.95 spacing 0.08, 0.13\nset key bottom center\n"
                   "set xlabel \"time [ms]\"\nset ylabel \"force against the hand [N]\"\n"
                   "set offsets 0, 0, graph 0.05, graph 0.25\n{}{}{}{}unset multiplot\n",
                   damper_panel("slow, 100 Hz", "slow_100hz", kPaperRate, slow_part),
                   damper_panel("fast, 100 Hz", "fast_100hz", kPaperRate, full_range),
                   damper_panel("slow, the preset's rate", "slow_preset", runs.rate, slow_part),
                   damper_panel("fast, the preset's rate", "fast_preset", runs.rate, full_range))});
}

Finding rough_finding(const RoughRuns& runs, double count) {
  const auto steps = [&](const Roughness& rough, double at) {
    return fmt::format("{:.2g} N of {:.2g} N at {:.2g} m/s (B a T = {:.2g} N; one count, B q/T = {:.2g} N)", rough.step,
                       rough.peak, rough.speed, runs.damping * rough.acceleration / at, runs.damping * count * at);
  };
  return {"Section 3: \"unsmooth motions ... in damper emulation when the joystick moved with high velocities\"",
          fmt::format("largest force step with {:.3g} N s/m at 100 Hz: {} when slow, {} when fast", runs.damping,
                      steps(runs.slow, kPaperRate), steps(runs.fast, kPaperRate)),
          fmt::format("{:.0f} times rougher when fast; at {:g} Hz: {} and {}; with the filtered damping of the loop: "
                      "{:.2g} and {:.2g} N",
                      runs.fast.step / runs.slow.step, runs.rate, steps(runs.slow_preset, runs.rate),
                      steps(runs.fast_preset, runs.rate), runs.slow_filtered.step, runs.fast_filtered.step)};
}

Finding spring_finding(const RoughRuns& runs, double count) {
  const Roughness &spring_run = runs.spring_run, &fast = runs.fast;
  return {"Section 3: \"force generation in spring emulation was much smoother\"",
          fmt::format(
              "a spring of {:.3g} N/m on the same fast stroke at 100 Hz: largest step {:.2g} N of {:.2g} N, {:.0f} %; "
              "damper: {:.0f} %",
              runs.stiffness, spring_run.step, spring_run.peak, 100.0 * spring_run.step / spring_run.peak,
              100.0 * fast.step / fast.peak),
          fmt::format("not confirmed; both forces are held for one period T of the loop, so each step is about omega T "
                      "times the peak (omega: the stroke's angular frequency). One encoder count changes the spring's "
                      "force by {:.2g} N and the damper's by {:.2g} N",
                      runs.stiffness * count, runs.damping * count * kPaperRate)};
}

}  // namespace

void add_rough_damper(const Study& study, Section& section) {
  report_progress(study, "elements: damper");
  const RoughRuns runs = rough_runs(study);
  write_runs(study, runs);
  draw_runs(study, runs);
  section.findings.push_back(rough_finding(runs, study.device.position_step));
  section.findings.push_back(spring_finding(runs, study.device.position_step));
  section.pictures.push_back(
      {"rough_damper",
       "An emulated damper. At 100 Hz its force is a staircase when the lever is fast, because the velocity changes "
       "considerably within a period; at the preset's rate only the encoder counts are visible."});
}

}  // namespace gearshift::lab
