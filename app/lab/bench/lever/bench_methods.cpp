// Compares methods of rendering a stiff wall of 5000 N/m: cost, ripple, displayed stiffness, generated energy and
// largest stable stiffness.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/bench/rows/ticks.h"
#include "app/lab/contact/contact_campaign.h"
#include "haptics/analysis/sampled_loop.h"
#include "haptics/contact/lever_observer.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/gate/plain_aisle.h"
#include "haptics/safety/energy_control.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kWanted = 5000.0;  // [N/m]
// [1] The fraction of its stiffness that a wall must display according to the design goals (app/lab/bench/README.md).
// Methods that display less are not plotted.
constexpr double kDisplayedOf = 0.95;

struct Method {
  std::string name;
  haptics::ContactHold hold;
  double damping;  // [N s/m] negative: use (stiffness * period) / 2, the minimum by Lin and Young's eq. (22), or with
                   // the observer hold its own damping
  haptics::EnergyControl control = haptics::EnergyControl::none;
};

struct LoopTiming {
  double rate;  // [Hz]
  int delay;    // [samples]
};

double damping_of(const Method& method, const LoopTiming& at) {
  if (method.damping >= 0.0) return method.damping;
  if (method.hold == haptics::ContactHold::observer)
    return haptics::observed_damping(haptics::kPaperAxisY.mass, (at.delay + 1.0) / at.rate);
  return std::min(100.0, kWanted / (2.0 * at.rate));
}

// Cost of a contact cycle for a lever that trembles in and out of a wall. [ns]
double cost_once(const Method& method, const LoopTiming& at) {
  constexpr int kCycles = 5000;
  haptics::DeviceSpec spec;
  spec.delay = at.delay;
  const double period = 1.0 / at.rate;
  const haptics::Gate gate = haptics::plain_aisle(0.06, 0.03);
  const haptics::Passage passage = haptics::open_passage(gate);
  const haptics::Coupling coupling{kWanted, damping_of(method, at), period, at.delay, method.hold};
  haptics::LeverObserver observer(spec, period);
  const haptics::EnergyBounder bounder(spec.axis_x, at.delay, period);
  haptics::PassivityController controller(spec.axis_x, period);
  haptics::Proxy proxy = haptics::place_proxy(gate, {0.0, 0.0});
  haptics::LeverMotion motion;
  motion.fresh = true;
  dvec2 force{0.0};
  double last = 0.0;
  const std::uint64_t before = ticks();
  for (int n = 0; n < kCycles; ++n) {
    const double x = 0.06 + 1e-5 * static_cast<double>(n % 64 - 20);
    motion.velocity = {(x - motion.position.x) * at.rate, 0.0};
    const double travel = x - motion.position.x;
    motion.position = {x, 0.0};
    proxy = haptics::move_proxy(gate, passage, proxy, motion.position, 1e-3);
    const bool observes = method.hold == haptics::ContactHold::observer;
    const haptics::ContactForce contact =
        observes ? haptics::contact_force(coupling, gate, passage, proxy, observer.update(motion, force))
                 : haptics::contact_force(coupling, gate, passage, proxy, motion);
    force = contact.force;
    if (method.control == haptics::EnergyControl::energy_bounding) force.x = bounder.bound(force.x, last, travel);
    if (method.control == haptics::EnergyControl::passivity_controller)
      force.x = controller.control(force.x, last, travel, motion.position != proxy.position);
    last = force.x;
  }
  const double ns = static_cast<double>(ticks() - before) / ticks_per_ns() / kCycles;
  return std::isfinite(force.x) ? ns
                                : std::numeric_limits<double>::quiet_NaN();  // keeps the loop from being optimised away
}

// Cost per cycle of each method [ns]. The methods run alternately, so that a busy machine slows all of them equally.
std::vector<Timed> costs(std::span<const Method> methods, const LoopTiming& at) {
  std::vector<std::vector<double>> durations(methods.size());
  for (int round = 0; round < 21; ++round) {
    for (std::size_t m = 0; m < methods.size(); ++m) durations[m].push_back(cost_once(methods[m], at));
  }
  std::vector<Timed> ns;
  for (std::vector<double>& of_method : durations) ns.push_back(timed(of_method));
  return ns;
}

