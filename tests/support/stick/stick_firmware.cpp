// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
// OpenFFBoard's firmware, HidFFB.cpp, for its deviations: StickQuirks::board_control
#include "tests/support/stick/stick_firmware.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/common.hpp>

#include "tests/support/stick/force_laws.h"

namespace gearshift::test {
namespace {

constexpr std::size_t kMaxStates = 16;                   // queued state reports
constexpr int kBytesPerBlock = 32;                       // of effect memory
constexpr int kPoolMemory = 300;                         // [bytes] if the driver manages the pool
constexpr std::int64_t kEndlessDuration = 0x7fff;        // [ms] effects of this duration or longer are endless
constexpr std::int64_t kMillisecond = 1'000'000;         // [ns]
constexpr double kCentringLimit = 0.3;                   // [1] largest force of the auto-centre spring
constexpr double kIdleSlope = 1.77, kIdleLimit = 0.136;  // of AutoCentre::when_off
enum Control { enable_actuators = 1, disable_actuators, stop_all, reset_all, pause_all, continue_all };
enum Operation { start_effect = 1, start_solo, stop_effect };

std::uint8_t axes_of(const SetEffectBytes& bytes, std::span<const std::uint8_t> report) noexcept {
  const std::uint8_t byte = report[bytes.axes_at];
  return static_cast<std::uint8_t>(((byte & bytes.x_bit) != 0 ? 1 : 0) | ((byte & bytes.y_bit) != 0 ? 2 : 0) |
                                   ((byte & bytes.direction_bit) != 0 ? 4 : 0));
}

// [rad] of the two direction fields; a missing second field is as the first.
glm::dvec2 angles_of(const SetEffectBytes& bytes, std::span<const std::uint8_t> report) noexcept {
  const auto angle = [&](StickNumber field) {
    return 2.0 * std::numbers::pi * static_cast<double>(read_number(report, field)) / bytes.full_turn;
  };
  return {angle(bytes.direction_x), angle(bytes.direction_y.bytes > 0 ? bytes.direction_y : bytes.direction_x)};
}

glm::dvec2 swapped(glm::dvec2 v) noexcept {
  return {v.y, v.x};
}

// Index in a family's list of numbers, plus 1; 0: not in the list.
template <std::size_t N>
int ordinal_of(const std::array<std::uint8_t, N>& numbers, int number) noexcept {
  const auto found = std::find(numbers.begin(), numbers.end(), number);
  return found == numbers.end() ? 0 : static_cast<int>(found - numbers.begin()) + 1;
}

}  // namespace

StickFirmware::StickFirmware(const StickFamilyTable& family, const StickHabits& habits, int blocks, bool finite_refused)
    : family_(family),
      habits_(habits),
      blocks_(blocks > 0 ? blocks : family.quirks.last_block - family.quirks.first_block + 1),
      finite_refused_(finite_refused),
      effects_(std::max(family.quirks.first_block - 1, 0) + blocks_) {
  power_off();
}

void StickFirmware::power_off() noexcept {
  reset();
  actuators_ = false;
  was_created_ = false;
  gain_ = 1.0;
  states_.clear();
}

void StickFirmware::reset() noexcept {
  effects_.free_all();
  paused_ = false;
  actuators_ = !family_.quirks.board_control && !habits_.off_until_enabled;
  centres_ = habits_.auto_centre == AutoCentre::after_reset;
  mute_ = habits_.mute_until_stop_all;
  memory_.clear();
  load_block_ = 0;
  load_status_ = BlockStatus::error;
  if (family_.quirks.first_block > 1) create_centring_spring();
}

// Creates a block without a request from the host: a centring spring, which plays after the host starts it.
void StickFirmware::create_centring_spring() noexcept {
  DeviceEffect* spring = effects_.find(effects_.create());
  spring->settings.is_set = true;
  spring->settings.kind = EffectKind::spring;
  spring->settings.axes = 3;
  AxisCondition full;
  full.is_set = true;
  full.positive = full.negative = full.positive_saturation = full.negative_saturation = 1.0;
  spring->condition.fill(full);
}

bool StickFirmware::accepts_output(std::span<const std::uint8_t> report) const noexcept {
  const auto matches = [&](const ReportShape& shape) {
    return shape.size > 0 && report.size() == shape.size && report[0] == shape.id;
  };
  return matches(family_.set_effect) || matches(family_.condition) || matches(family_.constant) ||
         matches(family_.operation) || matches(family_.block_free) || matches(family_.control) ||
         matches(family_.gain) || std::any_of(family_.other_outputs.begin(), family_.other_outputs.end(), matches);
}

void StickFirmware::output(std::span<const std::uint8_t> report, std::int64_t now_ns) {
  if (!accepts_output(report)) return;
  const std::uint8_t id = report[0];
  if (id == family_.set_effect.id) {
    set_effect(report);
  } else if (id == family_.condition.id) {
    set_condition(report);
  } else if (id == family_.constant.id) {
    set_constant(report);
  } else if (id == family_.operation.id) {
    operate(report, now_ns);
  } else if (id == family_.block_free.id) {
    if (report[1] >= family_.quirks.first_block) effects_.free(report[1]);
  } else if (id == family_.control.id) {
    control(report[1]);
  } else if (id == family_.gain.id && !habits_.ignores_device_gain) {
    gain_ = static_cast<double>(read_number(report, {1, static_cast<int>(report.size()) - 1})) / family_.gain_max;
  }
}

DeviceEffect* StickFirmware::effect_at(int index) noexcept {
  return effects_.find(family_.quirks.driver_managed ? index + 1 : index);
}

void StickFirmware::set_constant(std::span<const std::uint8_t> report) {
  const double magnitude = std::clamp(read_fraction(report, family_.constant.magnitude), -1.0, 1.0);
  if (family_.quirks.driver_managed) {
    memory_[static_cast<int>(read_number(report, family_.constant.place))].magnitude = magnitude;
    for (int i = 1; i <= blocks_; ++i) {
      if (DeviceEffect* effect = effects_.find(i)) fetch_parameters(*effect);
    }
  } else if (DeviceEffect* effect = effects_.find(report[1])) {
    const bool is_update = effect->settings.is_set;
    if (is_update && habits_.constant_update == ConstantUpdate::nothing) return;
    effect->magnitude =
        is_update && habits_.constant_update == ConstantUpdate::strength ? std::abs(magnitude) : magnitude;
    effect->sign_dropped = false;
  }
}

// Takes an effect's parameters from the memory, if the driver manages the pool.
void StickFirmware::fetch_parameters(DeviceEffect& effect) const {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto found = memory_.find(effect.place[i]);
    if (i == 0) effect.magnitude = found == memory_.end() ? 0.0 : found->second.magnitude;
    effect.condition[i] = found == memory_.end() ? AxisCondition{} : found->second.condition;
  }
}

