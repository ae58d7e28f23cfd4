#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "app/draw/gate_colours.h"
#include "app/reproduce/section.h"
#include "app/reproduce/study_files.h"
#include "app/reproduce/trial.h"
#include "app/reproduce/virtual_element.h"
#include "haptics/analysis/passivity.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/gate/plain_aisle.h"

namespace gearshift {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kPaperRate = 100.0;  // [Hz] section 3: "the maximum updating frequency of the system at 100 Hz"
constexpr double kShare = 0.8;        // of what (14), (16), (18), (20) admit
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr const char* kRed = kLockoutColour;
constexpr const char* kBlue = kGearColour;

// [m] of the encoder at the tip
double encoder_step(const Study& study) {
  const SimulatedLeverConfig& lever = study.preset.lever;
  return lever.encoder_counts > 0.0 ? lever.yoke.radius * kDegree / lever.encoder_counts : 0.0;
}

// ---- limits ----

double passive_limit(double damping, const AxisModel& unit, double period) {
  return damping / damping_demand(impedance(unit.stiffness, unit.damping, unit.mass, period), period);
}

struct Limits {
  double spring, damper, mass;  // [N/m], [N s/m], [kg]: each alone
};

Limits limits_of(const AxisModel& handle, double period) {
  const double b = handle.damping;
  return {passive_limit(b, {0.0, 0.0, 1.0}, period), passive_limit(b, {0.0, 1.0, 0.0}, period),
          passive_limit(b, {1.0, 0.0, 0.0}, period)};
}

Finding limit_row(const char* paper, double ours_x, double ours_y, double paper_x, double paper_y, const char* unit,
                  const std::string& why) {
  return {paper, fmt::format("{:.4g} and {:.4g} {}", ours_x, ours_y, unit),
          fmt::format("{} and {}{}", relative(ours_x, paper_x), relative(ours_y, paper_y), why)};
}

void add_limits(const Study& study, Section& section) {
  const AxisModel &x = study.preset.lever.axis_x, &y = study.preset.lever.axis_y;
  const Limits lx = limits_of(x, 1.0 / kPaperRate), ly = limits_of(y, 1.0 / kPaperRate);
  const std::string why = fmt::format(": 605 and 566 are those of b = {:.3f} and {:.2f}, the device's is {:g} and {:g}",
                                      605.0 / (2.0 * kPaperRate), 566.0 / (2.0 * kPaperRate), x.damping, y.damping);
  section.findings.push_back(
      limit_row("(14): K < 605 and 566 N/m in X and Y at 100 Hz", lx.spring, ly.spring, 605.0, 566.0, "N/m", why));
  section.findings.push_back(limit_row("(16): B < 3.0 and 2.9 N s/m", lx.damper, ly.damper, 3.0, 2.9, "N s/m", ""));
  section.findings.push_back(limit_row("(18): M < 0.015 and 0.014 kg", lx.mass, ly.mass, 0.015, 0.014, "kg",
                                       fmt::format(": 2.9 T/2 = {:g} is printed as 0.014", 2.9 / (2.0 * kPaperRate))));
  section.findings.push_back({"(21): K + 200 B + 200^2 M < 605 and 566",
                              fmt::format("K + {:.4g} B + {:.5g} M < {:.4g} and {:.4g}", lx.spring / lx.damper,
                                          lx.spring / lx.mass, lx.spring, ly.spring),
                              "the same as (14)"});
}

// ---- emulation ----

struct Emulation {
  const char* name;
  double spring, damper, mass;  // [1] share of the limit of each
};
// The shares of one add up to kShare: (20).
constexpr std::array<Emulation, 4> kEmulations{{{"spring", kShare, 0.0, 0.0},
                                                {"damper", 0.0, kShare, 0.0},
                                                {"mass", 0.0, 0.0, kShare},
                                                {"impedance", 0.3, 0.3, 0.2}}};

// Spring and damper are those of 100 Hz at every rate, to be compared; (18) leaves a faster loop less mass.
AxisModel element_of(const Emulation& emulation, const AxisModel& handle, double rate) {
  const Limits slow = limits_of(handle, 1.0 / kPaperRate), own = limits_of(handle, 1.0 / rate);
  return {emulation.mass * std::min(slow.mass, own.mass), emulation.damper * slow.damper,
          emulation.spring * slow.spring};
}

// The element alone: no wall near, no feel, no damping of the loop's own.
Trial open_trial(const Study& study, double rate) {
  Trial trial;
  trial.haptics = study.preset.haptics;
  trial.haptics.rate = rate;
  trial.haptics.tuning.aisle_damping = 0.0;
  trial.haptics.tuning.limit_damping = 0.0;
  trial.lever = study.preset.lever;
  trial.gate = plain_aisle(0.5, 0.5);
  return trial;
}

// Leads the lever by a gripping hand.
TrialRun led_run(Trial trial, const std::vector<HandStroke>& strokes, LeverWorld* world) {
  ScriptedHandConfig config;
  config.start = trial.start;
  ScriptedHand hand(config, strokes, period_s(trial.haptics));
  trial.hand = [&hand](double time, dvec2 lever) { return hand.next(time, lever); };
  trial.lever.hand = kGripHand;
  trial.world = world;
  trial.duration = hand.duration();
  return run_trial(trial);
}

std::vector<HandStroke> strokes_through(std::span<const dvec2> points) {
  std::vector<HandStroke> strokes;
  for (const dvec2 point : points) {
    HandStroke stroke;
    stroke.to = 0.045 * point;
    stroke.duration = strokes.size() % 2 == 0 ? 0.20 : 0.35;
    stroke.dwell = 0.0;
    strokes.push_back(stroke);
  }
  return strokes;
}

constexpr std::array<dvec2, 5> kAlongX{{{1, 0}, {-1, 0}, {1, 0}, {-1, 0}, {0, 0}}};
constexpr std::array<dvec2, 5> kAlongY{{{0, 1}, {0, -1}, {0, 1}, {0, -1}, {0, 0}}};
constexpr std::array<dvec2, 6> kBothAxes{{{0.6, 0.6}, {-0.6, 0.6}, {-0.6, -0.6}, {0.6, -0.6}, {0.6, 0.6}, {0, 0}}};

// One hold: the force against the hand, and the true motion. [m], [m/s], [m/s^2]
struct Hold {
  double time, force;
  dvec3 seen;  // that (19) makes of samples: half a period and a whole one old
  dvec3 felt;  // in the middle of the hold
};

std::vector<Hold> holds_of(const TrialRun& run, int axis) {
  std::vector<Hold> holds;
  const double period = run.period;
  for (std::size_t i = 2; i + 1 < run.samples.size(); ++i) {
    const TrialSample &begin = run.samples[i], &end = run.samples[i + 1];
    const double x0 = begin.position[axis], x1 = end.position[axis];
    const double last = run.samples[i - 1].position[axis], first = run.samples[i - 2].position[axis];
    const dvec3 seen{x0, (x0 - last) / period, (x0 - 2.0 * last + first) / (period * period)};
    const dvec3 felt{0.5 * (x0 + x1), (x1 - x0) / period, (end.velocity[axis] - begin.velocity[axis]) / period};
    holds.push_back({begin.time, -end.motor[axis], seen, felt});
  }
  return holds;
}

// F = K x + B v + M a of the true motion, by least squares.
dvec3 fit(const std::vector<Hold>& holds, dvec3 Hold::*motion) {
  glm::dmat3 normal(0.0);
  dvec3 projected(0.0);
  for (const Hold& hold : holds) {
    normal += glm::outerProduct(hold.*motion, hold.*motion);
    projected += hold.force * (hold.*motion);
  }
  return glm::inverse(normal) * projected;
}

// What was emulated and what came of it, as (K, B, M).
struct Emulated {
  dvec3 x, y;               // wanted
  dvec3 alone_x, alone_y;   // on one axis, of the motion seen
  dvec3 both_x, both_y;     // on both together
  dvec3 felt;               // on X alone, of the motion felt
  std::vector<Hold> curve;  // of X alone
};

dvec3 vector_of(const AxisModel& model) {
  return {model.stiffness, model.damping, model.mass};
}

Emulated emulate(const Study& study, const Emulation& emulation, double rate) {
  const Trial trial = open_trial(study, rate);
  const AxisModel x = element_of(emulation, trial.lever.axis_x, rate);
  const AxisModel y = element_of(emulation, trial.lever.axis_y, rate);
  VirtualElement only_x(x, {}, dvec2(0.0), {}), only_y({}, y, dvec2(0.0), {}), both(x, y, dvec2(0.0), {});
  Emulated out;
  out.x = vector_of(x);
  out.y = vector_of(y);
  out.curve = holds_of(led_run(trial, strokes_through(kAlongX), &only_x), 0);
  out.alone_x = fit(out.curve, &Hold::seen);
  out.felt = fit(out.curve, &Hold::felt);
  out.alone_y = fit(holds_of(led_run(trial, strokes_through(kAlongY), &only_y), 1), &Hold::seen);
  const TrialRun together = led_run(trial, strokes_through(kBothAxes), &both);
  out.both_x = fit(holds_of(together, 0), &Hold::seen);
  out.both_y = fit(holds_of(together, 1), &Hold::seen);
  return out;
}

using EmulatedPair = std::array<Emulated, 2>;  // at 100 Hz and at the preset's rate

constexpr std::array<const char*, 3> kNumber{"K", "B", "M"};
constexpr std::array<const char*, 3> kUnit{"N/m", "N s/m", "kg"};

// "K 480 N/m, B 2.4 N s/m": those that were wanted.
std::string values(dvec3 kbm, dvec3 wanted) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (wanted[i] == 0.0) continue;
    text += fmt::format("{}{} {:.4g} {}", text.empty() ? "" : ", ", kNumber[k], kbm[i], kUnit[k]);
  }
  return text;
}

