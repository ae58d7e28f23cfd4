// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
// OpenFFBoard's firmware, HidFFB.cpp, for its deviations: StickQuirks::board_control
#include "tests/support/stick/stick_firmware.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gearshift::test {
namespace {

constexpr std::size_t kMaxStates = 16;             // queued state reports
constexpr int kBytesPerBlock = 32;                 // of effect memory
constexpr std::int64_t kEndlessDuration = 0x7fff;  // [ms] effects of this duration or longer are endless
constexpr std::int64_t kMillisecond = 1'000'000;   // [ns]
constexpr int kConstantType = 1, kSpringType = 8, kDamperType = 9;
enum Control { enable_actuators = 1, disable_actuators, stop_all, reset_all, pause_all, continue_all };
enum Operation { start_effect = 1, start_solo, stop_effect };

// Direction in which a constant force pushes, on the device's axes. The encoded direction states where the force comes
// from, clockwise from the far side (PID 1.0 section 4.2): a force from the right (90 degrees) pushes left, a force
// from the far side (0 degrees) pushes towards the user (positive Y). If the direction bit is not set, the two values
// are the components of the force. The count for 180 degrees then means zero; X values below it push right, Y values
// above it push towards the user.
glm::dvec2 push_direction(const SetEffectBytes& bytes, std::span<const std::uint8_t> report) noexcept {
  const std::uint8_t axes = report[bytes.axes_at];
  const auto x = static_cast<double>(read_number(report, bytes.direction_x));
  const auto y = static_cast<double>(read_number(report, bytes.direction_y));
  if ((axes & 4) != 0) {
    const double angle = 2.0 * std::numbers::pi * x / bytes.full_turn;
    return {-std::sin(angle), std::cos(angle)};
  }
  const double half = 0.5 * bytes.full_turn;
  return {(axes & 1) != 0 ? (half - x) / half : 0.0, (axes & 2) != 0 ? (y - half) / half : 0.0};
}

}  // namespace

StickFirmware::StickFirmware(const StickFamilyTable& family, int blocks, bool finite_refused)
    : family_(family),
      blocks_(blocks > 0 ? blocks : family.quirks.last_block - family.quirks.first_block + 1),
      finite_refused_(finite_refused),
      effects_(family.quirks.first_block - 1 + blocks_) {
  power_off();
}

void StickFirmware::power_off() noexcept {
  reset();
  actuators_ = false;
  gain_ = 1.0;
  states_.clear();
}

void StickFirmware::reset() noexcept {
  effects_.free_all();
  paused_ = false;
  actuators_ = !family_.quirks.board_control;
  load_block_ = 0;
  load_status_ = BlockStatus::error;
  if (family_.quirks.first_block > 1) create_centring_spring();
}

// Creates a block without a request from the host: a centring spring, which plays after the host starts it.
void StickFirmware::create_centring_spring() noexcept {
  DeviceEffect* spring = effects_.find(effects_.create());
  spring->settings = {true, EffectKind::spring, 0, 0, 1.0, {}, {true, true}};
  spring->condition.fill({true, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0});
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
  } else if (id == family_.gain.id) {
    gain_ = report[1] / 255.0;
  }
}

void StickFirmware::set_constant(std::span<const std::uint8_t> report) noexcept {
  DeviceEffect* effect = effects_.find(report[1]);
  if (effect == nullptr) return;
  effect->magnitude = std::clamp(read_fraction(report, family_.constant.magnitude), -1.0, 1.0);
}

EffectKind StickFirmware::kind_of(int type) const noexcept {
  if (type == kConstantType) return EffectKind::constant;
  if (type == kSpringType) return EffectKind::spring;
  return type == kDamperType ? EffectKind::damper : EffectKind::silent;
}

void StickFirmware::set_effect(std::span<const std::uint8_t> report) {
  DeviceEffect* effect = effects_.find(report[1]);
  if (effect == nullptr) return;
  const SetEffectBytes& bytes = family_.set_effect;
  const std::int64_t duration = read_number(report, bytes.duration);
  const bool finite = duration > 0 && duration < kEndlessDuration;
  if (finite && finite_refused_) {
    load_block_ = report[1];
    load_status_ = BlockStatus::error;
    return;
  }
  EffectSettings& settings = effect->settings;
  settings.is_set = true;
  settings.kind = kind_of(report[2]);
  settings.duration_ns = finite ? duration * kMillisecond : 0;
  settings.delay_ns = read_number(report, bytes.start_delay) * kMillisecond;
  settings.gain = report[bytes.gain_at] / 255.0;
  settings.direction = push_direction(bytes, report);
  const std::uint8_t axes = report[bytes.axes_at];
  settings.axis = {(axes & 5) != 0, (axes & 6) != 0};
  if (family_.quirks.board_control) actuators_ = true;
  queue_state(report[1]);
}

