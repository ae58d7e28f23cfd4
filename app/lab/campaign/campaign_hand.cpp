#include "app/lab/campaign/campaign_hand.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

#include "haptics/loop/shift_script.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kHold = 3.0;                              // [s] duration of each hold
constexpr double kSpringPatience = 0.15;                   // [s] extra time in neutral per unit of feel_scale above 1
constexpr std::uint64_t kScriptSeed = 0xd1b54a32d192ed03;  // makes the hand's draws independent of the case's draws

// Builds the hand's script stroke by stroke.
class ScriptWriter {
 public:
  ScriptWriter(const haptics::Gate& gate, const CampaignCase& drawn, dvec2 start)
      : gate_(gate), drawn_(drawn), at_(start), random_(drawn.seed ^ kScriptSeed) {}

  double between(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random_() >> 11);
  }
  bool happens(double probability) { return between(0.0, 1.0) < probability; }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }

  void add(haptics::HandStroke stroke) {
    script.strokes.push_back(stroke);
    time_ += stroke.duration + stroke.dwell;
    at_ = stroke.to;
  }
  void move_to(dvec2 to, double dwell) {
    const double distance = std::hypot(to.x - at_.x, to.y - at_.y);
    add({to, 0.05 + distance / drawn_.manner.pace, dwell});
  }
  void push(dvec2 force, double time) { add({at_, 0.1, time, force}); }
  void hold(dvec2 force) {
    const double begin = time_;
    push(force, kHold);
    script.holds.push_back({begin, time_});
  }

  // Aims at a random point or at a random slot, which may have a lockout. Then returns along the neutral aisle.
  void aim_wrongly() {
    const dvec2 home = at_;
    dvec2 aim{home.x + between(-0.03, 0.03), between(-0.05, 0.05)};
    if (happens(0.5)) {
      const haptics::Slot& slot =
          haptics::slot_of(gate_, static_cast<int>(below(static_cast<std::size_t>(gate_.slot_count))));
      aim = {haptics::column_of(gate_, slot.column).center, static_cast<int>(slot.side) * slot.end};
    }
    if (happens(0.5)) move_to({aim.x, 0.0}, 0.02);
    move_to(aim, 0.15);
    move_to({aim.x, 0.0}, 0.05);
    move_to(home, 0.05);
  }

  void push_sideways() {
    const double side = happens(0.5) ? 1.0 : -1.0;
    push({side * between(1.0, drawn_.manner.hardest_push), 0.0}, 0.25);
    push({0.0, 0.0}, 0.1);
  }

  void overshoot_and_return(haptics::HandStroke stroke) {
    haptics::HandStroke back = stroke;
    stroke.to.y += std::copysign(drawn_.manner.overshoot, stroke.to.y);
    stroke.dwell = 0.02;
    back.duration = 0.15;
    add(stroke);
    add(back);
  }

  double now() const { return time_; }
  dvec2 at() const { return at_; }

  HandScript script;

 private:
  const haptics::Gate& gate_;
  const CampaignCase& drawn_;
  dvec2 at_;
  double time_ = 0.0;  // [s]
  std::mt19937_64 random_;
};

std::vector<int> drawn_gears(ScriptWriter& writer, const haptics::Gate& gate, int count) {
  std::vector<int> gears;
  while (static_cast<int>(gears.size()) < count) {
    const int gear =
        haptics::slot_of(gate, static_cast<int>(writer.below(static_cast<std::size_t>(gate.slot_count)))).gear;
    if (gears.empty() || gears.back() != gear) gears.push_back(gear);
  }
  return gears;
}

// Writes the script for a lever without a hand: random pushes with pauses, then a constant push, then no force.
void write_kicks(ScriptWriter& writer, const CampaignCase& drawn) {
  for (int i = 0; i < 20; ++i) {
    const double angle = writer.between(0.0, 2.0 * std::numbers::pi);
    const double force = writer.between(1.0, drawn.manner.hardest_push);
    writer.push(force * dvec2{std::cos(angle), std::sin(angle)}, writer.between(0.0, 0.3));
    writer.push({0.0, 0.0}, writer.between(0.1, 0.6));
  }
  const double angle = drawn.manner.leans_aside ? 0.0 : 0.5 * std::numbers::pi;
  writer.hold(drawn.manner.last_push * dvec2{std::cos(angle), std::sin(angle)});
  writer.hold({0.0, 0.0});
}

