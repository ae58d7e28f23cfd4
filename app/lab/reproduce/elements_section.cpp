#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "app/base/colours.h"
#include "app/lab/reproduce/coupling.h"
#include "app/lab/reproduce/element_trial.h"
#include "app/lab/reproduce/rough_damper.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/virtual_element.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr const char* kRed = base::kLockoutColour;
constexpr const char* kBlue = base::kGearColour;

// ---- limits ----

Finding limit_row(const char* paper, double x, double y, double paper_x, double paper_y, const char* unit,
                  const std::string& why) {
  return {paper, fmt::format("{:.4g} and {:.4g} {}", x, y, unit),
          fmt::format("{} and {}{}", relative(x, paper_x), relative(y, paper_y), why)};
}

void add_limits(const Study& study, Section& section) {
  const haptics::AxisModel &x = study.preset.lever.axis_x, &y = study.preset.lever.axis_y;
  const ElementLimits lx = element_limits(x, 1.0 / kPaperRate), ly = element_limits(y, 1.0 / kPaperRate);
  const std::string why =
      fmt::format("; 605 and 566 would follow from b = {:.3f} and {:.2f}, but the device has {:g} and {:g}",
                  605.0 / (2.0 * kPaperRate), 566.0 / (2.0 * kPaperRate), x.damping, y.damping);
  section.findings.push_back(
      limit_row("(14): K < 605 and 566 N/m in X and Y at 100 Hz", lx.spring, ly.spring, 605.0, 566.0, "N/m", why));
  section.findings.push_back(limit_row("(16): B < 3.0 and 2.9 N s/m", lx.damper, ly.damper, 3.0, 2.9, "N s/m", ""));
  section.findings.push_back(
      limit_row("(18): M < 0.015 and 0.014 kg", lx.mass, ly.mass, 0.015, 0.014, "kg",
                fmt::format("; 2.9 T/2 is {:g}, but is printed as 0.014", 2.9 / (2.0 * kPaperRate))));
  section.findings.push_back({"(21): K + 200 B + 200^2 M < 605 and 566",
                              fmt::format("K + {:.4g} B + {:.5g} M < {:.4g} and {:.4g}", lx.spring / lx.damper,
                                          lx.spring / lx.mass, lx.spring, ly.spring),
                              "the same as (14)"});
}

// ---- emulation ----

struct Emulation {
  const char* name;
  double spring, damper, mass;  // [1] fractions of the elements' limits
};
// The fractions of each emulation add up to kElementFraction (0.8). The paper's eq (20) requires a sum below 1.
constexpr std::array<Emulation, 4> kEmulations{{{"spring", kElementFraction, 0.0, 0.0},
                                                {"damper", 0.0, kElementFraction, 0.0},
                                                {"mass", 0.0, 0.0, kElementFraction},
                                                {"impedance", 0.3, 0.3, 0.2}}};

// At every rate, spring and damper have their values for 100 Hz, so that the rates can be compared. The mass must be
// lower at a higher rate, because of the limit in the paper's eq (18).
haptics::AxisModel element_of(const Emulation& emulation, const haptics::AxisModel& handle, double rate) {
  const ElementLimits slow = element_limits(handle, 1.0 / kPaperRate), at_rate = element_limits(handle, 1.0 / rate);
  return {emulation.mass * std::min(slow.mass, at_rate.mass), emulation.damper * slow.damper,
          emulation.spring * slow.spring};
}

