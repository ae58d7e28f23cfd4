#include "haptics/hardware/report_scheduler.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {
namespace {

constexpr std::int64_t kDuration = static_cast<std::int64_t>(1e9 * kEffectDuration);  // [ns]
constexpr std::int64_t kRenew = static_cast<std::int64_t>(1e9 * kRenewAfter);         // [ns]
// [ns] Some firmware ends an endless effect after 32 or 65 s: all ones of 15 or 16 bits in milliseconds.
constexpr std::int64_t kEndlessRenew = 20'000'000'000;
constexpr std::int64_t kReportLag = 50'000'000;  // [ns] longest delay of a state report
constexpr int kOnce = 1;                         // loop count

double difference(const PidCondition& a, const PidCondition& b) noexcept {
  return std::max({std::abs(a.centre - b.centre), std::abs(a.dead_band - b.dead_band),
                   std::abs(a.coefficient - b.coefficient), std::abs(a.saturation - b.saturation)});
}

constexpr PidCondition kZero{};
// Some firmware keeps the strength that it had when the effect was first set. So that the calibration feels it, this is
// not zero; so that it is harmless, it is small: for both axes together below a tenth. No effect plays yet.
constexpr double kFirstForce = 0.07;  // [1]
// Firmware may look at its conditions when an effect is set, and give those without a force to the other axis.
constexpr PidCondition kSlight{0.0, 0.0, 0.01, 0.01};
constexpr int kPlaceSize = 16;  // [bytes] memory for the parameters of one axis; no report of PID 1.0 needs more

// Where value 0 to 5 is, if the driver manages the pool.
constexpr int place_of(std::size_t value) noexcept {
  return kPlaceSize * static_cast<int>(value);
}

}  // namespace

const char* file_key(SignStyle style) noexcept {
  static constexpr const char* kStyleKeys[] = {"magnitude", "direction"};
  return kStyleKeys[static_cast<int>(style)];
}

PidEffect kind_of(StickEffect effect) noexcept {
  if (effect == StickEffect::spring) return PidEffect::spring;
  return effect == StickEffect::damper ? PidEffect::damper : PidEffect::constant;
}

namespace {

PidEffectSettings settings_of(StickEffect effect, int block, StickStyle style, double duration) noexcept {
  const auto index = static_cast<std::size_t>(effect);
  const bool is_constant = index < 2;
  const std::size_t value = is_constant ? index : 2 * index - 2;
  PidEffectSettings settings{block, kind_of(effect), duration};
  settings.axis = is_constant ? static_cast<int>(index) : -1;
  settings.style = is_constant ? style.constants : style.conditions;
  settings.place = {place_of(value), is_constant ? -1 : place_of(value + 1)};
  return settings;
}

}  // namespace

// Parameters come before the settings for firmware that looks at them then, and again afterwards.
EffectReports::EffectReports(const PidLayout& pid, StickEffect effect, int block, StickStyle style,
                             double duration) noexcept {
  const auto index = static_cast<std::size_t>(effect);
  const bool is_constant = index < 2;
  const std::size_t value = is_constant ? index : 2 * index - 2;
  const auto add_values = [&](const PidCondition& condition, double force) {
    const auto target = [&](std::size_t axis) { return pid.is_pool_ours() ? place_of(value + axis) : block; };
    if (is_constant) return add(encode_constant(pid, target(0), force));
    for (int axis = 0; axis < 2; ++axis)
      add(encode_condition(pid, target(static_cast<std::size_t>(axis)), axis, condition));
  };
  add_values(kSlight, kFirstForce);
  const HidBytes set = encode_set_effect(pid, settings_of(effect, block, style, duration));
  has_settings_ = set.size > 0;
  add(set);
  add_values(kZero, 0.0);
}

void EffectReports::add(const HidBytes& report) noexcept {
  if (report.size > 0) reports_[size_++] = report;
}

void ReportScheduler::begin(const StickBlocks& blocks, bool finite, StickStyle style) noexcept {
  command_ = {};
  released_ = false;
  finite_ = finite;
  style_ = wanted_style_ = style;
  settings_sent_ = 0;
  is_style_mixed_ = false;
  said_power_ = said_safety_switch_ = said_actuators_ = false;
  doubt_ = StickFault::none;
  on_ = !has_switch();
  sent_ = {};
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    effect_[i] = {};
    effect_[i].block = blocks[i];
  }
  for (std::size_t i = 0; i < kValues; ++i) value_[i] = {kZero, encode(i, kZero), 0, false};
}

