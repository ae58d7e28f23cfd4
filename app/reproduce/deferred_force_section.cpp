#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/draw/gate_colours.h"
#include "app/reproduce/section.h"
#include "app/reproduce/study_files.h"
#include "app/reproduce/trial.h"
#include "haptics/contact/virtual_coupling.h"

namespace gearshift {
namespace {

// Fig. 6 (b): 200 Hz, the lever enters the wall at 188 ms and leaves it at 213 ms.
constexpr double kPeriod = 1.0 / 200.0;             // [s]
constexpr double kEnters = 0.188, kLeaves = 0.213;  // [s]
constexpr double kEntrySpeed = 0.3;                 // [m/s] the paper prints none; every share is the same at any other
constexpr int kFirst = 36, kLast = 44;              // [samples] 180 to 220 ms

// Depth of the lever: the parabola through both instants, which is a lever thrown back by a steady force. [m]
double depth(double time) {
  const double half = 0.5 * (kLeaves - kEnters), middle = 0.5 * (kLeaves + kEnters);
  const double u = (time - middle) / half;
  return 0.5 * kEntrySpeed * half * (1.0 - u * u);
}
double sampled_depth(int sample) {
  return depth(sample * kPeriod);
}

// Energy that a spring holds at that depth. [J]
double stored(double stiffness, double at) {
  return 0.5 * stiffness * std::max(0.0, at) * std::max(0.0, at);
}

// Force of the shipped coupling over the hold that begins with a sample, a spring alone. [N] against the lever
double coupled_force(const Coupling& coupling, int sample) {
  static const Gate gate = wall_at_zero();
  const Passage passage = open_passage(gate);
  LeverMotion motion;
  motion.position = {sampled_depth(sample), 0.0};
  motion.velocity = {(sampled_depth(sample) - sampled_depth(sample - 1)) / coupling.period, 0.0};
  return -couple(coupling, gate, passage, place_proxy(gate, motion.position), motion).force.x;
}

// The observed hold, told the truth: where the hold ends. A prescribed path yields to no force.
double observed_force(const Coupling& coupling, int sample) {
  constexpr double kRigid = 1e-9;  // [m/N] as good as none
  return solved_force(coupling, sampled_depth(sample), sampled_depth(sample + 1), kRigid);
}

struct Hold {
  const char* name;
  const char* tag;
  std::array<double, kLast> force{};  // [N] by sample
  double first = 0.0, second = 0.0;   // [J] generated in the hold of region I, and of region II
  double whole = 0.0;                 // [J] over the contact
};

// What a held force gives the lever beyond what the spring would have.
void account(Hold& hold, double stiffness) {
  for (int i = kFirst; i < kLast; ++i) {
    const double begin = sampled_depth(i), end = sampled_depth(i + 1);
    const double work = hold.force[static_cast<std::size_t>(i)] * (begin - end);
    const double more = work - (stored(stiffness, begin) - stored(stiffness, end));
    if (begin <= 0.0 && end > 0.0) hold.first += more;
    if (begin > 0.0 && end <= 0.0) hold.second += more;
    hold.whole += more;
  }
}

std::array<Hold, 3> make_holds(double stiffness) {
  std::array<Hold, 3> holds{Hold{"zero-order hold, the paper's", "zero_order"},
                            Hold{"half-sample hold, the shipped default", "half_sample"},
                            Hold{"ideal: the hold's end known", "observed"}};
  Coupling coupling{stiffness, 0.0, kPeriod, 0, ContactHold::zero_order};
  for (int i = kFirst; i < kLast; ++i) {
    const auto sample = static_cast<std::size_t>(i);
    coupling.hold = ContactHold::zero_order;
    holds[0].force[sample] = coupled_force(coupling, i);
    coupling.hold = ContactHold::half_sample;
    holds[1].force[sample] = coupled_force(coupling, i);
    holds[2].force[sample] = observed_force(coupling, i);
  }
  for (Hold& hold : holds) account(hold, stiffness);
  return holds;
}

// Position and held forces over g, as the paper draws them: g = 1, one scale for both.
void write_curves(const Study& study, const std::array<Hold, 3>& holds, double stiffness) {
  constexpr int kFine = 50;  // points per hold
  CsvFile csv(study, "deferred_force",
              "time_ms,depth_mm,zero_order_force_over_g_mm,half_sample_force_over_g_mm,observed_force_over_g_mm");
  for (int i = kFirst * kFine; i < kLast * kFine; ++i) {
    const double time = kPeriod * i / kFine;
    const auto sample = static_cast<std::size_t>(i / kFine);
    const auto over_g = [&](const Hold& hold) { return 1e3 * hold.force[sample] / stiffness; };
    csv.row({1e3 * time, 1e3 * depth(time), over_g(holds[0]), over_g(holds[1]), over_g(holds[2])});
  }
  csv.finish();
}

// The paper's regions: from the crossing to the sample that notices it.
std::string regions(const char* force) {
  const double noticed = std::ceil(kEnters / kPeriod) * kPeriod, left = std::ceil(kLeaves / kPeriod) * kPeriod;
  return fmt::format(
      R"gp("" using ($1>={0}&&$1<={1}?$1:1/0):(column("depth_mm")):(column("{4}")) \
    with filledcurves fillcolor "{5}" fillstyle solid 0.45 title "region I", \
  "" using ($1>={2}&&$1<={3}?$1:1/0):(column("depth_mm")):(column("{4}")) \
    with filledcurves fillcolor "{6}" fillstyle solid 0.45 title "region II", \
)gp",
      1e3 * kEnters, 1e3 * noticed, 1e3 * kLeaves, 1e3 * left, force, kBufferColour, kLockoutColour);
}

std::string panel(const Hold& hold) {
  const std::string force = fmt::format("{}_force_over_g_mm", hold.tag);
  return fmt::format(R"gp(set title "{}"
plot "deferred_force.csv" using 1:(0) with lines linecolor "{}" notitle, \
  {}  "" using "time_ms":"depth_mm" with lines linewidth 1.5 linecolor "{}" title "position", \
  "" using "time_ms":"{}" with lines linewidth 1.8 linecolor "{}" title "force / g"
)gp",
                     hold.name, kSoftInk, regions(force.c_str()), kLockoutColour, force, kGearColour);
}

void draw_curves(const Study& study, const std::array<Hold, 3>& holds) {
  draw(study, {"deferred_force", 1200, 460,
               fmt::format("set multiplot layout 1,3 margins 0.05, 0.975, 0.13, 0.92 spacing 0.06\n"
                           "set key bottom center\nset xlabel \"time [ms]\"\nset xtics 10\nset mxtics 2\n"
                           "set yrange [-2.6:2.4]\nset ylabel \"position, force / g [mm]\"\n{}{}{}unset multiplot\n",
                           panel(holds[0]), panel(holds[1]), panel(holds[2]))});
}

std::string energy(double joule, double whole) {
  return fmt::format("{:+.3g} mJ ({:+.3g} %)", 1e3 * joule, 100.0 * joule / whole);
}

std::string energies(const Hold& hold, double whole) {
  return fmt::format("I {}, II {}, whole contact {}", energy(hold.first, whole), energy(hold.second, whole),
                     energy(hold.whole, whole));
}

// First instant with a force, and the end of the last hold with one. [ms]
std::array<double, 2> force_times(const Hold& hold) {
  int first = kLast, last = kFirst;
  for (int i = kFirst; i < kLast; ++i) {
    if (hold.force[static_cast<std::size_t>(i)] <= 0.0) continue;
    first = std::min(first, i);
    last = i + 1;
  }
  return {1e3 * kPeriod * first, 1e3 * kPeriod * last};
}

}  // namespace

