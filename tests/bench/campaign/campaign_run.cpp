#include "tests/bench/campaign/campaign_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"
#include "tests/bench/campaign/campaign_car.h"
#include "tests/bench/campaign/campaign_hand.h"
#include "tests/support/random_layout.h"

namespace gearshift {
namespace {

constexpr double kLook = 0.5;          // [s] at the end of a hold: the lever is still by then; a swing of 2 Hz is seen
constexpr double kHeldStill = 1.0;     // [s] into a hold: the gear no longer changes
constexpr std::uint64_t kPump = 4096;  // [cycles]

GateLayout layout_of(const CampaignCase& drawn, std::span<const GateLayout> shipped) {
  if (drawn.shipped_gate >= 0) return shipped[static_cast<std::size_t>(drawn.shipped_gate)];
  return drawn.is_wide ? random_wide_layout(drawn.seed) : random_layout(drawn.seed);
}

SimulatedRunConfig run_config(const CampaignCase& drawn, const GateLayout& layout) {
  SimulatedRunConfig config;
  config.haptics = drawn.haptics;
  config.lever = drawn.lever;
  config.gate = compile_gate(layout, workspace_half_extent(drawn.lever.yoke), drawn.lever.yoke.radius);
  config.start = rest_position(config.gate, kNeutralGear);
  return config;
}

// A gripping hand's clean aim: its own inertia does not ring, and it is as strong as the gate; not as a synchroniser.
bool can_shift(const CampaignCase& drawn) {
  return drawn.hand == CaseHand::grip && !drawn.has_car;
}

// Quiet, and nothing for the guard to stop, is what the loop's checks promise: of the plant error and jitter that they were
// found with, and of the listed hands: one that trembles keeps still in a hold. A bounded wall is passive, not quiet.
bool is_promised(const CampaignCase& drawn) {
  const bool is_listed = drawn.hand != CaseHand::heavy && drawn.hand != CaseHand::stiff;
  const bool is_bounded = drawn.haptics.contact.energy_control == EnergyControl::energy_bounding;
  return drawn.lever.model_error <= 0.05 && drawn.lever.period_jitter <= 0.1 && is_listed && !is_bounded;
}

// What the loop's checks must refuse, and nothing else: a study's, and a slew that they do not allow.
bool is_forbidden(const CampaignCase& drawn) {
  const HapticConfig& config = drawn.haptics;
  return config.estimator.window > 1 || config.contact.energy_control == EnergyControl::passivity_controller ||
         config.guard.slew < 2.0;
}

// A hand that lags may come back before the lever has left the column that the lockout asks for: it is shut by rights.
bool has_detour(const Gate& gate, int gear) {
  return std::any_of(lockouts(gate).begin(), lockouts(gate).end(), [&](const Lockout& lockout) {
    return lockout.kind == LockoutKind::after_gear && slot_of(gate, lockout.slot).gear == gear;
  });
}

std::unique_ptr<LeverWorld> world_of(const CampaignCase& drawn, const Gate& gate) {
  if (!drawn.has_car) return std::make_unique<NullWorld>();
  return std::make_unique<CarWorld>(random_car(drawn.seed), gate, drawn.lever.actuator.peak_force,
                                    random_start(drawn.seed), drawn.seed);
}

// One case while it runs.
class CaseRun {
 public:
  CaseRun(const CampaignCase& drawn, const GateLayout& layout)
      : drawn_(drawn),
        layout_(layout),
        config_(run_config(drawn, layout)),
        script_(make_script(config_.gate, drawn, config_.start)),
        hand_(drawn, script_, config_.start),
        feet_(drawn.seed),
        world_(world_of(drawn, config_.gate)),
        run_(config_, hand_, world_.get()),
        limits_(law_limits(drawn.haptics, drawn.lever, run_.lever().spec())) {
    out.number = drawn.number;
    out.promised = is_promised(drawn);
    out.stiffness = run_.loop().admitted().tuning.wall_stiffness;
    out.limited = static_cast<int>(run_.loop().admitted().limited.size());
  }