// [%] the largest of all that were measured of one number.
double deviation(const Emulated& emulated, int i) {
  const double x = emulated.x[i], y = emulated.y[i];
  double most = 0.0;
  for (const double ratio :
       {emulated.alone_x[i] / x, emulated.both_x[i] / x, emulated.alone_y[i] / y, emulated.both_y[i] / y})
    most = std::max(most, 100.0 * std::abs(ratio - 1.0));
  return most;
}

// "K 0.03 %, B 0.4 %"
std::string deviations(const Emulated& emulated) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    if (emulated.x[i] == 0.0) continue;
    text += fmt::format("{}{} {:.2g} %", text.empty() ? "" : ", ", kNumber[static_cast<std::size_t>(i)],
                        deviation(emulated, i));
  }
  return text;
}

void write_fits(const Study& study, const std::array<EmulatedPair, 4>& all) {
  CsvFile csv(study, "element_fits",
              "element,rate_hz,axes,k_wanted_n_per_m,k_n_per_m,b_wanted_n_s_per_m,b_n_s_per_m,m_wanted_kg,m_kg");
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t rate = 0; rate < 2; ++rate) {
      const Emulated& emulated = all[i][rate];
      const auto row = [&](const char* axes, dvec3 wanted, dvec3 found) {
        csv.line(fmt::format("{},{:g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", kEmulations[i].name,
                             rate == 0 ? kPaperRate : study.preset.haptics.rate, axes, wanted.x, found.x, wanted.y,
                             found.y, wanted.z, found.z));
      };
      row("x alone", emulated.x, emulated.alone_x);
      row("y alone", emulated.y, emulated.alone_y);
      row("x of both", emulated.x, emulated.both_x);
      row("y of both", emulated.y, emulated.both_y);
    }
  }
  csv.finish();
}