void write_shifts(ScriptWriter& writer, const haptics::Gate& gate, const CampaignCase& drawn, dvec2 start) {
  const std::vector<int> gears = drawn_gears(writer, gate, drawn.shifts);
  haptics::ShiftStyle style;
  style.pace = drawn.manner.pace;
  style.dwell_gear = 0.3 + drawn.haptics.gear_debounce;
  // A stronger feel needs a longer stop in neutral, so that the hand's force can grow above the aisle's spring force
  // before the hand enters a slot.
  style.dwell_neutral += kSpringPatience * std::max(0.0, drawn.haptics.tuning.feel_scale - 1.0);
  bool clean = drawn.manner.aim_noise == 0.0 && drawn.manner.overshoot == 0.0;
  const bool is_steady = clean;
  for (const haptics::HandStroke& stroke : haptics::shift_strokes(gate, start, gears, style)) {
    if (stroke.dwell != style.dwell_gear) {
      writer.add(stroke);
      if (!writer.happens(drawn.manner.wrong_aims)) continue;
      writer.aim_wrongly();
      clean = false;
      continue;
    }
    if (drawn.manner.overshoot > 0.0)
      writer.overshoot_and_return(stroke);
    else
      writer.add(stroke);
    const int gear = gears[writer.script.shifts.size()];
    writer.script.shifts.push_back({gear, writer.now(), clean});
    clean = is_steady;
    if (writer.happens(drawn.manner.side_pushes)) writer.push_sideways();
    if (static_cast<int>(writer.script.shifts.size()) == drawn.shifts / 2) writer.hold({0.0, 0.0});
  }
  const double side = writer.at().y > 0.0 ? 1.0 : -1.0;
  writer.hold(drawn.manner.leans_aside ? dvec2{drawn.manner.last_push, 0.0}
                                       : dvec2{0.0, side * drawn.manner.last_push});
}

// Raises the hand's `effort_limit` to what feel and damping require. Keeps `effort_gain`: the hand would oscillate with
// a gain above b * k / m (b, k, m: damping, stiffness and mass of the hand).
haptics::ScriptedHandConfig hand_config(const CampaignCase& drawn, dvec2 start) {
  if (drawn.hand == CaseHand::bare) return {start};
  haptics::ScriptedHandConfig hand = haptics::touring_hand(start);
  const haptics::HapticTuning& tuning = drawn.haptics.tuning;
  hand.effort_limit = hand.effort_limit * std::max(1.0, tuning.feel_scale) +
                      2.0 * drawn.manner.pace * (tuning.aisle_damping + tuning.limit_damping);
  hand.aim_noise = drawn.manner.aim_noise;
  hand.seed = drawn.seed;
  return hand;
}

}  // namespace

HandScript make_script(const haptics::Gate& gate, const CampaignCase& drawn, dvec2 start) {
  ScriptWriter writer(gate, drawn, start);
  if (drawn.hand == CaseHand::bare)
    write_kicks(writer, drawn);
  else
    write_shifts(writer, gate, drawn, start);
  return std::move(writer.script);
}

CampaignHand::CampaignHand(const CampaignCase& drawn, const HandScript& script, dvec2 start)
    : script_(script),
      manner_(drawn.manner),
      script_hand_(hand_config(drawn, start), script.strokes, haptics::period_s(drawn.haptics)) {}

haptics::HandTarget CampaignHand::next(double time, dvec2 lever) noexcept {
  time_ = time;
  const Hold* hold = hold_at(time);
  const bool is_still = hold != nullptr && time >= hold->begin + kSettling;
  if (is_still && is_still_) return last_;
  is_still_ = is_still;
  last_ = script_hand_.next(time, lever);
  if (!is_still && manner_.tremor > 0.0) {
    const double phase = 2.0 * std::numbers::pi * manner_.tremor_rate * time;
    last_.push += manner_.tremor * dvec2{std::sin(phase), std::cos(phase)};
  }
  return last_;
}

const Hold* CampaignHand::hold_at(double time) noexcept {
  while (hold_ < script_.holds.size() && time >= script_.holds[hold_].end) ++hold_;
  const bool is_in = hold_ < script_.holds.size() && time >= script_.holds[hold_].begin;
  return is_in ? &script_.holds[hold_] : nullptr;
}

}  // namespace gearshift::lab
