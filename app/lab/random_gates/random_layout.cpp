// Generates layouts by the rules of the gate compiler. The rules are repeated here on purpose, so that tests can check
// that the compiler accepts every generated layout. Units: 0.1 mm and 0.1 N.
#include "app/lab/random_gates/random_layout.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "haptics/files/file_error.h"
#include "haptics/files/toml_text.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::lab {
namespace {

constexpr double kRadius = 1200.0;        // [0.1 mm] radius of the yoke
constexpr double kHalfX = 771.3;          // [0.1 mm] largest x: 120 mm sin(40 deg)
constexpr double kHalfY = 688.2;          // [0.1 mm] largest y: 120 mm sin(35 deg)
constexpr int kMargin = 70;               // [0.1 mm] space behind the walls
constexpr int kMaxSlotLength = 600;       // [0.1 mm] in longer slots, two columns may not fit
constexpr int kWall = 20;                 // [0.1 mm] minimum width of the wall between two mouths
constexpr double kMaxStiffness = 4000.0;  // [N/m] maximum stiffness

// Random draws that are equal on every machine. Uses only the standardised random engine, because the distributions of
// the standard library are not standardised.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  int between(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool coin() { return between(0, 1) == 1; }

 private:
  std::mt19937_64 engine_;
};

std::string tenths(int value) {
  const std::string digits = std::to_string(std::abs(value) / 10) + "." + std::to_string(std::abs(value) % 10);
  return value < 0 ? "-" + digits : digits;
}

std::string entry(const std::string& key, const std::string& value) {
  return key + " = " + value + "\n";
}

struct Plan {
  int aisle, slot_width, chamfer, slot_length;           // [0.1 mm]
  int center, aisle_force, mouth, detent, lock, buffer;  // [0.1 N]
  std::vector<int> position;                             // [0.1 mm]
  std::vector<std::string> forward, back;                // names of the gears; "": no gear
  std::size_t neutral = 0;
};

void plan_sizes(Dice& dice, Plan& plan) {
  plan.aisle = dice.between(80, 140);
  plan.slot_width = dice.between(60, 100);
  plan.chamfer = dice.coin() ? dice.between(1, 40) : dice.between(0, 40);
  // The gate compiler requires a centring force of at least 0.5 N plus 1.2 times the force of the handle's spring (14.8
  // N/m). If the neutral column is at most 65 mm from the centre, this is at most 1.7 N.
  plan.center = dice.between(17, 50);
  plan.aisle_force = dice.between(2, 20);
  plan.mouth = dice.between(10, 50);
  plan.detent = dice.between(10, 70);
  plan.lock = dice.between(40, 140);
  // The sideways pull of a buffer must stay below the centring force. `pull` is its largest value, divided by the
  // buffer's force: 3/2 x 16/15 x (half the aisle) / (0.8 x slot width).
  const double pull = 1.5 * (16.0 / 15.0) * (0.5 * plan.aisle) / (0.8 * plan.slot_width);
  plan.buffer = dice.between(0, static_cast<int>(0.95 * plan.center / pull));
}

// Draws each size and force from its whole allowed range. The combination may be invalid.
void plan_wide_sizes(Dice& dice, Plan& plan) {
  plan.aisle = dice.between(40, 400);
  plan.slot_width = dice.between(40, 300);
  plan.chamfer = dice.between(0, 100);
  plan.center = dice.between(5, 100);
  plan.aisle_force = dice.between(0, 50);
  plan.mouth = dice.between(0, 150);
  plan.detent = dice.between(0, 200);
  plan.lock = dice.between(10, 250);
  plan.buffer = dice.between(0, 100);
}

// Chooses a slot length at which no force is steeper than kMaxStiffness. A smooth step of height F over length l has a
// maximum slope of 1.5 F/l. Lengths of the steps, as fractions of the slot: bump 0.14, rise of the detent 0.14, rise of
// the lock 0.24, fall of the lock 0.20.
void plan_length(Dice& dice, Plan& plan) {
  const auto need = [](int tenths_of_newton, double fraction) {
    return 1.5 * 0.1 * tenths_of_newton / fraction / kMaxStiffness * 1e4;  // [0.1 mm]
  };
  const double slot = std::max({100.0, need(std::max(plan.mouth, plan.aisle_force), 0.14), need(plan.detent, 0.14),
                                need(plan.detent + plan.lock, 0.24), need(plan.lock, 0.20)});
  const int mouth = (plan.aisle + 1) / 2 + plan.chamfer;
  const int min_length = mouth + static_cast<int>(std::ceil(slot)) + 1;
  plan.slot_length = dice.between(std::min(min_length, kMaxSlotLength), kMaxSlotLength);
}

// Returns the largest sideways position of a slot wall at which the lever can still reach the corner of the slot, with
// kMargin to spare. The stops of the joints theta and phi are two ellipses in the gate plane: (x / kHalfX)^2 + (y /
// kRadius)^2 = 1 and (x / kRadius)^2 + (y / kHalfY)^2 = 1.
int max_lateral_position(int slot_length) {
  const auto side = [y = slot_length + kMargin](double half_x, double half_y) {
    return half_x * std::sqrt(1.0 - (y / half_y) * (y / half_y));
  };
  return static_cast<int>(std::min(side(kHalfX, kRadius), side(kRadius, kHalfY))) - kMargin;
}