  void plant(const PlantedLimits& planted) { planted(limits_); }

  void drive(TraceRecorder* recorder) {
    HapticSnapshot before = run_.step();
    true_position_ = run_.lever().true_position();
    const double most = 1.0 + 2.0 * hand_.duration() / run_.period();  // a period lasts half of it at least
    while (hand_.time() < hand_.duration()) {
      if (drawn_.has_car) run_.channels().controls.write(feet_.at(run_.time()));
      const HapticSnapshot& now = run_.step();
      if (static_cast<double>(now.cycle) > most)
        throw std::runtime_error(fmt::format("case {} does not end", out.number));
      look({now, before, hand_.last().pressed_down, hand_.last().lifted});
      if (recorder && now.cycle % kPump == 0) recorder->pump();
      before = now;
    }
    count_events();
    out.cycles = before.cycle;
    out.seconds = run_.time();
    out.laws.note(CampaignLaw::told, static_cast<double>(run_.channels().events_lost), 0.0, out.seconds);
  }

  TraceHeader header() {
    return {
        "gearshift campaign", drawn_.haptics, run_.lever().spec(), layout_.file, layout_.text, world_->name(), true};
  }
  LoopChannels& channels() { return run_.channels(); }

  CaseOutcome out;

 private:
  void look(const SeenCycle& cycle) {
    const Gate& gate = config_.gate;
    finite_law(cycle, out.laws);
    free_space_law(cycle, gate, out.laws);
    is_believed_ =
        is_believed_ && glm::length(run_.lever().true_velocity()) < 0.9 * drawn_.haptics.estimator.speed_limit;
    const bool is_placed_anew = !is_believed_ || out.stopped > 0;  // armed again, the proxy begins at the lever
    if (!is_placed_anew) no_wall_law(cycle, gate, limits_, out.laws);
    if (!is_placed_anew) lockouts_.look(cycle, gate, out.laws);
    force_law(cycle, limits_, out.laws);
    slew_law(cycle, limits_, out.laws);
    look_at_guard(cycle);
    // Who does not believe a reading keeps the last one: of that travel nothing bounds the energy.
    if (is_believed_) energy_.look(cycle, run_.lever().true_position() - true_position_, limits_, out.laws);
    true_position_ = run_.lever().true_position();
    const bool is_in_or_out = is_held_still() && !drawn_.has_car;  // a synchroniser lets it in when it is due
    if (!is_placed_anew) gears_.look(cycle, gate, is_in_or_out, out.laws);
    look_at_hold(cycle.now);
    look_at_shift(cycle.now);
    if (cycle.now.cycle % events_every() == 0) count_events();
    out.fastest = std::max(out.fastest, glm::length(run_.lever().true_velocity()));
  }

  std::uint64_t events_every() const { return static_cast<std::uint64_t>(std::lround(limits_.frame / limits_.period)); }

  void look_at_guard(const SeenCycle& cycle) {
    const bool fell = cycle.now.fault != GuardFault::none && cycle.before.fault == GuardFault::none;
    out.stopped += fell;
    if (is_believed_ && out.promised) guard_law(cycle, out.laws);
  }

  bool is_held_still() const {
    return hold_ < script_.holds.size() && hand_.time() >= script_.holds[hold_].begin + kHeldStill;
  }

  void look_at_hold(const HapticSnapshot& now) {
    if (hold_ >= script_.holds.size()) return;
    const Hold& hold = script_.holds[hold_];
    may_tire_ = may_tire_ || is_tired(now);
    if (hand_.time() >= hold.end) {
      out.ripple = std::max(out.ripple, may_tire_ ? 0.0 : quiet_.span());
      const bool is_shaken = drawn_.has_car;  // an engine that dies shakes the lever on purpose
      if (!may_tire_ && !is_shaken && is_believed_ && out.promised)
        quiet_law(quiet_.span(), limits_, run_.time(), out.laws);
      if (!may_tire_ && !is_shaken && is_believed_ && out.stopped == 0)
        fades_law(before_.span(), quiet_.span(), limits_, run_.time(), out.laws);
      quiet_ = before_ = {};
      may_tire_ = false;
      ++hold_;
    } else if (hand_.time() >= hold.end - kLook) {
      quiet_.look(run_.lever().true_position());
    } else if (hand_.time() >= hold.end - 2.0 * kFading && hand_.time() < hold.end - kFading) {
      before_.look(run_.lever().true_position());
    }
  }