EffectKind StickFirmware::kind_of(int type) const noexcept {
  constexpr std::array kKinds{EffectKind::silent, EffectKind::constant, EffectKind::spring, EffectKind::damper};
  return kKinds[static_cast<std::size_t>(ordinal_of(family_.types, type))];
}

void StickFirmware::set_effect(std::span<const std::uint8_t> report) {
  if (family_.quirks.driver_managed) effects_.take(report[1] + 1);
  DeviceEffect* effect = effect_at(report[1]);
  if (effect == nullptr) return;
  const SetEffectBytes& bytes = family_.set_effect;
  const std::int64_t duration = read_number(report, bytes.duration);
  const bool is_ones = habits_.ones_are_finite && duration == 0xffff;
  const bool finite = (duration > 0 && duration < kEndlessDuration) || is_ones;
  if (finite && !is_ones && finite_refused_) {
    load_block_ = report[1];
    load_status_ = BlockStatus::error;
    return;
  }
  EffectSettings& settings = effect->settings;
  settings.is_set = true;
  settings.kind = kind_of(report[2]);
  settings.duration_ns = finite ? duration * kMillisecond : 0;
  settings.delay_ns = read_number(report, bytes.start_delay) * kMillisecond;
  settings.gain = bytes.gain.number.bytes > 0 ? read_fraction(report, bytes.gain) : 1.0;
  settings.axes = axes_of(bytes, report);
  settings.angle = angles_of(bytes, report);
  settings.waits_for_button = habits_.trigger_none_is_ff && report[bytes.trigger_at] < 9;
  effect->sign_dropped = habits_.drops_sign && effect->magnitude < 0.0;
  for (std::size_t i = 0; i < 2; ++i) effect->place[i] = static_cast<int>(read_number(report, bytes.places[i]));
  if (family_.quirks.driver_managed) fetch_parameters(*effect);
  on_effect_set(*effect);
  if (family_.quirks.board_control) actuators_ = true;
  queue_state(report[1], true);
}

