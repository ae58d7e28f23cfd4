#include "app/lab/campaign/campaign_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/lab/campaign/campaign_car.h"
#include "app/lab/campaign/campaign_hand.h"
#include "app/lab/random_gates/random_layout.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"

namespace gearshift::lab {
namespace {

constexpr double kQuietWindow = 0.5;  // [s] duration of the measurement at the end of a hold: one period of 2 Hz

haptics::GateLayout layout_of(const CampaignCase& drawn, std::span<const haptics::GateLayout> shipped) {
  if (drawn.shipped_gate >= 0) return shipped[static_cast<std::size_t>(drawn.shipped_gate)];
  return drawn.is_wide ? random_wide_layout(drawn.seed) : random_layout(drawn.seed);
}

haptics::SimulatedRunConfig run_config(const CampaignCase& drawn, const haptics::GateLayout& layout) {
  haptics::SimulatedRunConfig config;
  config.haptics = drawn.haptics;
  config.lever = drawn.lever;
  config.gate =
      haptics::compile_gate(layout, haptics::workspace_half_extent(drawn.lever.yoke), drawn.lever.yoke.radius);
  config.start = haptics::rest_position(config.gate, haptics::kNeutralGear);
  return config;
}

// True if the hand must reach every gear at which it aims cleanly. Other hands may oscillate or be too weak for the
// gate, and a car's synchroniser can be stronger than the hand.
bool can_shift(const CampaignCase& drawn) {
  return drawn.hand == CaseHand::grip && !drawn.has_car;
}

// True if the stability check guarantees a lever without vibration and guard faults. The guarantee excludes the hands
// `heavy` and `stiff`, plant errors above 5 %, and jitter above 10 %. It also excludes energy bounding, with which a
// wall is passive but may still vibrate.
bool is_promised(const CampaignCase& drawn) {
  const bool is_listed = drawn.hand != CaseHand::heavy && drawn.hand != CaseHand::stiff;
  const bool is_bounded = drawn.haptics.contact.energy_control == haptics::EnergyControl::energy_bounding;
  return drawn.lever.model_error <= 0.05 && drawn.lever.period_jitter <= 0.1 && is_listed && !is_bounded;
}

// True if this gear has a lockout that opens only after the lever has left another gear's column. A hand may return
// before the lagging lever has left that column. The lockout is then rightly closed.
bool has_detour(const haptics::Gate& gate, int gear) {
  return std::any_of(
      haptics::lockouts(gate).begin(), haptics::lockouts(gate).end(), [&](const haptics::Lockout& lockout) {
        return lockout.kind == haptics::LockoutKind::after_gear && haptics::slot_of(gate, lockout.slot).gear == gear;
      });
}

std::unique_ptr<haptics::LeverLoad> make_load(const CampaignCase& drawn, const haptics::Gate& gate) {
  if (!drawn.has_car) return std::make_unique<haptics::NoLoad>();
  return std::make_unique<vehicle::CarLoad>(random_car(drawn.seed), gate, drawn.lever.actuator.peak_force,
                                            random_start(drawn.seed), drawn.seed);
}

class CaseRun {
 public:
  CaseRun(const CampaignCase& drawn, const haptics::GateLayout& layout)
      : drawn_(drawn),
        layout_(layout),
        config_(run_config(drawn, layout)),
        script_(make_script(config_.gate, drawn, config_.start)),
        hand_(drawn, script_, config_.start),
        feet_(drawn.seed),
        load_(make_load(drawn, config_.gate)),
        run_(config_, hand_, load_.get()),
        limits_(law_limits(drawn.haptics, drawn.lever, run_.lever().spec())) {
    out.number = drawn.number;
    out.promised = is_promised(drawn);
    out.stiffness = run_.loop().admitted().tuning.wall_stiffness;
    out.limited = static_cast<int>(run_.loop().admitted().limits.size());
  }

  void plant(const PlantedLimits& planted) { planted(limits_); }