// Exact stability limit for the worst combination of hand and axis. [N/m]
double stability_limit(const Method& method, const LoopTiming& at) {
  haptics::ContactLaw law;
  law.hold = method.hold;
  law.damping = damping_of(method, at);
  law.delay = at.delay;
  double limit = 1e9;
  for (const haptics::NamedHand& named : haptics::kNamedHands)
    for (const haptics::AxisModel& axis : {haptics::kPaperAxisX, haptics::kPaperAxisY})
      limit = std::min(limit, haptics::stiffness_limit(axis, named.hand, law, 1.0 / at.rate));
  return limit;
}

ContactCase contact_of(const Method& method, const LoopTiming& at) {
  ContactCase contact;
  contact.haptics.rate = at.rate;
  contact.haptics.contact = {method.hold, method.control, false, true};
  contact.haptics.tuning.wall_stiffness = kWanted;
  contact.haptics.tuning.wall_damping = damping_of(method, at);
  contact.haptics.tuning.aisle_damping = std::min(2.0, 0.03 * at.rate / (at.delay + 1.0));
  contact.lever.delay = at.delay;
  return contact;
}

// True if the shipped default configuration uses this method at this timing and admits a wall of 5000 N/m unchanged.
bool is_default(const Method& method, const LoopTiming& at) {
  haptics::HapticConfig config;
  config.rate = at.rate;
  haptics::DeviceSpec spec;
  spec.delay = at.delay;
  const haptics::AdmittedTuning admitted = haptics::admit_tuning(config, spec, 0.0);
  return admitted.hold == method.hold && admitted.tuning.wall_damping == damping_of(method, at) &&
         admitted.tuning.wall_stiffness == kWanted && config.contact.energy_control == method.control;
}

std::string timing_label(const LoopTiming& at) {
  return std::to_string(static_cast<int>(at.rate)) + " Hz, delay " + std::to_string(at.delay);
}

BenchRow row_of(const Method& method, const LoopTiming& at, const Timed& ns, const BenchOptions& options) {
  Campaign campaign;
  campaign.contact = contact_of(method, at);
  campaign.runs = options.quick ? 3 : 100;
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  const HandOutcome& worst = worst_ripple(outcomes);
  const ImpactEnergy energy = run_impacts(contact_of(method, at), options.quick ? 5 : 100);
  const double displayed = min_displayed(outcomes);
  const RelatedFigure cycle{"cost", ns.median, "ns", ns.spread};
  BenchRow row{"methods",
               timing_label(at) + ": " + method.name,
               1e3 * worst.ripple_p95,
               "mm",
               {},
               false,
               "p95 of the final peak-to-peak motion, pushes of 4 to 30 N, worst hand: " + worst.hand,
               true,
               {{"error in displayed stiffness", 100.0 * (1.0 - displayed), "%"},
                {"mean energy per contact", 100.0 * energy.mean_fraction, "% of the impact energy"},
                {"worst energy per contact", 100.0 * energy.worst_fraction, "%"},
                cycle}};
  if (displayed >= kDisplayedOf) {
    row.trade = Trade{timing_label(at) + ": walls that display 95 % of their stiffness",
                      method.name,
                      cycle,
                      {"final peak-to-peak motion, p95", row.value, "mm"},
                      is_default(method, at)};
  }
  if (method.control == haptics::EnergyControl::none)
    row.related.push_back({"K limit", stability_limit(method, at), "N/m"});
  return row;
}

// Cost and error of a velocity window. A longer window gives a smoother but later velocity. The cost is the damping
// force caused by one encoder count. The error is the reciprocal of the largest stable stiffness.
Trade window_trade(int window, double damping, double limit) {
  const haptics::SimulatedLeverConfig lever;
  const double count = lever.yoke.radius * std::numbers::pi / 180.0 / lever.encoder_counts;  // [m] at the lever's tip
  const double tremble = damping * count / (0.001 * window);
  return {"velocity window at 1 kHz, B = " + std::to_string(static_cast<int>(damping)) + " N s/m",
          "window of " + std::to_string(window) + " ms",
          {"damping force of one encoder count", tremble, "N"},
          {"least stable compliance", 1e6 / limit, "um/N"},
          window == haptics::EstimatorConfig{}.window};
}