void StickFirmware::set_condition(std::span<const std::uint8_t> report) noexcept {
  DeviceEffect* effect = effects_.find(report[1]);
  const std::size_t axis = report[2] & 0x0F;
  if (effect == nullptr || axis >= effect->condition.size()) return;
  const ConditionBytes& bytes = family_.condition;
  AxisCondition& condition = effect->condition[axis];
  condition.is_set = true;
  condition.centre = read_fraction(report, bytes.centre);
  condition.dead_band = read_fraction(report, bytes.dead_band);
  condition.positive = read_fraction(report, bytes.positive);
  condition.negative = read_fraction(report, bytes.negative);
  condition.positive_saturation = std::clamp(read_fraction(report, bytes.positive_saturation), 0.0, 1.0);
  condition.negative_saturation = std::clamp(read_fraction(report, bytes.negative_saturation), 0.0, 1.0);
}

void StickFirmware::operate(std::span<const std::uint8_t> report, std::int64_t now_ns) {
  DeviceEffect* effect = effects_.find(report[1]);
  const int operation = report[2];
  if (effect == nullptr || operation < start_effect || operation > stop_effect) return;
  if (operation == start_solo) effects_.stop_all();
  if (operation == stop_effect) {
    effect->playing = false;
  } else {
    effects_.start(*effect, report[3], now_ns);
  }
  queue_state(report[1]);
}

void StickFirmware::control(std::uint8_t value) {
  if (!family_.quirks.control_bits) {
    control_by_number(value);
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
      actuators_ = false;
      break;
    case stop_all:
      effects_.stop_all();
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

void StickFirmware::control_by_switch(int number) {
  if (number == reset_all) reset();
  actuators_ = number == enable_actuators || number == continue_all;
}

bool StickFirmware::set_feature(std::span<const std::uint8_t> report) {
  if (report.size() == family_.create.size && report[0] == family_.create.id) {
    create(report[1]);
    return true;
  }
  return family_.block_state.size > 0 && report.size() == family_.block_state.size &&
         report[0] == family_.block_state.id;
}

void StickFirmware::create(int type) noexcept {
  load_block_ = 0;
  load_status_ = BlockStatus::error;
  if (refusal) load_status_ = *refusal;
  if (refusal || type < 1 || type > family_.last_type) return;
  load_block_ = effects_.create();
  load_status_ = load_block_ > 0 ? BlockStatus::success : BlockStatus::full;
}

std::optional<StickReport> StickFirmware::feature(std::uint8_t id) const {
  const auto low = [](int value) { return static_cast<std::uint8_t>(value); };
  const auto high = [](int value) { return static_cast<std::uint8_t>(value >> 8); };
  if (id == family_.block_load.id) {
    const int ram = effects_.free_blocks() * kBytesPerBlock;
    return StickReport{id, low(load_block_), static_cast<std::uint8_t>(load_status_), low(ram), high(ram)};
  }
  if (id == family_.pool.id) {
    const int ram = blocks_ * kBytesPerBlock;
    return StickReport{id, low(ram), high(ram), low(blocks_), 0x01};  // bit 0: the device manages the pool
  }
  if (family_.block_state.size > 0 && id == family_.block_state.id) return StickReport{id, low(state_block_)};
  return std::nullopt;
}

StickReport StickFirmware::state() const {
  const auto bit = [](bool value, int position) { return static_cast<std::uint8_t>(value ? 1 << position : 0); };
  const auto flags =
      static_cast<std::uint8_t>(bit(paused_, 0) | bit(actuators_, 1) | bit(true, 2));  // the safety switch is on
  // The motors always have power. This is bit 3 in the report of 2 bytes, and bit 4 in the report of 3 bytes.
  if (family_.state.size == 2) {
    return {family_.state.id, static_cast<std::uint8_t>(flags | bit(true, 3) | bit(playing() > 0, 4))};
  }
  if (family_.state.size == 3) {
    const DeviceEffect* effect = effects_.find(state_block_);
    const bool plays = effect != nullptr && effect->playing;
    return {family_.state.id, static_cast<std::uint8_t>(flags | bit(true, 4)),
            static_cast<std::uint8_t>(bit(plays, 0) | state_block_ << 1)};
  }
  return {};
}

void StickFirmware::queue_state(int block) {
  state_block_ = block;
  if (family_.state.size == 0) return;
  if (states_.size() == kMaxStates) states_.pop_front();
  states_.push_back(state());
}

std::optional<StickReport> StickFirmware::take_state() {
  if (states_.empty()) return std::nullopt;
  StickReport report = std::move(states_.front());
  states_.pop_front();
  return report;
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
  if (!actuators_ || paused_) return {};
  EffectForces forces = effects_.forces(motion, now_ns);
  forces.constant *= gain_;
  forces.spring *= gain_;
  forces.damper *= gain_;
  return forces;
}

}  // namespace gearshift::test