void write_elements(const Study& study, const std::array<EmulatedPair, 4>& all) {
  TrialTable table;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t rate = 0; rate < 2; ++rate) {
      const Emulated& emulated = all[i][rate];
      const std::string tag = fmt::format("{}_{}", kEmulations[i].name, rate == 0 ? "100hz" : "preset");
      const auto column = [&](const char* what, auto value) {
        std::vector<double> cells;
        for (const Hold& hold : emulated.curve) cells.push_back(value(hold));
        table.add(fmt::format("{}_{}", tag, what), std::move(cells));
      };
      column("time_s", [](const Hold& hold) { return hold.time; });
      column("x_mm", [](const Hold& hold) { return 1e3 * hold.felt.x; });
      column("v_m_per_s", [](const Hold& hold) { return hold.felt.y; });
      column("a_m_per_s2", [](const Hold& hold) { return hold.felt.z; });
      column("force_n", [](const Hold& hold) { return hold.force; });
      column("ideal_n", [&](const Hold& hold) { return glm::dot(emulated.x, hold.felt); });
    }
  }
  table.write(study, "elements");
}

std::string element_panel(const Emulation& emulation, const char* abscissa, const char* label, double rate) {
  return fmt::format(R"gp(set xlabel "{label}"
set title "{name}"
plot "elements.csv" using "{name}_preset_{x}":"{name}_preset_force_n" \
    with points pointtype 7 pointsize 0.18 linecolor "{blue}" title "{rate:g} Hz", \
  "" using "{name}_100hz_{x}":"{name}_100hz_force_n" \
    with points pointtype 6 pointsize 0.6 linecolor "{red}" title "100 Hz", \
  "" using "{name}_100hz_{x}":"{name}_100hz_ideal_n" \
    with lines linewidth 1.2 linecolor "{ink}" title "ideal element of 100 Hz"
)gp",
                     fmt::arg("label", label), fmt::arg("name", emulation.name), fmt::arg("x", abscissa),
                     fmt::arg("blue", kBlue), fmt::arg("red", kRed), fmt::arg("rate", rate), fmt::arg("ink", kInk));
}

