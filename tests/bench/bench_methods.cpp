// Ways to make a stiff wall, side by side: what each costs, how still and how stiff it is, what energy it makes, and
// how stiff it could be. 5000 N/m is wanted of all of them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/contact/lever_observer.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/gate/plain_aisle.h"
#include "haptics/safety/energy_control.h"
#include "tests/bench/bench.h"
#include "tests/bench/contact_campaign.h"
#include "tests/bench/ticks.h"

namespace gearshift {
namespace {

using glm::dvec2;

constexpr double kWanted = 5000.0;     // [N/m]
constexpr double kDisplayedOf = 0.97;  // [1] of it, by the design's table: a wall that gives way is still for nothing

struct Method {
  std::string name;
  ContactHold hold;
  double damping;  // [N s/m]; below 0: K T / 2, Minsky's 0.5 of (22)
  EnergyControl control = EnergyControl::none;
};

struct Place {
  double rate;  // [Hz]
  int delay;    // [samples]
};

double damping_of(const Method& method, const Place& at) {
  return method.damping >= 0.0 ? method.damping : std::min(100.0, kWanted / (2.0 * at.rate));
}

// A lever that trembles at a wall, in and out: what a cycle has to do about it. [ns]
double cost_once(const Method& method, const Place& at) {
  constexpr int kCycles = 5000;
  DeviceSpec spec;
  spec.delay = at.delay;
  const double period = 1.0 / at.rate;
  const Gate gate = plain_aisle(0.06, 0.03);
  const Passage passage = open_passage(gate);
  const Coupling coupling{kWanted, damping_of(method, at), period, at.delay, method.hold};
  LeverObserver observer(spec, period);
  const EnergyBounder bounder(spec.axis_x, at.delay, period);
  PassivityController controller(spec.axis_x, period);
  Proxy proxy = place_proxy(gate, {0.0, 0.0});
  LeverMotion motion;
  motion.fresh = true;
  dvec2 force{0.0};
  double last = 0.0;
  const std::uint64_t before = ticks();
  for (int n = 0; n < kCycles; ++n) {
    const double x = 0.06 + 1e-5 * static_cast<double>(n % 64 - 20);
    motion.velocity = {(x - motion.position.x) * at.rate, 0.0};
    const double travel = x - motion.position.x;
    motion.position = {x, 0.0};
    proxy = move_proxy(gate, passage, proxy, motion.position, 1e-3);
    const bool observes = method.hold == ContactHold::observer;
    const Coupled coupled = observes ? couple(coupling, gate, passage, proxy, observer.update(motion, force))
                                     : couple(coupling, gate, passage, proxy, motion);
    force = coupled.force;
    if (method.control == EnergyControl::energy_bounding) force.x = bounder.bound(force.x, last, travel);
    if (method.control == EnergyControl::passivity_controller)
      force.x = controller.control(force.x, last, travel, motion.position != proxy.position);
    last = force.x;
  }
  const double ns = static_cast<double>(ticks() - before) / ticks_per_ns() / kCycles;
  return std::isfinite(force.x) ? ns : std::numeric_limits<double>::quiet_NaN();  // so that the work is done
}

// Methods alternate, so that a busy machine slows them alike. [ns]
std::vector<Timed> costs(std::span<const Method> methods, const Place& at) {
  std::vector<std::vector<double>> taken(methods.size());
  for (int round = 0; round < 21; ++round) {
    for (std::size_t m = 0; m < methods.size(); ++m) taken[m].push_back(cost_once(methods[m], at));
  }
  std::vector<Timed> ns;
  for (std::vector<double>& of_method : taken) ns.push_back(timed(of_method));
  return ns;
}

// The exact boundary of the worst hand and axis.
double stiffest(const Method& method, const Place& at) {
  ContactLaw law;
  law.hold = method.hold;
  law.damping = damping_of(method, at);
  law.delay = at.delay;
  double most = 1e9;
  for (const NamedHand& named : kNamedHands)
    for (const AxisModel& axis : {kPaperAxisX, kPaperAxisY})
      most = std::min(most, stiffness_limit(axis, named.hand, law, 1.0 / at.rate));
  return most;
}

ContactCase contact_of(const Method& method, const Place& at) {
  ContactCase contact;
  contact.haptics.rate = at.rate;
  contact.haptics.contact = {method.hold, method.control, false, true};
  contact.haptics.tuning.wall_stiffness = kWanted;
  contact.haptics.tuning.wall_damping = damping_of(method, at);
  contact.haptics.tuning.aisle_damping = std::min(2.0, 0.03 * at.rate / (at.delay + 1.0));
  contact.lever.delay = at.delay;
  return contact;
}

// What the shipped default uses there, as it is: its wall of 5000 N/m is admitted whole.
bool is_default(const Method& method, const Place& at) {
  HapticConfig config;
  config.rate = at.rate;
  DeviceSpec spec;
  spec.delay = at.delay;
  const AdmittedTuning admitted = admit_tuning(config, spec, plain_aisle(0.05, 0.05));
  return admitted.hold == method.hold && admitted.tuning.wall_damping == damping_of(method, at) &&
         admitted.tuning.wall_stiffness == kWanted && config.contact.energy_control == method.control;
}

std::string words(const Place& at) {
  return std::to_string(static_cast<int>(at.rate)) + " Hz, delay " + std::to_string(at.delay);
}

BenchRow row_of(const Method& method, const Place& at, const Timed& ns, const BenchOptions& options) {
  Campaign campaign;
  campaign.contact = contact_of(method, at);
  campaign.runs = options.quick ? 3 : 100;
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  const HandOutcome& worst = worst_ripple(outcomes);
  const ImpactEnergy energy = run_impacts(contact_of(method, at), options.quick ? 5 : 100);
  const double displayed = least_displayed(outcomes);
  const Beside cycle{"cost", ns.median, "ns", ns.spread};
  BenchRow row{"methods",
               words(at) + ": " + method.name,
               1e3 * worst.ripple_p95,
               "mm",
               {},
               false,
               "last peak-to-peak p95, 20 N, worst hand: " + worst.hand,
               true,
               {{"displayed error", 100.0 * (1.0 - displayed), "%"},
                {"energy per contact, mean", 100.0 * energy.mean_share, "% of the impact"},
                {"worst", 100.0 * energy.worst_share, "%"},
                cycle}};
  if (displayed >= kDisplayedOf) {
    row.trade = Trade{words(at) + ": walls that display 97 %",
                      method.name,
                      cycle,
                      {"last peak-to-peak, p95", row.value, "mm"},
                      is_default(method, at)};
  }
  if (method.control == EnergyControl::none) row.beside.push_back({"K limit", stiffest(method, at), "N/m"});
  return row;
}

// A longer window is smoother, and late: what it costs is the trembling force that one count of the encoder makes by
// the damper, what it loses is stiffness.
Trade window_trade(int window, double damping, double limit) {
  const SimulatedLeverConfig lever;
  const double count = lever.yoke.radius * std::numbers::pi / 180.0 / lever.encoder_counts;  // [m] at the tip
  const double tremble = damping * count / (0.001 * window);
  return {"velocity window at 1 kHz, B = " + std::to_string(static_cast<int>(damping)) + " N s/m",
          "over " + std::to_string(window) + " ms",
          {"force of one count by the damper", tremble, "N"},
          {"least stable compliance", 1e6 / limit, "um/N"},
          window == EstimatorConfig{}.window};
}

// CHAI3D's default velocity window is 15 ms, Force Dimension's DHD has 20 ms.
void add_windows(std::vector<BenchRow>& rows, const BenchOptions& options) {
  for (const int window : {1, 4, 8, 15, 20}) {
    BenchRow row{"methods",
                 "velocity over " + std::to_string(window) + " ms at 1 kHz: K limit with B = 0",
                 0.0,
                 "N/m",
                 {},
                 false,
                 "X axis, bare; a textbook spring and damper",
                 true,
                 {}};
    const double wanted = HapticTuning{}.wall_damping;
    for (const double damping : {0.0, 3.0, 5.0, 10.0, 20.0}) {
      ContactLaw law{ContactHold::zero_order, 0.0, damping, window};
      const double limit = stiffness_limit(kPaperAxisX, kBareHand, law, 0.001);
      if (damping == 0.0) row.value = limit;
      if (damping > 0.0) row.beside.push_back({"B = " + std::to_string(static_cast<int>(damping)), limit, "N/m"});
      if (damping == wanted) row.trade = window_trade(window, damping, limit);
    }
    rows.push_back(row);
  }
  for (const auto& [window, damping] : {std::pair{15, 0.0}, {15, 10.0}, {1, 10.0}}) {
    ContactCase contact = contact_of({"", ContactHold::zero_order, damping}, {1000.0, 0});
    contact.haptics.estimator.window = window;
    contact.haptics.tuning.aisle_damping = 0.0;
    contact.lever.encoder_counts = 0.0;  // the boundary itself, without the encoder's own buzz
    contact.duration = options.quick ? 1.2 : 3.0;
    const ContactResult one = run_contact(contact);
    rows.push_back({"methods",
                    "5000 N/m, velocity over " + std::to_string(window) +
                        " ms, B = " + std::to_string(static_cast<int>(damping)) + ": last peak-to-peak",
                    1e3 * one.ripple,
                    "mm",
                    {},
                    false,
                    "X axis, bare, 20 N, no quantisation",
                    true,
                    {}});
  }
}

}  // namespace

std::vector<BenchRow> bench_methods(const BenchOptions& options) {
  const Method methods[] = {
      {"zero-order hold, B = 0 (textbook)", ContactHold::zero_order, 0.0},
      {"zero-order hold, B = K T / 2 (22)", ContactHold::zero_order, -1.0},
      {"half-sample hold, B = 0", ContactHold::half_sample, 0.0},
      {"half-sample hold, B = 10", ContactHold::half_sample, 10.0},
      {"observer", ContactHold::observer, kObservedDamping},
      {"zero-order hold with passivity control", ContactHold::zero_order, 0.0, EnergyControl::passivity_controller},
      {"zero-order hold with energy bounding", ContactHold::zero_order, 0.0, EnergyControl::energy_bounding},
      {"half-sample hold, B = 10, with energy bounding", ContactHold::half_sample, 10.0,
       EnergyControl::energy_bounding}};
  const Place places[] = {{1000, 0}, {1000, 1}, {1000, 2}, {500, 0}, {200, 0}};
  std::vector<BenchRow> rows;
  for (const Place& at : places) {
    const std::vector<Timed> ns = costs(methods, at);
    for (std::size_t m = 0; m < std::size(methods); ++m) {
      if (options.progress) options.progress("methods", static_cast<double>(rows.size()) / 40.0);
      rows.push_back(row_of(methods[m], at, ns[m], options));
    }
  }
  add_windows(rows, options);
  return rows;
}

}  // namespace gearshift
