#include "haptics/hid/pid_report.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {
namespace {

HidBytes begin(const PidReport& report) noexcept {
  HidBytes bytes;
  bytes.size = std::min(report.size, HidBytes::kMaxSize);
  bytes.bytes[0] = report.id;
  return bytes;
}

std::span<std::uint8_t> all_of(HidBytes& bytes) noexcept {
  return {bytes.bytes.data(), bytes.size};
}

void put(HidBytes& bytes, const BitField& field, std::int64_t value) noexcept {
  write_bits(all_of(bytes), field, value);
}

std::int64_t rounded(double value) noexcept {
  return static_cast<std::int64_t>(std::llround(value));
}

// Writes a fraction, -1 to 1, of the field's range above or below the field's zero; NaN and infinity count as 0.
void put_fraction(HidBytes& bytes, const BitField& field, double fraction) noexcept {
  const double limited = std::isfinite(fraction) ? std::clamp(fraction, -1.0, 1.0) : 0.0;
  const auto span_counts = static_cast<double>(limited > 0.0 ? field.max - field.zero : field.zero - field.min);
  put(bytes, field, field.zero + rounded(limited * span_counts));
}

bool is_within(const BitField& field, int value) noexcept {
  return field.exists() && value >= field.min && value <= field.max;
}

// False for a block index outside the field's range, because encoding would clamp the index to a different block.
bool is_valid_block(const BitField& field, int block) noexcept {
  return block > kNoBlock && is_within(field, block);
}

template <std::size_t N>
void put_choice(HidBytes& bytes, const PidChoice<N>& choice, std::size_t which) noexcept {
  if (choice.bit[which].exists()) return put(bytes, choice.bit[which], 1);
  put(bytes, choice.field, choice.number[which]);
}

template <std::size_t N>
bool is_selected(const PidChoice<N>& choice, std::size_t which, std::span<const std::uint8_t> report) noexcept {
  if (!choice.supports(which)) return false;
  if (choice.bit[which].exists()) return read_bits(report, choice.bit[which]) != 0;
  return read_bits(report, choice.field) == choice.number[which];
}

// kForever is encoded as all ones. Outside the logical range, all ones is a HID null value and means endless; inside
// the range, it is the longest possible duration.
void put_duration(HidBytes& bytes, const PidSetEffect& effect, double seconds) noexcept {
  BitField field = effect.duration;
  if (!field.exists()) return;
  const std::int64_t ones = (std::int64_t{1} << field.bits) - 1;
  if (seconds >= kForever) {
    field.min = 0;
    field.max = ones;
    return put(bytes, field, ones);
  }
  const double counts = std::isfinite(seconds) ? seconds / effect.duration_unit : 0.0;
  const auto max_counts = static_cast<double>(std::min(field.max, ones - 1));
  put(bytes, field, rounded(std::clamp(counts, 1.0, std::max(max_counts, 1.0))));
}

// All ones, which is outside the logical range: a null value, "none" (HID 1.11 section 6.2.2.5).
void put_none(HidBytes& bytes, BitField field) noexcept {
  if (!field.exists()) return;
  field.min = 0;
  field.max = (std::int64_t{1} << field.bits) - 1;
  put(bytes, field, field.max);
}

// Direction 0 means a force from the far side, and angles increase clockwise. So X is a quarter turn and Y half a turn.
// The same angle in both fields is right for firmware that reads one of them and for firmware that reads both.
void put_direction(HidBytes& bytes, const PidSetEffect& effect, int axis, bool is_reversed) noexcept {
  const double turns = (axis == 1 ? 0.5 : 0.25) + (is_reversed ? 0.5 : 0.0);
  for (const BitField& field : effect.direction) {
    std::int64_t counts = rounded((turns < 1.0 ? turns : turns - 1.0) * effect.full_turn);
    if (counts > field.max) counts -= rounded(effect.full_turn);
    put(bytes, field, counts);
  }
}

void put_axis(HidBytes& bytes, const PidSetEffect& effect, const PidEffectSettings& settings) noexcept {
  const int axis = settings.axis;
  const bool has_direction = effect.direction_enable.exists() && effect.direction[0].exists();
  put_direction(bytes, effect, axis, settings.is_reversed);
  if (has_direction && settings.style != AxisStyle::bits) put(bytes, effect.direction_enable, 1);
  if (has_direction && settings.style == AxisStyle::direction) return;
  for (int i = 0; i < 2; ++i) {
    if (axis == i || axis < 0) put(bytes, effect.axis_enable[static_cast<std::size_t>(i)], 1);
  }
}

// True if the report has this ID and contains the field.
bool holds(const PidReport& layout, const BitField& field, std::span<const std::uint8_t> report) noexcept {
  return layout.exists() && !report.empty() && report[0] == layout.id && (!field.exists() || contains(report, field));
}

bool flag_or(std::span<const std::uint8_t> report, const BitField& field, bool fallback) noexcept {
  return field.exists() ? read_bits(report, field) != 0 : fallback;
}

}  // namespace

const char* file_key(AxisStyle style) noexcept {
  static constexpr const char* kNames[] = {"direction", "both", "bits"};
  return kNames[static_cast<int>(style)];
}