void draw_elements(const Study& study, const std::array<EmulatedPair, 4>& all) {
  write_elements(study, all);
  const double rate = study.preset.haptics.rate;
  draw(study,
       {"elements", 1100, 820,
        fmt::format("set multiplot layout 2,2 margins 0.08, 0.98, 0.08, 0.95 spacing 0.1, 0.14\n"
                    "set key top left\nset ylabel \"force against the hand [N]\"\n{}{}{}{}unset multiplot\n",
                    element_panel(kEmulations[0], "x_mm", "position [mm]", rate),
                    element_panel(kEmulations[1], "v_m_per_s", "velocity [m/s]", rate),
                    element_panel(kEmulations[2], "a_m_per_s2", "acceleration [m/s^2]", rate),
                    "set offsets 0, 0, graph 0.3, 0\n" + element_panel(kEmulations[3], "time_s", "time [s]", rate))});
}

// Why a mass cannot be had from an encoder.
std::string mass_noise(const Study& study, const Emulated& fast, double rate) {
  const double count = encoder_step(study), mass = fast.x.z;
  return fmt::format("one count is {:.2g} N of the mass' force there, M q/T^2, and the condition leaves {:.2g} g",
                     mass * count * rate * rate, 1e3 * mass);
}

// The hand feels a force that is half a period old, a damper's a whole one: what (14) and (16) hold b against.
Finding lag_row(const Emulated& spring, const Emulated& damper) {
  const double lost = -0.5 * spring.x.x / kPaperRate, mass = -damper.x.y / kPaperRate;
  return {
      "(14): b must exceed K T/2",
      fmt::format(
          "in the middle of its holds the 100 Hz spring gives {:.4g} N/m and {:.3g} N s/m, the damper {:.3g} N s/m "
          "and {:.2g} g",
          spring.felt.x, spring.felt.y, damper.felt.y, 1e3 * damper.felt.z),
      fmt::format("the hold's own: -K T/2 = {:.3g} N s/m of the joystick's damping ({}), -B T = {:.2g} g of its mass",
                  lost, relative(spring.felt.y, lost), 1e3 * mass)};
}

void add_emulation(const Study& study, Section& section) {
  std::array<EmulatedPair, 4> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    tell(study, fmt::format("elements: {}", kEmulations[i].name));
    const double rate = study.preset.haptics.rate;
    all[i] = {emulate(study, kEmulations[i], kPaperRate), emulate(study, kEmulations[i], rate)};
    const Emulated &slow = all[i][0], &fast = all[i][1];
    section.findings.push_back(
        {fmt::format("Section 3: \"the joystick well emulated these objects\": {}", kEmulations[i].name),
         fmt::format("X at 100 Hz, {}: {} alone, {} with Y. At {:g} Hz, {}: {} alone, {} with Y",
                     values(slow.x, slow.x), values(slow.alone_x, slow.x), values(slow.both_x, slow.x), rate,
                     values(fast.x, fast.x), values(fast.alone_x, fast.x), values(fast.both_x, fast.x)),
         fmt::format("both axes, alone and together, off by at most {} at 100 Hz and {} at {:g} Hz{}", deviations(slow),
                     deviations(fast), rate, kEmulations[i].mass > 0.0 ? ": " + mass_noise(study, fast, rate) : "")});
  }
  write_fits(study, all);
  section.findings.push_back(lag_row(all[0][0], all[1][0]));
  draw_elements(study, all);
  section.pictures.push_back(
      {"elements",
       "The force of emulated elements on X over the true motion in the middle of each hold; the "
       "lever is led by a gripping hand. The width of the 100 Hz curves is the lag of the hold."});
}

// ---- coupling ----

