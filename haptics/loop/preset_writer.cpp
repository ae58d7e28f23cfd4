#include "haptics/loop/preset_writer.h"

#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "haptics/files/toml_text.h"
#include "haptics/files/verified_file.h"

namespace gearshift::haptics {
namespace {

// Returns the number of degrees that read_preset() converts to exactly this angle, or the nearest number if there is
// none.
double degrees_of(double radians) {
  const double nearest = radians * 180.0 / std::numbers::pi;
  for (const double candidate : {nearest, std::nextafter(nearest, 0.0), std::nextafter(nearest, HUGE_VAL)})
    if (candidate * std::numbers::pi / 180.0 == radians) return candidate;
  return nearest;
}

class TomlText {
 public:
  void section(std::string_view name) { text_ += "\n[" + std::string(name) + "]\n"; }
  void put(std::string_view key, const std::string& text) { line(key, toml_string(text)); }
  void put(std::string_view key, bool flag) { line(key, flag ? "true" : "false"); }
  void put(std::string_view key, double number) { line(key, toml_number(number)); }
  void put(std::string_view key, std::integral auto number) { line(key, toml_number(number)); }
  std::string take() { return std::move(text_); }

 private:
  void line(std::string_view key, const std::string& value) { text_ += std::string(key) + " = " + value + '\n'; }

  std::string text_;
};

std::string hand_text(const HandImpedance& hand) {
  for (const auto& [name, named] : kNamedHands)
    if (named.mass == hand.mass && named.damping == hand.damping && named.stiffness == hand.stiffness)
      return std::string(name);
  return toml_number(hand.mass) + ',' + toml_number(hand.damping) + ',' + toml_number(hand.stiffness);
}

std::string key_of(EnergyControl control) {
  switch (control) {
    case EnergyControl::none:
      return "none";
    case EnergyControl::energy_bounding:
      return "energy_bounding";
    case EnergyControl::passivity_controller:
      break;
  }
  return "passivity_controller";
}

void put_axis(TomlText& out, std::string_view section, const AxisModel& axis) {
  out.section(section);
  out.put("mass_kg", axis.mass);
  out.put("damping_n_s_per_m", axis.damping);
  out.put("stiffness_n_per_m", axis.stiffness);
}

void put_lever(TomlText& out, const SimulatedLeverConfig& lever) {
  out.section("lever");
  out.put("encoder_counts_per_deg", lever.encoder_counts);
  out.put("peak_force_n", lever.actuator.peak_force);
  out.put("continuous_force_n", lever.actuator.continuous_force);
  out.put("overload_time_s", lever.actuator.overload_time);
  out.put("coulomb_friction_n", lever.coulomb_friction);
  out.put("delay_cycles", lever.delay);
  out.put("own_wall_stiffness_n_per_m", lever.device_wall_stiffness);
  out.put("hand", hand_text(lever.hand));
  out.put("model_error", lever.model_error);
  out.put("period_jitter", lever.period_jitter);
  out.put("seed", lever.seed);
  out.section("lever.yoke");
  out.put("radius_m", lever.yoke.radius);
  out.put("theta_limit_deg", degrees_of(lever.yoke.theta_limit));
  out.put("phi_limit_deg", degrees_of(lever.yoke.phi_limit));
  put_axis(out, "lever.axis_x", lever.axis_x);
  put_axis(out, "lever.axis_y", lever.axis_y);
  out.section("lever.force_sensor");
  out.put("offset", lever.force_sensor.offset);
  out.put("gain_per_gw", lever.force_sensor.gain);
  out.put("resolution_gw", lever.force_sensor.resolution_gw);
  out.put("range_gw", lever.force_sensor.range_gw);
  out.put("noise_gw", lever.force_sensor.noise_gw);
}

void put_tuning(TomlText& out, const HapticTuning& tuning) {
  out.section("tuning");
  out.put("wall_stiffness_n_per_m", tuning.wall_stiffness);
  out.put("wall_damping_n_s_per_m", tuning.wall_damping);
  out.put("feel_scale", tuning.feel_scale);
  out.put("aisle_damping_n_s_per_m", tuning.aisle_damping);
  out.put("speed_limit_m_per_s", tuning.speed_limit);
  out.put("limit_damping_n_s_per_m", tuning.limit_damping);
}

void put_contact(TomlText& out, const ContactConfig& contact) {
  out.section("contact");
  out.put("hold", std::string(hold_key(contact.hold)));
  out.put("energy_control", key_of(contact.energy_control));
  out.put("reversal_limiter", contact.reversal_limiter);
  out.put("study", contact.allow_unstable);
}

void put_guard(TomlText& out, const GuardConfig& guard) {
  out.section("guard");
  out.put("slew_n_per_cycle", guard.slew);
  out.put("ramp_time_s", guard.ramp_time);
  out.put("stale_time_s", guard.stale_time);
  out.put("fade_time_s", guard.fade_time);
  out.put("overruns_in_row", guard.overruns_in_row);
  out.put("damped_damping_n_s_per_m", guard.damped_damping);
  out.put("position_margin_m", guard.position_margin);
}

void put_haptics(TomlText& out, const HapticConfig& haptics) {
  out.section("loop");
  out.put("rate_hz", haptics.rate);
  out.put("gear_debounce_s", haptics.gear_debounce);
  out.put("ghost_offset_m", haptics.ghost_offset);
  put_tuning(out, haptics.tuning);
  put_contact(out, haptics.contact);
  out.section("estimator");
  out.put("smoothing_s", haptics.estimator.smoothing);
  out.put("speed_limit_m_per_s", haptics.estimator.speed_limit);
  out.put("window_samples", haptics.estimator.window);
  put_guard(out, haptics.guard);
  out.section("over_push");
  out.put("warn_above_n", haptics.over_push.warn_above);
  out.put("clear_below_n", haptics.over_push.clear_below);
}

}  // namespace

std::string preset_text(const Preset& preset) {
  TomlText out;
  out.put("name", preset.name);
  put_lever(out, preset.lever);
  put_haptics(out, preset.haptics);
  return out.take();
}

void write_preset(const Preset& preset, const std::filesystem::path& file) {
  write_verified_file(file, preset_text(preset), [](const auto& written) { (void)read_preset(written.string()); });
}

}  // namespace gearshift::haptics