void ReportScheduler::set_style(StickStyle style) noexcept {
  if (style == wanted_style_) return;
  is_style_mixed_ = is_style_mixed_ || settings_sent_ > 0;
  settings_sent_ = 0;
  wanted_style_ = style;
}

bool ReportScheduler::plays() const noexcept {
  return std::any_of(effect_.begin(), effect_.end(), [](const Effect& effect) { return effect.playing; });
}

bool ReportScheduler::drives() const noexcept {
  return on_ && plays();
}

std::array<double, 2> ReportScheduler::force() const noexcept {
  std::array<double, 2> force{};
  for (std::size_t i = 0; i < 2; ++i) {
    if (on_ && effect_[i].playing) force[i] = value_[i].current.coefficient;
  }
  return force;
}

std::array<PidSpring, 2> ReportScheduler::spring() const noexcept {
  std::array<PidSpring, 2> spring{};
  if (!on_ || !effect_[static_cast<std::size_t>(StickEffect::spring)].playing) return spring;
  for (std::size_t i = 0; i < 2; ++i) {
    const PidCondition& current = value_[2 + i].current;
    spring[i] = {current.centre, current.dead_band, current.coefficient, current.saturation};
  }
  return spring;
}

std::array<double, 2> ReportScheduler::damper() const noexcept {
  if (!on_ || !effect_[static_cast<std::size_t>(StickEffect::damper)].playing) return {};
  return {value_[4].current.coefficient, value_[5].current.coefficient};
}

// True if the effect should play. Constant forces always play, so that the first force needs only one report.
bool ReportScheduler::is_wanted(std::size_t effect) const noexcept {
  if (effect_[effect].block == kNoBlock) return false;
  switch (static_cast<StickEffect>(effect)) {
    case StickEffect::spring:
      return command_.holds_spring || command_.spring[0].coefficient != 0.0 || command_.spring[1].coefficient != 0.0;
    case StickEffect::damper:
      // Once started, a damper keeps playing, even with coefficient 0, because starting it again takes three reports,
      // which is too long at a contact.
      return command_.damper[0] != 0.0 || command_.damper[1] != 0.0 || effect_[effect].playing;
    default:
      return command_.pushes[effect];
  }
}

PidCondition ReportScheduler::target_value(std::size_t value) const noexcept {
  PidCondition setting;
  const PidSpring& spring = command_.spring[value % 2];
  switch (static_cast<StickEffect>(effect_of(value))) {
    case StickEffect::spring:
      return {spring.centre, spring.dead_band, spring.coefficient, spring.saturation};
    case StickEffect::damper:
      setting.coefficient = command_.damper[value % 2];
      return setting;
    default:
      setting.coefficient = command_.constant[value];
      return setting;
  }
}

HidBytes ReportScheduler::encode(std::size_t value, const PidCondition& setting) const noexcept {
  const int block = pid_.is_pool_ours() && effect_[effect_of(value)].block != kNoBlock
                        ? place_of(value)
                        : effect_[effect_of(value)].block;
  if (value < 2 && style_.signs == SignStyle::direction)
    return encode_constant(pid_, block, std::abs(setting.coefficient));
  if (value < 2) return encode_constant(pid_, block, setting.coefficient);
  return encode_condition(pid_, block, static_cast<int>(value % 2), setting);
}

HidBytes ReportScheduler::next(std::int64_t now_ns) noexcept {
  sent_ = {};
  expire(now_ns);
  if (released_ || !command_.enabled || lacks_style()) {
    next_off();
    if (sent_.report.size > 0) return sent_.report;
    released_ = false;
    if (send_setting()) return sent_.report;
  }
  if (command_.enabled) next_on(now_ns);
  return sent_.report;
}

// Sends the next report that gives the effects the wanted style. Some firmware switches its actuators on when an effect
// is set, so they are switched off afterwards.
bool ReportScheduler::send_setting() noexcept {
  if (!lacks_style()) return false;
  std::size_t passed = 0;
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    if (effect_[i].block == kNoBlock) continue;
    const EffectReports reports(pid_, static_cast<StickEffect>(i), effect_[i].block, wanted_style_,
                                finite_ ? kEffectDuration : kForever);
    if (settings_sent_ < passed + reports.all().size()) {
      sent_ = {Sent::Kind::setting, i, {}, reports.all()[settings_sent_ - passed]};
      return true;
    }
    passed += reports.all().size();
  }
  style_ = wanted_style_;
  is_style_mixed_ = false;
  for (Effect& effect : effect_) effect.is_reversed = false;
  settings_sent_ = 0;
  return has_switch() && control(PidControl::disable_actuators, Sent::Kind::off);
}