// Adds rows for velocity windows of several lengths. CHAI3D uses 15 ms by default, Force Dimension's DHD library 20 ms.
void add_windows(std::vector<BenchRow>& rows, const BenchOptions& options) {
  for (const int window : {1, 4, 8, 15, 20}) {
    BenchRow row{"methods",
                 "velocity over " + std::to_string(window) + " ms at 1 kHz: K limit with B = 0",
                 0.0,
                 "N/m",
                 {},
                 false,
                 "X axis without a hand; textbook spring and damper",
                 true,
                 {}};
    const double wanted = haptics::HapticTuning{}.wall_damping;
    for (const double damping : {0.0, 3.0, 5.0, 10.0, 20.0}) {
      haptics::ContactLaw law{haptics::ContactHold::zero_order, 0.0, damping, window};
      const double limit = haptics::stiffness_limit(haptics::kPaperAxisX, haptics::kBareHand, law, 0.001);
      if (damping == 0.0) row.value = limit;
      if (damping > 0.0)
        row.related.push_back({"K limit with B = " + std::to_string(static_cast<int>(damping)), limit, "N/m"});
      if (damping == wanted) row.trade = window_trade(window, damping, limit);
    }
    rows.push_back(row);
  }
  for (const auto& [window, damping] : {std::pair{15, 0.0}, {15, 10.0}, {1, 10.0}}) {
    ContactCase contact = contact_of({"", haptics::ContactHold::zero_order, damping}, {1000.0, 0});
    contact.haptics.estimator.window = window;
    contact.haptics.tuning.aisle_damping = 0.0;
    contact.lever.encoder_counts = 0.0;  // without encoder noise, only instability causes motion
    contact.duration = options.quick ? 1.2 : 3.0;
    const ContactResult one = run_contact(contact);
    rows.push_back({"methods",
                    "5000 N/m wall, velocity over " + std::to_string(window) +
                        " ms, B = " + std::to_string(static_cast<int>(damping)) + ": final peak-to-peak motion",
                    1e3 * one.ripple,
                    "mm",
                    {},
                    false,
                    "X axis without a hand, push of 20 N, no quantisation",
                    true,
                    {}});
  }
}

}  // namespace

std::vector<BenchRow> bench_methods(const BenchOptions& options) {
  const Method methods[] = {{"zero-order hold, B = 0 (textbook)", haptics::ContactHold::zero_order, 0.0},
                            {"zero-order hold, B = K T / 2, eq. (22)", haptics::ContactHold::zero_order, -1.0},
                            {"half-sample hold, B = 0", haptics::ContactHold::half_sample, 0.0},
                            {"half-sample hold, B = 10", haptics::ContactHold::half_sample, 10.0},
                            {"observer", haptics::ContactHold::observer, -1.0},
                            {"zero-order hold with passivity control", haptics::ContactHold::zero_order, 0.0,
                             haptics::EnergyControl::passivity_controller},
                            {"zero-order hold with energy bounding", haptics::ContactHold::zero_order, 0.0,
                             haptics::EnergyControl::energy_bounding},
                            {"half-sample hold, B = 10, with energy bounding", haptics::ContactHold::half_sample, 10.0,
                             haptics::EnergyControl::energy_bounding}};
  const LoopTiming timings[] = {{1000, 0}, {1000, 1}, {1000, 2}, {500, 0}, {200, 0}};
  std::vector<BenchRow> rows;
  for (const LoopTiming& at : timings) {
    const std::vector<Timed> ns = costs(methods, at);
    for (std::size_t m = 0; m < std::size(methods); ++m) {
      if (options.progress) options.progress("methods", static_cast<double>(rows.size()) / 40.0);
      rows.push_back(row_of(methods[m], at, ns[m], options));
    }
  }
  add_windows(rows, options);
  return rows;
}

}  // namespace gearshift::lab