  void drive(haptics::TraceRecorder* recorder) {
    haptics::HapticSnapshot before = step(recorder);
    true_position_ = run_.lever().true_position();
    const double max_cycles =
        1.0 + 2.0 * hand_.duration() / run_.period();  // a period lasts at least half its nominal duration
    while (hand_.time() < hand_.duration()) {
      if (drawn_.has_car) run_.inputs().controls.write(feet_.at(run_.time()));
      const haptics::HapticSnapshot& now = step(recorder);
      if (static_cast<double>(now.cycle) > max_cycles)
        throw std::runtime_error(fmt::format("case {} did not finish in time", out.number));
      check_cycle({now, before, hand_.last().pressed_down, hand_.last().lifted});
      before = now;
    }
    out.cycles = before.cycle + 1;
    out.seconds = run_.time();
  }

  haptics::TraceHeader header() {
    return {"gearshift campaign",
            drawn_.haptics,
            run_.lever().spec(),
            layout_.file,
            layout_.text,
            load_->replay_parameters(),
            true};
  }

  CaseOutcome out;

 private:
  void check_cycle(const CyclePair& cycle) {
    const haptics::Gate& gate = config_.gate;
    finite_law(cycle, out.laws);
    free_space_law(cycle, gate, out.laws);
    is_plausible_ =
        is_plausible_ && glm::length(run_.lever().true_velocity()) < 0.9 * drawn_.haptics.estimator.speed_limit;
    const bool is_proxy_reset = !is_plausible_ || out.stopped > 0;  // after rearming, the proxy restarts at the lever
    if (!is_proxy_reset) no_wall_law(cycle, gate, limits_, out.laws);
    if (!is_proxy_reset) lockouts_.update(cycle, gate, out.laws);
    force_law(cycle, limits_, out.laws);
    slew_law(cycle, limits_, out.laws);
    check_guard(cycle);
    // Not checked once a speed was implausible: the estimator drops such readings, so energy bounding cannot see all of
    // the lever's travel.
    if (is_plausible_) energy_.update(cycle, run_.lever().true_position() - true_position_, limits_, out.laws);
    true_position_ = run_.lever().true_position();
    const bool is_in_or_out = is_held_still() && !drawn_.has_car;  // a car's synchroniser may delay the gear
    if (!is_proxy_reset) gears_.update(cycle, gate, is_in_or_out, out.laws);
    check_hold(cycle.now);
    check_shift(cycle.now);
    out.fastest = std::max(out.fastest, glm::length(run_.lever().true_velocity()));
  }

  void check_guard(const CyclePair& cycle) {
    const bool fell = cycle.now.fault != haptics::GuardFault::none && cycle.before.fault == haptics::GuardFault::none;
    out.stopped += fell;
    if (is_plausible_ && out.promised) guard_law(cycle, out.laws);
  }

  bool is_held_still() const {
    return hold_ < script_.holds.size() && hand_.time() >= script_.holds[hold_].begin + limits_.settle_time;
  }

  void check_hold(const haptics::HapticSnapshot& now) {
    if (hold_ >= script_.holds.size()) return;
    const Hold& hold = script_.holds[hold_];
    was_overheated_ = was_overheated_ || is_overheated(now);
    if (hand_.time() >= hold.end) {
      out.ripple = std::max(out.ripple, was_overheated_ ? 0.0 : quiet_.span());
      const bool is_shaken = drawn_.has_car;  // a stalling engine vibrates the lever on purpose
      if (!was_overheated_ && !is_shaken && is_plausible_ && out.promised)
        quiet_law(quiet_.span(), limits_, run_.time(), out.laws);
      if (!was_overheated_ && !is_shaken && is_plausible_ && out.stopped == 0)
        fades_law(before_.span(), quiet_.span(), limits_, run_.time(), out.laws);
      quiet_ = before_ = {};
      was_overheated_ = false;
      ++hold_;
    } else if (hand_.time() >= hold.end - kQuietWindow) {
      quiet_.update(run_.lever().true_position());
    } else if (hand_.time() >= hold.end - 2.0 * kFading && hand_.time() < hold.end - kFading) {
      before_.update(run_.lever().true_position());
    }
  }

  // An overheated motor yields, so a wall may vibrate. The loop reports an overheated motor as saturated.
  bool is_overheated(const haptics::HapticSnapshot& now) const {
    return drawn_.lever.actuator.overload_time < 100.0 && (now.flags & haptics::kFlagSaturated) != 0;
  }