AxisCondition StickFirmware::read_condition(std::span<const std::uint8_t> report) const noexcept {
  const ConditionBytes& bytes = family_.condition;
  const auto fraction = [&](const StickFraction& field, double missing) {
    return field.number.bytes > 0 ? read_fraction(report, field) : missing;
  };
  AxisCondition condition;
  condition.is_set = true;
  condition.centre = fraction(bytes.centre, 0.0);
  condition.centre_counts = static_cast<double>(read_number(report, bytes.centre.number));
  condition.dead_band = fraction(bytes.dead_band, 0.0);
  condition.dead_band_counts = static_cast<double>(read_number(report, bytes.dead_band.number));
  condition.positive = fraction(bytes.positive, 0.0);
  condition.negative = fraction(bytes.negative, condition.positive);
  condition.positive_saturation = std::clamp(fraction(bytes.positive_saturation, 1.0), 0.0, 1.0);
  condition.negative_saturation =
      std::clamp(fraction(bytes.negative_saturation, condition.positive_saturation), 0.0, 1.0);
  if (habits_.ignores_saturation) condition.positive_saturation = condition.negative_saturation = 1.0;
  return condition;
}

void StickFirmware::set_condition(std::span<const std::uint8_t> report) {
  const AxisCondition condition = read_condition(report);
  if (family_.quirks.driver_managed) {
    memory_[static_cast<int>(read_number(report, family_.condition.place))].condition = condition;
    for (int i = 1; i <= blocks_; ++i) {
      if (DeviceEffect* effect = effects_.find(i)) fetch_parameters(*effect);
    }
    return;
  }
  DeviceEffect* effect = effects_.find(report[1]);
  const std::size_t axis = report[2] & 0x0F;
  if (effect == nullptr || axis >= effect->condition.size()) return;
  effect->condition[axis] = condition;
  on_condition_told(*effect, axis);
}

void StickFirmware::operate(std::span<const std::uint8_t> report, std::int64_t now_ns) {
  DeviceEffect* effect = effect_at(report[1]);
  const int operation = ordinal_of(family_.operations, report[2]);
  if (effect == nullptr || operation == 0) return;
  if (operation == start_solo) effects_.stop_all();
  const int limit = habits_.effects_at_once;
  while (operation == start_effect && limit > 0 && !effect->playing && effects_.playing() >= limit)
    effects_.stop_oldest();
  if (operation == stop_effect) {
    effect->playing = false;
  } else {
    effects_.start(*effect, report[3], now_ns);
  }
  queue_state(report[1]);
}

void StickFirmware::control(std::uint8_t value) {
  if (habits_.control_tests_bits) {
    if ((value & 3) != 0) stop_all_effects();
    if ((value & 4) != 0) reset();
  } else if (!family_.quirks.control_bits) {
    control_by_number(ordinal_of(family_.controls, value));
  } else {
    for (int number = enable_actuators; number <= continue_all; ++number) {
      if ((value >> (number - 1) & 1) != 0) control_by_switch(number);
    }
  }
  queue_state(state_block_);
}

void StickFirmware::control_by_number(int number) {
  switch (number) {
    case enable_actuators:
      actuators_ = true;
      break;
    case disable_actuators:
      actuators_ = habits_.ignores_actuators;
      break;
    case stop_all:
      stop_all_effects();
      break;
    case reset_all:
      reset();
      break;
    case pause_all:
      paused_ = true;
      break;
    case continue_all:
      paused_ = false;
      break;
    default:
      break;
  }
}