// Marks the effects whose duration has ended.
void ReportScheduler::expire(std::int64_t now_ns) noexcept {
  for (Effect& effect : effect_) {
    if (finite_ && now_ns - effect.started_ns > kDuration) effect.playing = false;
  }
}

// Chooses the next report that switches the motors off.
void ReportScheduler::next_off() noexcept {
  for (Value& value : value_) value.is_told = false;
  if (on_ && has_switch() && control(PidControl::disable_actuators, Sent::Kind::off)) return;
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    if (effect_[i].playing && operate(i, PidOperation::stop)) return;
  }
  if (plays() && control(PidControl::stop_all, Sent::Kind::all_stopped)) return;
  for (std::size_t i = 0; i < kValues; ++i) {
    if (send_value(i, kZero)) return;
  }
}

void ReportScheduler::next_on(std::int64_t now_ns) noexcept {
  if (!on_ && control(PidControl::enable_actuators, Sent::Kind::on)) return;
  if (start_if_wanted() || renew_if_due(now_ns)) return;
  send_worst(now_ns);
}

// Values are sent before the start, so that an effect never starts with an old force.
bool ReportScheduler::start_if_wanted() noexcept {
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    if (effect_[i].playing || !is_wanted(i)) {
      for (std::size_t value = 0; value < kValues; ++value)
        if (effect_of(value) == i) value_[value].is_told = false;
      continue;
    }
    for (std::size_t value = 0; value < kValues; ++value) {
      if (effect_of(value) == i && !value_[value].is_told && send_value(value, target_value(value))) return true;
    }
    if (operate(i, PidOperation::start)) return true;
  }
  return false;
}

bool ReportScheduler::renew_if_due(std::int64_t now_ns) noexcept {
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    const auto interval_ns = static_cast<std::int64_t>(1e9 * command_.restart_interval);
    const std::int64_t due_ns = interval_ns > 0 ? effect_[i].started_ns + interval_ns
                                : finite_       ? effect_[i].renew_ns
                                                : effect_[i].started_ns + kEndlessRenew;
    const bool due = effect_[i].playing && is_wanted(i) && now_ns >= due_ns;
    if (due && operate(i, PidOperation::start)) return true;
  }
  return false;
}

void ReportScheduler::send_worst(std::int64_t now_ns) noexcept {
  double worst = 0.0;
  std::size_t index = kValues;
  for (std::size_t i = 0; i < kValues; ++i) {
    if (!effect_[effect_of(i)].playing) continue;
    const double waited = static_cast<double>(std::max<std::int64_t>(1, now_ns - value_[i].since_ns));
    const double need = difference(value_[i].current, target_value(i)) * waited;
    if (need <= worst || is_current(i, target_value(i))) continue;
    worst = need;
    index = i;
  }
  if (index < kValues) send_value(index, target_value(index));
}

// True if the device already has this setting. The encoded bytes are compared, so that a difference below the device's
// resolution does not count.
bool ReportScheduler::is_current(std::size_t value, const PidCondition& setting) noexcept {
  if (encode(value, setting) != value_[value].sent || has_wrong_direction(value, setting)) return false;
  value_[value].current = setting;
  return true;
}

// Sends the value. Returns false if the device already has this value or does not support it.
bool ReportScheduler::send_value(std::size_t value, const PidCondition& setting) noexcept {
  const HidBytes report = encode(value, setting);
  if (report.size == 0 || is_current(value, setting)) return false;
  if (has_wrong_direction(value, setting)) {
    // The force is made zero before it is reversed, so that it is never strong in the wrong direction.
    if (reverse(value)) return true;
    return send_value(value, kZero);
  }
  sent_ = {Sent::Kind::value, value, setting, report};
  return true;
}

bool ReportScheduler::has_wrong_direction(std::size_t value, const PidCondition& setting) const noexcept {
  if (value > 1 || style_.signs != SignStyle::direction || setting.coefficient == 0.0) return false;
  return effect_[value].is_reversed != (setting.coefficient < 0.0);
}