std::vector<haptics::HandStroke> strokes_through(std::span<const dvec2> points) {
  std::vector<haptics::HandStroke> strokes;
  for (const dvec2 point : points) {
    haptics::HandStroke stroke;
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

// Fits force F = K x + B v + M a to the sampled or true motion (x, v, a) by least squares.
dvec3 fit(const std::vector<ElementHold>& holds, dvec3 ElementHold::*motion) {
  glm::dmat3 normal(0.0);
  dvec3 projected(0.0);
  for (const ElementHold& hold : holds) {
    normal += glm::outerProduct(hold.*motion, hold.*motion);
    projected += hold.force * (hold.*motion);
  }
  return glm::inverse(normal) * projected;
}

// Wanted and fitted elements as (stiffness K, damping B, mass M).
struct Emulated {
  dvec3 x, y;                      // wanted
  dvec3 single_x, single_y;        // fitted to the sampled motion, one axis moving at a time
  dvec3 both_x, both_y;            // fitted to the sampled motion, both axes moving at once
  dvec3 actual;                    // fitted to the true motion, X axis only
  std::vector<ElementHold> curve;  // X axis only
};

dvec3 vector_of(const haptics::AxisModel& model) {
  return {model.stiffness, model.damping, model.mass};
}

Emulated emulate(const Study& study, const Emulation& emulation, double rate) {
  const Trial trial = free_trial(study, rate);
  const haptics::AxisModel x = element_of(emulation, trial.lever.axis_x, rate);
  const haptics::AxisModel y = element_of(emulation, trial.lever.axis_y, rate);
  VirtualElement only_x(x, {}, dvec2(0.0), {}), only_y({}, y, dvec2(0.0), {}), both(x, y, dvec2(0.0), {});
  Emulated out;
  out.x = vector_of(x);
  out.y = vector_of(y);
  out.curve = holds_of(run_with_hand(trial, strokes_through(kAlongX), &only_x), 0);
  out.single_x = fit(out.curve, &ElementHold::sampled);
  out.actual = fit(out.curve, &ElementHold::actual);
  out.single_y = fit(holds_of(run_with_hand(trial, strokes_through(kAlongY), &only_y), 1), &ElementHold::sampled);
  const TrialRun together = run_with_hand(trial, strokes_through(kBothAxes), &both);
  out.both_x = fit(holds_of(together, 0), &ElementHold::sampled);
  out.both_y = fit(holds_of(together, 1), &ElementHold::sampled);
  return out;
}

using EmulatedPair = std::array<Emulated, 2>;  // results at 100 Hz and at the preset's rate

constexpr std::array<const char*, 3> kNumber{"K", "B", "M"};
constexpr std::array<const char*, 3> kUnit{"N/m", "N s/m", "kg"};

// Formats values such as "K 480 N/m, B 2.4 N s/m". Omits elements that are zero in `wanted`.
std::string values(dvec3 kbm, dvec3 wanted) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (wanted[i] == 0.0) continue;
    text += fmt::format("{}{} {:.4g} {}", text.empty() ? "" : ", ", kNumber[k], kbm[i], kUnit[k]);
  }
  return text;
}

// Largest deviation of element i (0: K, 1: B, 2: M) in all fits. [%]
double deviation(const Emulated& emulated, int i) {
  const double x = emulated.x[i], y = emulated.y[i];
  double max_deviation = 0.0;
  for (const double ratio :
       {emulated.single_x[i] / x, emulated.both_x[i] / x, emulated.single_y[i] / y, emulated.both_y[i] / y})
    max_deviation = std::max(max_deviation, 100.0 * std::abs(ratio - 1.0));
  return max_deviation;
}

// Formats deviations such as "K 0.03 %, B 0.4 %".
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
      row("x alone", emulated.x, emulated.single_x);
      row("y alone", emulated.y, emulated.single_y);
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
        for (const ElementHold& hold : emulated.curve) cells.push_back(value(hold));
        table.add(fmt::format("{}_{}", tag, what), std::move(cells));
      };
      column("time_s", [](const ElementHold& hold) { return hold.time; });
      column("x_mm", [](const ElementHold& hold) { return 1e3 * hold.actual.x; });
      column("v_m_per_s", [](const ElementHold& hold) { return hold.actual.y; });
      column("a_m_per_s2", [](const ElementHold& hold) { return hold.actual.z; });
      column("force_n", [](const ElementHold& hold) { return hold.force; });
      column("ideal_n", [&](const ElementHold& hold) { return glm::dot(emulated.x, hold.actual); });
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
    with lines linewidth 1.2 linecolor "{ink}" title "ideal element (100 Hz)"
)gp",
                     fmt::arg("label", label), fmt::arg("name", emulation.name), fmt::arg("x", abscissa),
                     fmt::arg("blue", kBlue), fmt::arg("red", kRed), fmt::arg("rate", rate),
                     fmt::arg("ink", base::kInk));
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