void StickFirmware::stop_all_effects() noexcept {
  if (!habits_.ignores_stop_all) effects_.stop_all();
  if (habits_.stop_all_erases) effects_.forget_all();
  centres_ = false;
  mute_ = false;
}

void StickFirmware::control_by_switch(int number) {
  if (number == reset_all) reset();
  if (number == stop_all) centres_ = mute_ = false;
  actuators_ = number == enable_actuators || number == continue_all;
}

bool StickFirmware::set_feature(std::span<const std::uint8_t> report) {
  if (family_.create.size > 0 && report.size() == family_.create.size && report[0] == family_.create.id) {
    create(report[1]);
    return load_status_ != BlockStatus::full || !habits_.first_create_fails || was_created_;
  }
  return family_.block_state.size > 0 && report.size() == family_.block_state.size &&
         report[0] == family_.block_state.id;
}

void StickFirmware::create(int type) noexcept {
  const bool fails = habits_.first_create_fails && !was_created_;
  was_created_ = true;
  loads_read_ = 0;
  load_block_ = 0;
  load_status_ = BlockStatus::error;
  if (refusal) load_status_ = *refusal;
  if (refusal || type < 1 || type > family_.last_type) return;
  if (habits_.springs_full && kind_of(type) == EffectKind::spring) {
    load_status_ = BlockStatus::full;
    return;
  }
  load_block_ = fails ? 0 : habits_.stopped_is_free ? effects_.create_or_take_stopped() : effects_.create();
  load_status_ = load_block_ > 0 ? BlockStatus::success : BlockStatus::full;
  if (habits_.state_sent == StateSent::at_setting) queue_state(load_block_, true);
}

std::optional<StickReport> StickFirmware::take_feature(std::uint8_t id) {
  const bool is_load = family_.block_load.size > 0 && id == family_.block_load.id;
  if (is_load) ++loads_read_;
  if (is_load && habits_.load_answers_once && loads_read_ > 1) return StickReport(family_.lever.size, 0);
  std::optional<StickReport> report = feature(id);
  if (id == family_.pool.id && habits_.pool_read_frees_all) effects_.free_all();
  if (report) report->resize(report->size() - static_cast<std::size_t>(habits_.short_features));
  return report;
}

std::optional<StickReport> StickFirmware::feature(std::uint8_t id) const {
  if (family_.block_load.size > 0 && id == family_.block_load.id) return block_load_report();
  if (id == family_.pool.id) return pool_report();
  if (family_.block_state.size > 0 && id == family_.block_state.id)
    return StickReport{id, static_cast<std::uint8_t>(state_block_)};
  return std::nullopt;
}

StickReport StickFirmware::block_load_report() const {
  const bool is_late = loads_read_ <= habits_.late_loads;
  const int ram = effects_.free_blocks() * kBytesPerBlock;
  return {family_.block_load.id, static_cast<std::uint8_t>(is_late ? 0 : load_block_),
          static_cast<std::uint8_t>(is_late ? BlockStatus{} : load_status_), static_cast<std::uint8_t>(ram),
          static_cast<std::uint8_t>(ram >> 8)};
}

StickReport StickFirmware::pool_report() const {
  const auto low = [](int value) { return static_cast<std::uint8_t>(value); };
  const std::uint8_t id = family_.pool.id;
  if (family_.quirks.driver_managed) {
    // memory and flag, effects, alignment; sizes of a constant, a periodic, an envelope and a condition
    return {id, low(kPoolMemory), low(kPoolMemory >> 8), low(blocks_), 2, 2, 12, 14, 8};
  }
  const int announced = blocks_ + family_.quirks.more_announced, ram = announced * kBytesPerBlock;
  return {id, low(ram), low(ram >> 8), low(announced), static_cast<std::uint8_t>(habits_.pool_by_driver_flag ? 0 : 1)};
}