// Reverses the direction of a constant force that is zero. Returns false if it is not zero yet.
bool ReportScheduler::reverse(std::size_t value) noexcept {
  if (encode(value, kZero) != value_[value].sent) return false;
  const auto effect = static_cast<StickEffect>(value);
  PidEffectSettings settings = settings_of(effect, effect_[value].block, style_, finite_ ? kEffectDuration : kForever);
  settings.is_reversed = !effect_[value].is_reversed;
  sent_ = {Sent::Kind::reverse, value, {}, encode_set_effect(pid_, settings)};
  return true;
}

bool ReportScheduler::operate(std::size_t effect, PidOperation operation) noexcept {
  const HidBytes report = encode_operation(pid_, effect_[effect].block, operation, kOnce);
  const auto kind = operation == PidOperation::stop ? Sent::Kind::stop : Sent::Kind::start;
  if (report.size == 0) return false;
  sent_ = {kind, effect, {}, report};
  return true;
}

bool ReportScheduler::control(PidControl control, Sent::Kind kind) noexcept {
  const HidBytes report = encode_control(pid_, control);
  if (report.size == 0) return false;
  sent_ = {kind, 0, {}, report};
  return true;
}

void ReportScheduler::arrived(std::int64_t now_ns) noexcept {
  switch (sent_.kind) {
    case Sent::Kind::nothing:
      break;
    case Sent::Kind::setting:
      ++settings_sent_;
      break;
    case Sent::Kind::on:
      on_ = true;
      switched_on_ns_ = now_ns;
      break;
    case Sent::Kind::off:
      on_ = false;
      break;
    case Sent::Kind::all_stopped:
      for (Effect& effect : effect_) effect.playing = false;
      break;
    case Sent::Kind::start:
      started(effect_[sent_.index], sent_.index, now_ns);
      break;
    case Sent::Kind::stop:
      effect_[sent_.index].playing = false;
      break;
    case Sent::Kind::reverse:
      effect_[sent_.index].is_reversed = !effect_[sent_.index].is_reversed;
      break;
    case Sent::Kind::value:
      value_[sent_.index] = {sent_.setting, sent_.report, now_ns, true};
      break;
  }
  sent_ = {};
}

void ReportScheduler::started(Effect& effect, std::size_t index, std::int64_t now_ns) noexcept {
  const std::int64_t stagger = effect.playing ? 0 : static_cast<std::int64_t>(index) * kRenew / 4;
  effect.playing = true;
  effect.started_ns = now_ns;
  effect.renew_ns = now_ns + kRenew - stagger;
}

// A state report may be older than the last command, so a report that contradicts the command is ignored for
// kReportLag.
StickFault ReportScheduler::on_report(const PidStatus& status, std::int64_t now_ns) noexcept {
  const PidState& layout = pid_.state;
  said_power_ = said_power_ || status.actuator_power;
  said_safety_switch_ = said_safety_switch_ || status.safety_switch;
  said_actuators_ = said_actuators_ || status.actuators_enabled;
  const StickFault doubted = doubt_;
  doubt_ = !status.actuator_power  ? StickFault::no_power
           : !status.safety_switch ? StickFault::safety_switch
                                   : StickFault::none;
  if (!command_.enabled) return StickFault::none;
  if (said_power_ && !status.actuator_power) return StickFault::no_power;
  if (said_safety_switch_ && !status.safety_switch) return StickFault::safety_switch;
  // Power that comes back would bring back a force without a person. Some firmware may say it at each switching on.
  const bool was_on = on_ && now_ns - switched_on_ns_ > kReportLag;
  if (doubted != StickFault::none && doubt_ == StickFault::none && was_on) return doubted;
  const bool is_off = said_actuators_ && !status.actuators_enabled;
  if (is_off && has_switch() && was_on) {
    on_ = false;
    return StickFault::switched_off;
  }
  if (!layout.playing.exists() || !layout.block.exists() || status.playing) return StickFault::none;
  expire(now_ns);
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    Effect& effect = effect_[i];
    if (effect.block != status.block || !effect.playing || !is_wanted(i)) continue;
    if (now_ns - effect.started_ns <= kReportLag) continue;
    effect.playing = false;
    return StickFault::effect_stopped;
  }
  return StickFault::none;
}

}  // namespace gearshift::haptics