  // A motor that tires gives way: no wall can keep still on it. It is told as saturation.
  bool is_tired(const HapticSnapshot& now) const {
    return drawn_.lever.actuator.overload_time < 100.0 && (now.flags & kFlagSaturated) != 0;
  }

  // Clean only where the one before was reached: a lever that was left somewhere is not where this one begins.
  void look_at_shift(const HapticSnapshot& now) {
    const std::size_t done = static_cast<std::size_t>(out.shifts);
    if (done >= script_.shifts.size() || hand_.time() < script_.shifts[done].end) return;
    const TriedShift& shift = script_.shifts[done];
    const bool is_reached = now.gear == shift.gear;
    const bool is_clean = shift.clean && before_reached_ && can_shift(drawn_) && !has_detour(config_.gate, shift.gear);
    if (is_clean) out.laws.note(CampaignLaw::reached, is_reached ? 0.0 : 1.0, 0.0, run_.time());
    ++out.shifts;
    out.clean += is_clean;
    out.reached += is_reached;
    before_reached_ = is_reached;
  }

  void count_events() {
    for (HapticEvent event; run_.channels().events.pop(event);)
      out.softened += event.kind == EventKind::stiffness_lowered;
  }

  const CampaignCase& drawn_;
  const GateLayout& layout_;
  SimulatedRunConfig config_;
  HandScript script_;
  CampaignHand hand_;
  CampaignFeet feet_;
  std::unique_ptr<LeverWorld> world_;
  SimulatedRun run_;
  LawLimits limits_;
  LockoutLaw lockouts_;
  EnergyLaw energy_;
  GearLaw gears_;
  HeldSwing quiet_, before_;  // at the end of a hold; from 2 kFading to kFading before: a heavy hand's turn
  std::size_t hold_ = 0;
  glm::dvec2 true_position_{0.0};
  bool before_reached_ = true;
  bool may_tire_ = false;
  bool is_believed_ = true;  // no reading faster than what is believed yet: what no hand does is taken for a fault
};

}  // namespace

CaseOutcome run_case(const CampaignCase& drawn, std::span<const GateLayout> shipped, const std::filesystem::path& trace,
                     const PlantedLimits& planted) {
  const GateLayout layout = layout_of(drawn, shipped);
  std::optional<CaseRun> run;
  try {
    run.emplace(drawn, layout);
  } catch (const std::invalid_argument& refusal) {
    if (!is_forbidden(drawn)) throw std::runtime_error(std::string("refused without a reason: ") + refusal.what());
    CaseOutcome out;
    out.number = drawn.number;
    out.refused = refusal.what();
    std::replace(out.refused.begin(), out.refused.end(), ',', ';');  // a field of cases.csv
    return out;
  }
  if (is_forbidden(drawn)) throw std::runtime_error("admitted, though the checks forbid it");
  if (planted) run->plant(planted);
  if (trace.empty()) {
    run->drive(nullptr);
    return run->out;
  }
  TraceRecorder recorder(trace, run->header(), run->channels(), TracePump::by_caller);
  run->drive(&recorder);
  const RecordingResult recorded = recorder.finish();
  if (!recorded.problem.empty()) throw std::runtime_error(trace.string() + ": " + recorded.problem);
  return run->out;
}

std::vector<GateLayout> shipped_layouts(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<GateLayout> layouts;
  for (const std::filesystem::path& file : files) layouts.push_back(read_gate_layout(file));
  return layouts;
}

}  // namespace gearshift