// Draws the number and the positions of the columns. Returns false if two columns do not fit.
bool plan_positions(Dice& dice, Plan& plan) {
  const int min_pitch = plan.slot_width + 2 * plan.chamfer + kWall;
  const int reach = max_lateral_position(plan.slot_length);
  const int span = 2 * reach - plan.slot_width - 1;
  if (span < min_pitch) return false;
  const int count = dice.between(2, std::min(5, span / min_pitch + 1));
  int spare = span - (count - 1) * min_pitch;
  std::vector<int> gaps;
  for (int i = 1; i < count; ++i) {
    const int extra = dice.between(0, spare / 2);
    spare -= extra;
    gaps.push_back(min_pitch + extra);
  }
  int x = -reach + plan.slot_width / 2 + 1 + dice.between(0, spare);
  plan.position.push_back(x);
  for (const int gap : gaps) plan.position.push_back(x += gap);
  plan.neutral = static_cast<std::size_t>(dice.between(0, count - 1));
  return true;
}

void plan_gears(Dice& dice, Plan& plan) {
  const std::size_t columns = plan.position.size();
  plan.forward.assign(columns, "");
  plan.back.assign(columns, "");
  std::vector<std::string*> slots;
  for (std::size_t i = 0; i < columns; ++i) {
    const int kind = dice.between(0, 3);  // 0: forward only, 1: back only, 2 or 3: both
    if (kind != 1) slots.push_back(&plan.forward[i]);
    if (kind != 0) slots.push_back(&plan.back[i]);
  }
  for (std::size_t i = slots.size(); i > 1; --i) {
    std::swap(slots[i - 1], slots[static_cast<std::size_t>(dice.between(0, static_cast<int>(i) - 1))]);
  }
  const bool reverse = slots.size() > 9 || dice.coin();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    *slots[i] = reverse && i + 1 == slots.size() ? "R" : std::to_string(i + 1);
  }
}

std::string sizes_text(const Plan& plan) {
  return "[gate]\n" + entry("aisle_width_mm", tenths(plan.aisle)) + entry("slot_width_mm", tenths(plan.slot_width)) +
         entry("slot_length_mm", tenths(plan.slot_length)) + entry("chamfer_mm", tenths(plan.chamfer)) + "\n[feel]\n" +
         entry("center_force_n", tenths(plan.center)) + entry("aisle_force_n", tenths(plan.aisle_force)) +
         entry("mouth_force_n", tenths(plan.mouth)) + entry("detent_force_n", tenths(plan.detent)) +
         entry("lock_force_n", tenths(plan.lock)) + entry("buffer_force_n", tenths(plan.buffer));
}

std::string column_text(Dice& dice, const Plan& plan, std::size_t i) {
  std::string text = "\n[[column]]\n" + entry("position_mm", tenths(plan.position[i]));
  if (!plan.forward[i].empty()) text += entry("forward", haptics::toml_string(plan.forward[i]));
  if (!plan.back[i].empty()) text += entry("back", haptics::toml_string(plan.back[i]));
  const bool at_end = i == 0 || i + 1 == plan.position.size();
  if (at_end && i != plan.neutral && dice.coin()) text += entry("junction", haptics::toml_string("closed"));
  if (i == plan.neutral) text += entry("neutral", "true");
  return text;
}

std::string lockouts_text(Dice& dice, const Plan& plan) {
  std::string text;
  for (std::size_t i = 0; i < plan.position.size(); ++i) {
    for (const auto& [gear, other] :
         {std::pair{plan.forward[i], plan.back[i]}, std::pair{plan.back[i], plan.forward[i]}}) {
      if (gear.empty() || dice.between(0, 3) != 0) continue;
      const int kind = dice.between(0, other.empty() ? 2 : 3);
      text += "\n[[lockout]]\n" + entry("gear", haptics::toml_string(gear));
      if (kind == 0) text += entry("kind", haptics::toml_string("push_down"));
      if (kind == 1) text += entry("kind", haptics::toml_string("lift"));
      if (kind == 2)
        text += entry("kind", haptics::toml_string("speed")) +
                entry("close_above_kmh", std::to_string(dice.between(16, 40)));
      if (kind == 3)
        text += entry("kind", haptics::toml_string("after_gear")) + entry("after", haptics::toml_string(other));
    }
  }
  return text;
}

// Draws the parameters other than sizes and forces. Returns the text of the layout file; empty if two columns do not
// fit.
std::string layout_text(Dice& dice, Plan& plan, std::uint64_t seed) {
  plan_length(dice, plan);
  if (!plan_positions(dice, plan)) return {};
  plan_gears(dice, plan);
  std::string text =
      entry("name", haptics::toml_string("Random gate " + std::to_string(seed))) + "\n" + sizes_text(plan);
  for (std::size_t i = 0; i < plan.position.size(); ++i) text += column_text(dice, plan, i);
  return text + lockouts_text(dice, plan);
}

std::optional<haptics::GateLayout> accepted(const std::string& text, const std::string& file) {
  constexpr haptics::YokeGeometry kYoke;
  try {
    haptics::GateLayout layout = haptics::parse_gate_layout(text, file);
    (void)haptics::compile_gate(layout, haptics::workspace_half_extent(kYoke), kYoke.radius);
    return layout;
  } catch (const haptics::FileError&) {
    return std::nullopt;
  }
}

std::string file_of(std::uint64_t seed) {
  return "random_" + std::to_string(seed) + ".toml";
}

}  // namespace

std::string random_layout_text(std::uint64_t seed) {
  Dice dice(seed);
  Plan plan;
  plan_sizes(dice, plan);
  return layout_text(dice, plan, seed);
}

haptics::GateLayout random_layout(std::uint64_t seed) {
  return haptics::parse_gate_layout(random_layout_text(seed), file_of(seed));
}

haptics::GateLayout random_wide_layout(std::uint64_t seed) {
  Dice dice(~seed);
  for (;;) {
    Plan plan;
    plan_wide_sizes(dice, plan);
    const std::string text = layout_text(dice, plan, seed);
    if (std::optional<haptics::GateLayout> layout = accepted(text, file_of(seed))) return *layout;
  }
}

}  // namespace gearshift::lab