struct Crosstalk {
  double angle = 0.0;   // [deg] that the lever stands off in Y, and is pushed to in X
  double motion = 0.0;  // [%] of the way in X
  double force = 0.0;   // [%] of the elements' force in X
};

// Pushes the lever along x, springs on both axes, and looks what y does.
Crosstalk couple_axes(const Study& study, double degrees, bool joints) {
  constexpr double kCouplingShare = 0.4;  // of (14): so that the motors reach the last angle
  constexpr double kMove = 0.5;           // [s] there, and back
  Trial trial = open_trial(study, kPaperRate);
  const SimulatedLeverConfig& lever = trial.lever;
  const double spring_x = kCouplingShare * limits_of(lever.axis_x, 1.0 / kPaperRate).spring;
  const double spring_y = kCouplingShare * limits_of(lever.axis_y, 1.0 / kPaperRate).spring;
  trial.start = plane_position(lever.yoke, {0.0, -degrees * kDegree});
  const double push = spring_x * lever.yoke.radius * std::sin(degrees * kDegree);
  const double upright = lever.axis_y.stiffness * lever.yoke.radius * degrees * kDegree / std::cos(degrees * kDegree);
  trial.hand = [=](double time, dvec2) {
    const double going = minimum_jerk({0.0, 0.0}, {1.0, 0.0}, time, kMove).position.x;
    const double coming = minimum_jerk({0.0, 0.0}, {1.0, 0.0}, time - kMove, kMove).position.x;
    HandTarget target;
    target.push = {push * (going - coming), upright};  // and holds the lever's own spring in Y
    return target;
  };
  trial.lever.hand = kBareHand;
  trial.duration = 2.0 * kMove;
  VirtualElement world({0.0, 0.0, spring_x}, {0.0, 0.0, spring_y}, trial.start,
                       joints ? std::optional(lever.yoke) : std::nullopt);
  trial.world = &world;

  double x = 0.0, y = 0.0, fx = 0.0, fy = 0.0;
  for (const TrialSample& sample : run_trial(trial).samples) {
    x = std::max(x, std::abs(sample.position.x));
    y = std::max(y, std::abs(sample.position.y - trial.start.y));
    fx = std::max(fx, std::abs(sample.motor.x));
    fy = std::max(fy, std::abs(sample.motor.y));
  }
  return {degrees, 100.0 * y / x, 100.0 * fy / fx};
}

std::string coupling_panel(const char* quantity, const char* label) {
  return fmt::format(R"gp(set ylabel "{label}"
plot "coupling.csv" using "angle_deg":"joints_{what}_percent" \
    with linespoints pointtype 7 linecolor "{red}" title "each joint by itself, as in the paper", \
  "" using "angle_deg":"plane_{what}_percent" \
    with linespoints pointtype 7 linecolor "{blue}" title "in the plane, exact kinematics"
)gp",
                     fmt::arg("label", label), fmt::arg("what", quantity), fmt::arg("red", kRed),
                     fmt::arg("blue", kBlue));
}

void draw_coupling(const Study& study) {
  draw(study,
       {"coupling", 1100, 430,
        fmt::format("set multiplot layout 1,2 margins 0.08, 0.98, 0.14, 0.94 spacing 0.1\nset key top left\n"
                    "set xlabel \"angle of the other axis, and stroke [deg]\"\nset yrange [0:*]\n{}{}unset multiplot\n",
                    coupling_panel("motion", "motion of Y over that of X [%]"),
                    coupling_panel("force", "force on Y over that on X [%]"))});
}

void add_coupling(const Study& study, Section& section) {
  tell(study, "elements: coupling");
  CsvFile csv(study, "coupling",
              "angle_deg,joints_motion_percent,joints_force_percent,plane_motion_percent,plane_force_percent");
  std::string joints, plane;
  for (const double angle : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0}) {
    const Crosstalk each = couple_axes(study, angle, true), exact = couple_axes(study, angle, false);
    csv.row({angle, each.motion, each.force, exact.motion, exact.force});
    if (angle != 5.0 && angle != 10.0 && angle != 20.0 && angle != 30.0) continue;
    joints += fmt::format("{}{:.2g} % of the motion and {:.2g} % of the force at {:g} deg", joints.empty() ? "" : "; ",
                          each.motion, each.force, angle);
    plane +=
        fmt::format("{}{:.2g} and {:.2g} % at {:g} deg", plane.empty() ? "" : "; ", exact.motion, exact.force, angle);
  }
  csv.finish();
  draw_coupling(study);
  section.findings.push_back({"Section 3: \"only insignificant coupling effects between the two joints\"",
                              "springs on each joint by itself, pushed along X, seen in Y: " + joints,
                              "in the gate plane through the exact kinematics: " + plane});
  section.pictures.push_back(
      {"coupling",
       "What Y does when the lever is pushed along X, springs on both axes, Y standing off by the "
       "same angle: insignificant near the middle, as the paper says; a matter of kinematics."});
}

