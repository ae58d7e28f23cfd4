#include "haptics/loop/preset.h"

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::haptics {
namespace {

constexpr Range kAnySeed{0.0, 9007199254740992.0};  // 2^53: every integer up to this value is exact as a double
constexpr double kMaxMass = 1e3, kMaxDamping = 1e4, kMaxStiffness = 1e6;

// Reads a key if present and otherwise keeps the default. The key is required if the default is outside the range,
// which can depend on other keys.
void read(const TomlTable& table, std::string_view key, double& value, Range range) {
  const bool possible = value >= range.min && value <= range.max;
  if (table.has(key) || !possible) value = table.number(key, range);
}

template <class Integer>
void read_integer(const TomlTable& table, std::string_view key, Integer& value, Range range) {
  const double number = table.number_or(key, static_cast<double>(value), range);
  if (number != std::floor(number)) table.fail(key, "must be a whole number");
  value = static_cast<Integer>(number);
}

void read_angle(const TomlTable& table, std::string_view key, double& radians, Range degrees) {
  if (table.has(key)) radians = table.number(key, degrees) * std::numbers::pi / 180.0;
}

template <class Value>
void read_choice(const TomlTable& table, std::string_view key, Value& value,
                 const std::vector<std::pair<std::string, Value>>& choices) {
  if (!table.has(key)) return;
  std::vector<std::string> allowed;
  allowed.reserve(choices.size());
  for (const auto& [name, choice] : choices) allowed.push_back(name);
  const std::string chosen = table.choice(key, allowed);
  for (const auto& [name, choice] : choices) {
    if (name == chosen) value = choice;
  }
}

template <class Part>
void read_part(const TomlTable& table, std::string_view key, Part& part, void (*read_it)(const TomlTable&, Part&)) {
  if (!table.has(key)) return;
  const TomlTable inner = table.table(key);
  read_it(inner, part);
  inner.reject_unknown_keys();
}

void read_yoke(const TomlTable& table, YokeGeometry& yoke) {
  read(table, "radius_m", yoke.radius, {0.01, 10.0});
  read_angle(table, "theta_limit_deg", yoke.theta_limit, {1.0, 80.0});
  read_angle(table, "phi_limit_deg", yoke.phi_limit, {1.0, 80.0});
}

void read_axis(const TomlTable& table, AxisModel& axis) {
  read(table, "mass_kg", axis.mass, {1e-3, kMaxMass});
  read(table, "damping_n_s_per_m", axis.damping, {0.0, kMaxDamping});
  read(table, "stiffness_n_per_m", axis.stiffness, {0.0, kMaxStiffness});
}

void read_sensor(const TomlTable& table, ForceSensorModel& sensor) {
  read(table, "offset", sensor.offset, {-1e9, 1e9});
  read(table, "gain_per_gw", sensor.gain, {1e-9, 1e9});
  read(table, "resolution_gw", sensor.resolution_gw, {0.0, 1e6});
  read(table, "range_gw", sensor.range_gw, {1e-3, 1e9});
  read(table, "noise_gw", sensor.noise_gw, {0.0, 1e6});
}

void read_actuator(const TomlTable& table, ActuatorLimits& actuator) {
  read(table, "peak_force_n", actuator.peak_force, {0.0, 1e4});
  read(table, "continuous_force_n", actuator.continuous_force, {0.0, actuator.peak_force});
  read(table, "overload_time_s", actuator.overload_time, {0.0, 1e4});
}

void read_encoder(const TomlTable& table, double& counts) {
  constexpr std::string_view kKey = "encoder_counts_per_deg";
  read(table, kKey, counts, {0.0, 1e6});
  if (counts > 0.0 && counts < 1.0) table.fail(kKey, "must be 0 (no encoder) or at least 1");
}

void read_hand(const TomlTable& table, HandImpedance& hand) {
  if (!table.has("hand")) return;
  const std::optional<HandImpedance> named = parse_hand(table.text("hand"));
  const bool possible =
      named && named->mass <= kMaxMass && named->damping <= kMaxDamping && named->stiffness <= kMaxStiffness;
  if (!possible) {
    table.fail("hand", "must be bare, light, grip, arm or \"M,B,K\" up to 1000 kg, 10000 N s/m and 1000000 N/m");
  }
  hand = *named;
}

void read_lever(const TomlTable& table, SimulatedLeverConfig& lever) {
  read_encoder(table, lever.encoder_counts);
  read_actuator(table, lever.actuator);
  read(table, "coulomb_friction_n", lever.coulomb_friction, {0.0, 1e3});
  read_integer(table, "delay_cycles", lever.delay, {0.0, kMaxSimulatedDelay});
  read(table, "own_wall_stiffness_n_per_m", lever.device_wall_stiffness, {0.0, 1e5});
  read_hand(table, lever.hand);
  read(table, "model_error", lever.model_error, {0.0, 0.5});
  read(table, "period_jitter", lever.period_jitter, {0.0, 0.5});
  read_integer(table, "seed", lever.seed, kAnySeed);
  read_part(table, "yoke", lever.yoke, read_yoke);
  read_part(table, "axis_x", lever.axis_x, read_axis);
  read_part(table, "axis_y", lever.axis_y, read_axis);
  read_part(table, "force_sensor", lever.force_sensor, read_sensor);
}

void read_loop(const TomlTable& table, HapticConfig& haptics) {
  read(table, "rate_hz", haptics.rate, {100.0, 4000.0});
  read(table, "gear_debounce_s", haptics.gear_debounce, {0.0, 0.5});
  read(table, "ghost_offset_m", haptics.ghost_offset, {0.0, 1.0});
}

void read_tuning(const TomlTable& table, HapticTuning& tuning) {
  read(table, "wall_stiffness_n_per_m", tuning.wall_stiffness, {0.0, 20000.0});
  read(table, "wall_damping_n_s_per_m", tuning.wall_damping, {0.0, 100.0});
  read(table, "feel_scale", tuning.feel_scale, {0.0, 4.0});
  read(table, "aisle_damping_n_s_per_m", tuning.aisle_damping, {0.0, 50.0});
  read(table, "speed_limit_m_per_s", tuning.speed_limit, {0.05, 5.0});
  read(table, "limit_damping_n_s_per_m", tuning.limit_damping, {0.0, 50.0});
}

void read_contact(const TomlTable& table, ContactConfig& contact) {
  read_choice<ContactHold>(table, "hold", contact.hold,
                           {{"automatic", ContactHold::automatic},
                            {"zero_order", ContactHold::zero_order},
                            {"half_sample", ContactHold::half_sample},
                            {"observer", ContactHold::observer}});
  read_choice<EnergyControl>(table, "energy_control", contact.energy_control,
                             {{"none", EnergyControl::none},
                              {"energy_bounding", EnergyControl::energy_bounding},
                              {"passivity_controller", EnergyControl::passivity_controller}});
  contact.reversal_limiter = table.flag_or("reversal_limiter", contact.reversal_limiter);
  contact.allow_unstable = table.flag_or("study", contact.allow_unstable);
}

void read_estimator(const TomlTable& table, EstimatorConfig& estimator) {
  read(table, "smoothing_s", estimator.smoothing, {1e-5, 1.0});
  read(table, "speed_limit_m_per_s", estimator.speed_limit, {0.1, 1000.0});
  read_integer(table, "window_samples", estimator.window, {1.0, 64.0});
}

void read_guard(const TomlTable& table, GuardConfig& guard) {
  read(table, "slew_n_per_cycle", guard.slew, {2.0, 100.0});
  read(table, "ramp_time_s", guard.ramp_time, {0.001, 60.0});
  read(table, "stale_time_s", guard.stale_time, {0.001, 1.0});
  read(table, "fade_time_s", guard.fade_time, {0.001, 1.0});
  read_integer(table, "overruns_in_row", guard.overruns_in_row, {1.0, 1000.0});
  read(table, "damped_damping_n_s_per_m", guard.damped_damping, {0.0, 50.0});
  read(table, "position_margin_m", guard.position_margin, {0.0, 1.0});
}

void read_over_push(const TomlTable& table, OverPushConfig& over_push) {
  read(table, "warn_above_n", over_push.warn_above, {1.0, 1000.0});
  read(table, "clear_below_n", over_push.clear_below, {0.0, over_push.warn_above});
}

}  // namespace

Preset read_preset(const std::string& file) {
  const TomlTable root = TomlTable::parse(read_text_file(file), file);
  Preset preset;
  preset.name = root.text("name");
  read_part(root, "lever", preset.lever, read_lever);
  read_part(root, "loop", preset.haptics, read_loop);
  read_part(root, "tuning", preset.haptics.tuning, read_tuning);
  read_part(root, "contact", preset.haptics.contact, read_contact);
  read_part(root, "estimator", preset.haptics.estimator, read_estimator);
  read_part(root, "guard", preset.haptics.guard, read_guard);
  read_part(root, "over_push", preset.haptics.over_push, read_over_push);
  root.reject_unknown_keys();
  return preset;
}

}  // namespace gearshift::haptics