HidBytes encode_set_effect(const PidLayout& pid, const PidEffectSettings& settings) noexcept {
  const PidSetEffect& effect = pid.set_effect;
  const auto type = static_cast<std::size_t>(settings.effect);
  const bool has_type = std::ranges::any_of(effect.type.supported, [](bool supported) { return supported; });
  if (!is_valid_block(effect.block, settings.block) || (has_type && !effect.type.supports(type))) return {};
  HidBytes bytes = begin(effect);
  put(bytes, effect.block, settings.block);
  if (has_type) put_choice(bytes, effect.type, type);
  put_duration(bytes, effect, settings.duration);
  put_fraction(bytes, effect.gain, std::max(settings.gain, 0.0));
  put_axis(bytes, effect, settings);
  if (!pid.is_pool_ours()) {
    put_none(bytes, effect.trigger_button);  // 0 would be a button on some devices
    return bytes;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (settings.place[i] < 0)
      put_none(bytes, effect.place[i]);
    else
      put(bytes, effect.place[i], settings.place[i]);
  }
  return bytes;
}

HidBytes encode_constant(const PidLayout& pid, int block, double magnitude) noexcept {
  const BitField& place = pid.set_constant.place;
  const bool is_valid = place.exists() ? is_within(place, block) : is_valid_block(pid.set_constant.block, block);
  if (!is_valid) return {};
  HidBytes bytes = begin(pid.set_constant);
  put(bytes, place.exists() ? place : pid.set_constant.block, block);
  put_fraction(bytes, pid.set_constant.magnitude, magnitude);
  return bytes;
}

HidBytes encode_condition(const PidLayout& pid, int block, int axis, const PidCondition& condition) noexcept {
  const PidSetCondition& set = pid.set_condition;
  // Without a parameter block field there is only one condition, so a second axis would overwrite the first.
  const bool is_valid = pid.is_pool_ours()
                            ? is_within(set.parameter_block, block)
                            : is_valid_block(set.block, block) && (axis == 0 || is_within(set.parameter_block, axis));
  if (!is_valid) return {};
  HidBytes bytes = begin(set);
  put(bytes, set.block, block);
  put(bytes, set.parameter_block, pid.is_pool_ours() ? block : axis);
  put_fraction(bytes, set.centre, condition.centre);
  put_fraction(bytes, set.positive_coefficient, condition.coefficient);
  put_fraction(bytes, set.negative_coefficient, condition.coefficient);
  put_fraction(bytes, set.positive_saturation, condition.saturation);
  put_fraction(bytes, set.negative_saturation, condition.saturation);
  put_fraction(bytes, set.dead_band, condition.dead_band);
  return bytes;
}

HidBytes encode_operation(const PidLayout& pid, int block, PidOperation operation, int loops) noexcept {
  const auto which = static_cast<std::size_t>(operation);
  if (!is_valid_block(pid.operate.block, block) || !pid.operate.operation.supports(which)) return {};
  HidBytes bytes = begin(pid.operate);
  put(bytes, pid.operate.block, block);
  put_choice(bytes, pid.operate.operation, which);
  put(bytes, pid.operate.loops, loops);
  return bytes;
}

HidBytes encode_control(const PidLayout& pid, PidControl control) noexcept {
  const auto which = static_cast<std::size_t>(control);
  if (!pid.device_control.control.supports(which)) return {};
  HidBytes bytes = begin(pid.device_control);
  put_choice(bytes, pid.device_control.control, which);
  return bytes;
}

HidBytes encode_gain(const PidLayout& pid, double gain) noexcept {
  if (!pid.gain.gain.exists()) return {};
  HidBytes bytes = begin(pid.gain);
  put_fraction(bytes, pid.gain.gain, std::max(gain, 0.0));
  return bytes;
}

HidBytes encode_block_free(const PidLayout& pid, int block) noexcept {
  if (!is_valid_block(pid.block_free.block, block)) return {};
  HidBytes bytes = begin(pid.block_free);
  put(bytes, pid.block_free.block, block);
  return bytes;
}

HidBytes encode_create(const PidLayout& pid, PidEffect effect) noexcept {
  const auto which = static_cast<std::size_t>(effect);
  if (!pid.create.type.supports(which)) return {};
  HidBytes bytes = begin(pid.create);
  put_choice(bytes, pid.create.type, which);
  return bytes;
}

std::optional<BlockLoad> decode_block_load(const PidLayout& pid, std::span<const std::uint8_t> report) noexcept {
  if (!holds(pid.block_load, pid.block_load.block, report)) return std::nullopt;
  BlockLoad load;
  load.block = static_cast<int>(std::clamp<std::int64_t>(read_bits(report, pid.block_load.block), 0, 0xffff));
  using enum BlockLoad::Status;
  constexpr std::array statuses{success, full, error};
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    if (load.status == pending && is_selected(pid.block_load.status, i, report)) load.status = statuses[i];
  }
  return load;
}

std::optional<PidStatus> decode_state(const PidLayout& pid, std::span<const std::uint8_t> report) noexcept {
  if (!holds(pid.state, pid.state.actuators_enabled, report)) return std::nullopt;
  PidStatus status;
  status.actuators_enabled = flag_or(report, pid.state.actuators_enabled, false);
  status.actuator_power = flag_or(report, pid.state.actuator_power, true);
  status.safety_switch = flag_or(report, pid.state.safety_switch, true);
  status.paused = flag_or(report, pid.state.paused, false);
  status.playing = flag_or(report, pid.state.playing, false);
  status.block = static_cast<int>(std::clamp<std::int64_t>(read_bits(report, pid.state.block), 0, 0xffff));
  return status;
}

}  // namespace gearshift::haptics