// Explains why an encoder's resolution prevents the emulation of a mass.
std::string mass_noise(const Study& study, const Emulated& fast, double rate) {
  const double count = study.device.position_step, mass = fast.x.z;
  return fmt::format(
      "at this rate one encoder count causes an inertial force M q/T^2 of {:.2g} N, and the condition allows {:.2g} g",
      mass * count * rate * rate, 1e3 * mass);
}

// Compares the fitted spring and damper with the expected effect of lag. The hand feels the spring force half a period
// late, like a damping of -K T/2, and the damper force a full period late, like a mass of -B T. In the paper's
// equations (14) and (16), the device's damping b compensates for this lag.
Finding lag_row(const Emulated& spring, const Emulated& damper) {
  const double hold_damping = -0.5 * spring.x.x / kPaperRate, mass = -damper.x.y / kPaperRate;
  return {"(14): b must exceed K T/2",
          fmt::format("fitted to the middle of each hold, the 100 Hz spring has {:.4g} N/m and {:.3g} N s/m; the "
                      "damper has {:.3g} N s/m and {:.2g} g",
                      spring.actual.x, spring.actual.y, damper.actual.y, 1e3 * damper.actual.z),
          fmt::format("effect of the hold: a damping of -K T/2 = {:.3g} N s/m ({}), a mass of -B T = {:.2g} g",
                      hold_damping, relative(spring.actual.y, hold_damping), 1e3 * mass)};
}

void add_emulation(const Study& study, Section& section) {
  std::array<EmulatedPair, 4> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    report_progress(study, fmt::format("elements: {}", kEmulations[i].name));
    const double rate = study.preset.haptics.rate;
    all[i] = {emulate(study, kEmulations[i], kPaperRate), emulate(study, kEmulations[i], rate)};
    const Emulated &slow = all[i][0], &fast = all[i][1];
    section.findings.push_back(
        {fmt::format("Section 3: \"the joystick well emulated these objects\" ({})", kEmulations[i].name),
         fmt::format("X at 100 Hz, requested {}: {} alone, {} together with Y. X at {:g} Hz, requested {}: {} alone, "
                     "{} together with Y",
                     values(slow.x, slow.x), values(slow.single_x, slow.x), values(slow.both_x, slow.x), rate,
                     values(fast.x, fast.x), values(fast.single_x, fast.x), values(fast.both_x, fast.x)),
         fmt::format("both axes, alone and together, are off by at most {} at 100 Hz and {} at {:g} Hz{}",
                     deviations(slow), deviations(fast), rate,
                     kEmulations[i].mass > 0.0 ? "; " + mass_noise(study, fast, rate) : "")});
  }
  write_fits(study, all);
  section.findings.push_back(lag_row(all[0][0], all[1][0]));
  draw_elements(study, all);
  section.pictures.push_back(
      {"elements",
       "Force of emulated elements on X against the true motion in the middle of each hold, while a gripping hand "
       "moves the lever. The lag of the hold makes the 100 Hz curves wide."});
}

}  // namespace

Section elements_section(const Study& study) {
  Section section{"elements", "Emulated spring, damper, mass and impedance: (13) to (21)", "", {}, {}};
  section.text = fmt::format(
      "A virtual element (19) with {:g} % of the values that the conditions allow at 100 Hz acts on the lever, without "
      "walls, gate forces or damping by the loop. A gripping hand moves the lever; the encoder is the preset's. "
      "Stiffness, damping and mass are fitted by least squares to the motors' force against the true motion at the "
      "samples.",
      100.0 * kElementFraction);
  add_limits(study, section);
  add_emulation(study, section);
  add_coupling(study, section);
  add_rough_damper(study, section);
  return section;
}

}  // namespace gearshift::lab