StickReport StickFirmware::state() const {
  const StateBytes& bytes = family_.state;
  if (bytes.size == 0) return {};
  const auto bit = [](bool value, int position) { return static_cast<std::uint8_t>(value ? 1 << position : 0); };
  auto flags = static_cast<std::uint8_t>(
      bit(paused_, bytes.paused) |
      bit((actuators_ && !habits_.says_no_actuators) || habits_.says_actuators, bytes.actuators) |
      bit(is_switch_closed_ && !habits_.says_no_safety_switch, bytes.safety_switch) |
      bit(has_power_ && !habits_.says_no_power, bytes.power));
  if (bytes.playing >= 0) flags = static_cast<std::uint8_t>(flags | bit(playing() > 0, bytes.playing));
  StickReport report(bytes.size, 0);
  report[0] = bytes.id;
  report[1] = flags;
  if (bytes.size == 2) return report;
  const DeviceEffect* effect = effects_.find(state_block_ + (family_.quirks.driver_managed ? 1 : 0));
  const bool plays = effect != nullptr && effect->playing;
  report[2] = static_cast<std::uint8_t>(bytes.playing >= 0     ? state_block_
                                        : bytes.playing_is_top ? state_block_ | bit(plays, 7)
                                                               : state_block_ << 1 | bit(plays, 0));
  return report;
}

void StickFirmware::queue_state(int block, bool at_setting) {
  state_block_ = block;
  const bool is_told =
      habits_.state_sent == StateSent::at_changes || (habits_.state_sent == StateSent::at_setting && at_setting);
  if (family_.state.size == 0 || !is_told) return;
  if (states_.size() == kMaxStates) states_.pop_front();
  states_.push_back(state());
}

std::optional<StickReport> StickFirmware::take_state() {
  if (states_.empty()) return std::nullopt;
  StickReport report = std::move(states_.front());
  states_.pop_front();
  return report;
}

void StickFirmware::set_supply(bool has_power, bool is_switch_closed) {
  if (has_power == has_power_ && is_switch_closed == is_switch_closed_) return;
  has_power_ = has_power;
  is_switch_closed_ = is_switch_closed;
  queue_state(state_block_);
}

void StickFirmware::set_clock(std::int64_t now_ns) noexcept {
  effects_.postpone(now_ns - now_ns_);
  now_ns_ = now_ns;
}

void StickFirmware::advance(std::int64_t now_ns) {
  if (paused_) effects_.postpone(now_ns - now_ns_);
  now_ns_ = now_ns;
  for (int block : effects_.expire(now_ns)) queue_state(block);
}

EffectForces StickFirmware::forces(const DeviceMotion& motion, std::int64_t now_ns) const noexcept {
  EffectForces forces;
  const bool off = !actuators_ && !habits_.ignores_actuators;
  if (!has_power_ || !is_switch_closed_) return forces;
  if (!off && !paused_ && !mute_) forces = effects_.forces(motion, habits_, now_ns);
  forces.constant *= gain_;
  forces.spring *= gain_;
  forces.damper *= gain_;
  forces.constant += habits_.cross_talk.constant * swapped(forces.constant);
  forces.spring += habits_.cross_talk.spring * swapped(forces.spring);
  forces.damper += habits_.cross_talk.damper * swapped(forces.damper);
  forces.centring = centring_force(motion);
  if (habits_.motors == 1) forces.constant.y = forces.spring.y = forces.damper.y = forces.centring.y = 0.0;
  if (habits_.only_y_pushes) forces.constant.x = forces.spring.x = forces.damper.x = forces.centring.x = 0.0;
  return forces;
}

glm::dvec2 StickFirmware::centring_force(const DeviceMotion& motion) const noexcept {
  const AutoCentre kind = habits_.auto_centre;
  const bool idles = kind == AutoCentre::when_off;
  const bool is_on = idles ? !actuators_
                           : centres_ || (kind == AutoCentre::until_spring && !effects_.plays(EffectKind::spring)) ||
                                 kind == AutoCentre::always || (kind == AutoCentre::while_on && actuators_);
  if (!is_on) return glm::dvec2(0.0);
  const double slope = idles ? kIdleSlope : habits_.centring_slope, limit = idles ? kIdleLimit : kCentringLimit;
  return -glm::clamp(slope * motion.deflection, -limit, limit);
}

}  // namespace gearshift::test