  // Counts a shift that is over. If the shift was clean, its gear must be engaged. A shift is clean only if the
  // previous gear was reached, because otherwise it does not start as planned.
  void check_shift(const haptics::HapticSnapshot& now) {
    const std::size_t done = static_cast<std::size_t>(out.shifts);
    if (done >= script_.shifts.size() || hand_.time() < script_.shifts[done].end) return;
    const TriedShift& shift = script_.shifts[done];
    const bool is_reached = now.gear == shift.gear;
    const bool is_clean =
        shift.clean && was_previous_reached_ && can_shift(drawn_) && !has_detour(config_.gate, shift.gear);
    if (is_clean) out.laws.note(CampaignLaw::reached, is_reached ? 0.0 : 1.0, 0.0, run_.time());
    ++out.shifts;
    out.clean += is_clean;
    out.reached += is_reached;
    was_previous_reached_ = is_reached;
  }

  const haptics::HapticSnapshot& step(haptics::TraceRecorder* recorder) {
    const haptics::HapticSnapshot& now = run_.step();
    if (recorder != nullptr) recorder->add(run_.loop().published());
    events_.clear();
    detector_.update(run_.loop().published(), events_);
    for (const haptics::HapticEvent& event : events_)
      out.softened += event.kind == haptics::EventKind::stiffness_lowered;
    return now;
  }

  const CampaignCase& drawn_;
  const haptics::GateLayout& layout_;
  haptics::SimulatedRunConfig config_;
  HandScript script_;
  CampaignHand hand_;
  CampaignPedals feet_;
  std::unique_ptr<haptics::LeverLoad> load_;
  haptics::SimulatedRun run_;
  haptics::EventDetector detector_;
  std::vector<haptics::HapticEvent> events_;
  LawLimits limits_;
  LockoutLaw lockouts_;
  EnergyLaw energy_;
  GearLaw gears_;
  HeldSwing quiet_, before_;  // motion at the end of a hold, and in a window that ends kFading earlier
  std::size_t hold_ = 0;
  glm::dvec2 true_position_{0.0};
  bool was_previous_reached_ = true;
  bool was_overheated_ = false;
  bool is_plausible_ = true;  // the lever was always slower than 90 % of the estimator's speed limit
};

}  // namespace

CaseOutcome run_case(const CampaignCase& drawn, std::span<const haptics::GateLayout> shipped,
                     const std::filesystem::path& trace, const PlantedLimits& planted) {
  const haptics::GateLayout layout = layout_of(drawn, shipped);
  std::optional<CaseRun> run;
  try {
    run.emplace(drawn, layout);
  } catch (const std::invalid_argument& refusal) {
    if (!is_forbidden(drawn))
      throw std::runtime_error(std::string("the loop's checks rejected a valid case: ") + refusal.what());
    CaseOutcome out;
    out.number = drawn.number;
    out.refused = refusal.what();
    std::replace(out.refused.begin(), out.refused.end(), ',', ';');  // fields of cases.csv must not contain commas
    return out;
  }
  if (is_forbidden(drawn)) throw std::runtime_error("the loop's checks accepted an invalid case");
  if (planted) run->plant(planted);
  if (trace.empty()) {
    run->drive(nullptr);
    return run->out;
  }
  haptics::TraceRecorder recorder(trace, run->header());
  run->drive(&recorder);
  const haptics::RecordingResult recorded = recorder.finish();
  if (!recorded.problem.empty()) throw std::runtime_error(trace.string() + ": " + recorded.problem);
  return run->out;
}

std::vector<haptics::GateLayout> shipped_layouts(const std::filesystem::path& folder) {
  // A case is drawn by the number of its gate in this list, so a gate added here changes every campaign.
  static constexpr const char* kNames[] = {
      "dog_leg_five", "five_speed_r_left_up",  "five_speed_r_right_down", "four_speed",
      "paper",        "six_speed_r_left_down", "six_speed_r_left_up",     "six_speed_r_right_down"};
  std::vector<haptics::GateLayout> layouts;
  for (const char* name : kNames)
    layouts.push_back(haptics::read_gearbox_layout(folder / (std::string(name) + ".toml")));
  return layouts;
}

}  // namespace gearshift::lab