// ---- the rough damper ----

struct Roughness {
  double speed = 0.0;         // [m/s] greatest
  double acceleration = 0.0;  // [m/s^2] greatest
  double peak = 0.0;          // [N] greatest force
  double step = 0.0;          // [N] greatest change from one hold to the next
  std::vector<Hold> curve;
};

struct Stroke {
  double half, duration;  // [m], [s]
};
constexpr Stroke kSlowStroke{0.015, 0.8}, kFastStroke{0.045, 0.12};

Roughness roughness(const Study& study, double rate, const AxisModel& element, Stroke stroke, double loop_damping) {
  Trial trial = open_trial(study, rate);
  trial.haptics.tuning.aisle_damping = loop_damping;
  trial.start = {-stroke.half, 0.0};
  VirtualElement world(element, {}, trial.start, {});
  HandStroke there;
  there.to = {stroke.half, 0.0};
  there.duration = stroke.duration;
  there.dwell = 0.5 * stroke.duration;
  Roughness rough;
  rough.curve = holds_of(led_run(trial, {there}, &world), 0);
  for (std::size_t i = 1; i < rough.curve.size(); ++i) {
    const Hold& hold = rough.curve[i];
    rough.speed = std::max(rough.speed, std::abs(hold.felt.y));
    rough.acceleration = std::max(rough.acceleration, std::abs(hold.felt.z));
    rough.peak = std::max(rough.peak, std::abs(hold.force));
    rough.step = std::max(rough.step, std::abs(hold.force - rough.curve[i - 1].force));
  }
  return rough;
}

void add_curve(TrialTable& table, const std::string& tag, const Roughness& rough, double damping) {
  std::vector<double> time, force, ideal;
  for (const Hold& hold : rough.curve) {
    time.push_back(1e3 * hold.time);
    force.push_back(hold.force);
    ideal.push_back(damping * hold.felt.y);
  }
  table.add(tag + "_time_ms", std::move(time));
  table.add(tag + "_force_n", std::move(force));
  table.add(tag + "_ideal_n", std::move(ideal));
}

std::string damper_panel(const char* title, const char* tag, double rate, const std::string& ranges) {
  const bool filtered = rate != kPaperRate;
  std::string curves = fmt::format(
      "plot \"rough_damper.csv\" using \"{0}_time_ms\":\"{0}_force_n\" with steps linewidth 1.3 linecolor \"{1}\" "
      "title \"{2:g} Hz, "
      "newest difference\"",
      tag, rate == kPaperRate ? kRed : kBlue, rate);
  if (filtered)
    curves += fmt::format(
        ", \"\" using \"{0}_filtered_time_ms\":\"{0}_filtered_force_n\" with steps linewidth 1.3 "
        "linecolor \"{1}\" title \"the loop's own damping, filtered\"",
        tag, kBufferColour);
  curves += fmt::format(
      ", \"\" using \"{0}_time_ms\":\"{0}_ideal_n\" with lines dashtype 2 linecolor \"{1}\" title \"B v of the true "
      "handle\"\n",
      tag, kInk);
  return fmt::format("set title \"{}\"\n{}{}", title, ranges, curves);
}