Section deferred_force_section(const Study& study) {
  const double stiffness = study.preset.haptics.tuning.wall_stiffness;
  const std::array<Hold, 3> holds = make_holds(stiffness);
  const double most = stored(stiffness, depth(0.5 * (kEnters + kLeaves)));
  write_curves(study, holds, stiffness);
  draw_curves(study, holds);

  const auto [begins, ends] = force_times(holds[0]);
  Section section{"deferred_force", "Fig. 6 (b): deferred force generation", "", {}, {}};
  section.text = fmt::format(
      "A prescribed path enters the wall at {:g} ms and leaves it at {:g} ms, sampled at {:g} Hz; entry speed {:g} "
      "m/s. The "
      "force is that of the shipped coupling fed with these samples, a spring of {:g} N/m without damping. The third "
      "hold "
      "is an ideal: it is told where the hold ends, which an observer with a true model would know. Energy is "
      "what the "
      "held force gives the lever beyond what the spring would have, in the hold where the lever enters (region I) and "
      "in the "
      "one where it leaves (region II); per cent of the {:.3g} mJ that the spring stores at the deepest point.",
      1e3 * kEnters, 1e3 * kLeaves, 1.0 / kPeriod, kEntrySpeed, stiffness, 1e3 * most);
  section.findings = {
      {"Fig. 6 (b): entered at 188 ms, \"the simulated reflective force was computed until 190 ms\"; "
       "left at 213 ms, until "
       "215 ms",
       fmt::format("zero-order force from {:g} to {:g} ms", begins, ends),
       fmt::format("{:+.2g} and {:+.2g} ms", begins - 190.0, ends - 215.0)},
      {"Section 3.1: \"late energy generation\" in regions I and II", "zero-order hold: " + energies(holds[0], most),
       "the paper gives no numbers"},
      {"Section 3.1: the cure is \"a sampling rate up to 1 K Hz\" or a slow joystick",
       "half-sample hold at the same 200 Hz: " + energies(holds[1], most) + "; the ideal: " + energies(holds[2], most),
       fmt::format("{:+.0f} % and {:+.0f} % of what the zero-order hold gives", 100.0 * holds[1].whole / holds[0].whole,
                   100.0 * holds[2].whole / holds[0].whole)}};
  section.pictures = {
      {"deferred_force",
       "Position and held force on one scale. Region I: in the wall without a force; region II: out of the "
       "wall with one. The half-sample hold starts before the wall is reached, because it knows the speed."}};
  return section;
}

}  // namespace gearshift