void add_rough_damper(const Study& study, Section& section) {
  tell(study, "elements: damper");
  const double rate = study.preset.haptics.rate, damping = kShare * study.preset.lever.axis_x.damping;
  const AxisModel damper{0.0, damping, 0.0}, nothing{};
  const AxisModel spring{0.0, 0.0, kShare * limits_of(study.preset.lever.axis_x, 1.0 / kPaperRate).spring};
  const Roughness slow = roughness(study, kPaperRate, damper, kSlowStroke, 0.0);
  const Roughness fast = roughness(study, kPaperRate, damper, kFastStroke, 0.0);
  const Roughness slow_ours = roughness(study, rate, damper, kSlowStroke, 0.0);
  const Roughness fast_ours = roughness(study, rate, damper, kFastStroke, 0.0);
  const Roughness slow_filtered = roughness(study, rate, nothing, kSlowStroke, damping);
  const Roughness fast_filtered = roughness(study, rate, nothing, kFastStroke, damping);
  const Roughness springy = roughness(study, kPaperRate, spring, kFastStroke, 0.0);

  TrialTable table;
  add_curve(table, "slow_100hz", slow, damping);
  add_curve(table, "fast_100hz", fast, damping);
  add_curve(table, "slow_preset", slow_ours, damping);
  add_curve(table, "fast_preset", fast_ours, damping);
  add_curve(table, "slow_preset_filtered", slow_filtered, damping);
  add_curve(table, "fast_preset_filtered", fast_filtered, damping);
  table.write(study, "rough_damper");
  const std::string whole = "set xrange [*:*]\nset yrange [*:*]\n";
  const std::string slow_part =
      fmt::format("set xrange [300:500]\nset yrange [{}:{}]\n", -0.3 * slow.peak, 1.15 * slow.peak);
  draw(study, {"rough_damper", 1100, 780,
               fmt::format(
                   "set multiplot layout 2,2 margins 0.07, 0.98, 0.08, 0.95 spacing 0.08, 0.13\nset key bottom center\n"
                   "set xlabel \"time [ms]\"\nset ylabel \"force against the hand [N]\"\n"
                   "set offsets 0, 0, graph 0.05, graph 0.25\n{}{}{}{}unset multiplot\n",
                   damper_panel("slow, 100 Hz", "slow_100hz", kPaperRate, slow_part),
                   damper_panel("fast, 100 Hz", "fast_100hz", kPaperRate, whole),
                   damper_panel("slow, the preset's rate", "slow_preset", rate, slow_part),
                   damper_panel("fast, the preset's rate", "fast_preset", rate, whole))});

  const double count = encoder_step(study);
  const auto steps = [&](const Roughness& rough, double at) {
    return fmt::format("{:.2g} N of {:.2g} N at {:.2g} m/s (B a T = {:.2g} N, one count B q/T = {:.2g} N)", rough.step,
                       rough.peak, rough.speed, damping * rough.acceleration / at, damping * count * at);
  };
  section.findings.push_back(
      {"Section 3: \"unsmooth motions ... in damper emulation when the joystick moved with high velocities\"",
       fmt::format("largest force step of {:.3g} N s/m at 100 Hz: {}, but {}", damping, steps(slow, kPaperRate),
                   steps(fast, kPaperRate)),
       fmt::format("{:.0f} times rougher at speed; at {:g} Hz: {} and {}; filtered as the loop's own damping {:.2g} "
                   "and {:.2g} N",
                   fast.step / slow.step, rate, steps(slow_ours, rate), steps(fast_ours, rate), slow_filtered.step,
                   fast_filtered.step)});
  section.findings.push_back(
      {"Section 3: \"force generation in spring emulation was much smoother\"",
       fmt::format(
           "spring of {:.3g} N/m on the same fast stroke at 100 Hz: largest step {:.2g} N of {:.2g} N, {:.0f} %; "
           "damper {:.0f} %",
           spring.stiffness, springy.step, springy.peak, 100.0 * springy.step / springy.peak,
           100.0 * fast.step / fast.peak),
       fmt::format(
           "not found: held for a period, both change by about omega T of their peak; one count is {:.2g} N to the "
           "spring and {:.2g} N to the damper",
           spring.stiffness * count, damping * count * kPaperRate)});
  section.pictures.push_back(
      {"rough_damper",
       "An emulated damper: at 100 Hz its force is a staircase as soon as the lever is fast, because "
       "velocity changes much within a period; at the preset's rate the counts of the encoder remain."});
}

}  // namespace

Section elements_section(const Study& study) {
  Section section{"elements", "Emulated spring, damper, mass and impedance: (13) to (21)", "", {}, {}};
  section.text = fmt::format(
      "A virtual element (19) is put behind the lever, in a wide aisle without walls, feel or damping of the loop, at "
      "{:g} % "
      "of what the conditions admit at 100 Hz. A gripping hand leads the lever; the encoder is the preset's. "
      "Stiffness, "
      "damping and mass are what least squares find in the motors' force over the true motion that the samples stand "
      "for.",
      100.0 * kShare);
  add_limits(study, section);
  add_emulation(study, section);
  add_coupling(study, section);
  add_rough_damper(study, section);
  return section;
}

}  // namespace gearshift
