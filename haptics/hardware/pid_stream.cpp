#include "haptics/hardware/pid_stream.h"

#include <algorithm>
#include <cmath>

namespace gearshift {
namespace {

constexpr std::int64_t kDuration = static_cast<std::int64_t>(1e9 * kEffectDuration);  // [ns]
constexpr std::int64_t kRenew = static_cast<std::int64_t>(1e9 * kRenewAfter);         // [ns]
constexpr std::int64_t kBelieve = 50'000'000;  // [ns] after a command, before a state report that denies it is believed
constexpr int kOnce = 1;                       // loops

double difference(const PidCondition& a, const PidCondition& b) noexcept {
  return std::max({std::abs(a.centre - b.centre), std::abs(a.dead_band - b.dead_band),
                   std::abs(a.coefficient - b.coefficient), std::abs(a.saturation - b.saturation)});
}

constexpr PidCondition kZero{};

}  // namespace

void PidStream::begin(const StickBlocks& blocks, bool finite) noexcept {
  wish_ = {};
  released_ = false;
  finite_ = finite;
  on_ = !has_switch();
  sent_ = {};
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    effect_[i] = {};
    effect_[i].block = blocks[i];
  }
  for (std::size_t i = 0; i < kValues; ++i) value_[i] = {kZero, encode(i, kZero), 0};
}

bool PidStream::plays() const noexcept {
  return std::any_of(effect_.begin(), effect_.end(), [](const Effect& effect) { return effect.playing; });
}

bool PidStream::drives() const noexcept {
  return on_ && plays();
}

std::array<double, 2> PidStream::force() const noexcept {
  std::array<double, 2> force{};
  for (std::size_t i = 0; i < 2; ++i) {
    if (on_ && effect_[i].playing) force[i] = value_[i].is.coefficient;
  }
  return force;
}

std::array<PidSpring, 2> PidStream::spring() const noexcept {
  std::array<PidSpring, 2> spring{};
  if (!on_ || !effect_[static_cast<std::size_t>(StickEffect::spring)].playing) return spring;
  for (std::size_t i = 0; i < 2; ++i) {
    const PidCondition& is = value_[2 + i].is;
    spring[i] = {is.centre, is.dead_band, is.coefficient, is.saturation};
  }
  return spring;
}

// Constant forces always, so that the first newton is one report away.
bool PidStream::is_wanted(std::size_t effect) const noexcept {
  if (effect_[effect].block == kNoBlock) return false;
  switch (static_cast<StickEffect>(effect)) {
    case StickEffect::spring:
      return wish_.spring[0].coefficient != 0.0 || wish_.spring[1].coefficient != 0.0;
    case StickEffect::damper:  // it goes on with nothing: to begin anew takes three reports, in the moment of a contact
      return wish_.damper[0] != 0.0 || wish_.damper[1] != 0.0 || effect_[effect].playing;
    default:
      return true;
  }
}

PidCondition PidStream::wished(std::size_t value) const noexcept {
  PidCondition setting;
  const PidSpring& spring = wish_.spring[value % 2];
  switch (static_cast<StickEffect>(effect_of(value))) {
    case StickEffect::spring:
      return {spring.centre, spring.dead_band, spring.coefficient, spring.saturation};
    case StickEffect::damper:
      setting.coefficient = wish_.damper[value % 2];
      return setting;
    default:
      setting.coefficient = wish_.constant[value];
      return setting;
  }
}

HidBytes PidStream::encode(std::size_t value, const PidCondition& setting) const noexcept {
  const int block = effect_[effect_of(value)].block;
  if (value < 2) return encode_constant(pid_, block, setting.coefficient);
  return encode_condition(pid_, block, static_cast<int>(value % 2), setting);
}

HidBytes PidStream::next(std::int64_t now_ns) noexcept {
  sent_ = {};
  expire(now_ns);
  if (released_ || !wish_.enabled) {
    next_off();
    if (sent_.report.size > 0) return sent_.report;
    released_ = false;
  }
  if (wish_.enabled) next_on(now_ns);
  return sent_.report;
}

// What the device has ended by itself by now.
void PidStream::expire(std::int64_t now_ns) noexcept {
  for (Effect& effect : effect_) {
    if (finite_ && now_ns - effect.started_ns > kDuration) effect.playing = false;
  }
}

// The forces of a device without switches end first, then what plays them.
void PidStream::next_off() noexcept {
  if (on_ && has_switch() && control(PidControl::disable_actuators, Sent::What::off)) return;
  if (plays() && control(PidControl::stop_all, Sent::What::all_stopped)) return;
  for (std::size_t i = 0; i < kValues; ++i) {
    if (tell(i, kZero)) return;
  }
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    if (effect_[i].playing && operate(i, PidOperation::stop)) return;
  }
}

void PidStream::next_on(std::int64_t now_ns) noexcept {
  if (!on_ && control(PidControl::enable_actuators, Sent::What::on)) return;
  if (start_wanted() || renew_due(now_ns)) return;
  tell_worst(now_ns);
}

// It must not begin with an old force.
bool PidStream::start_wanted() noexcept {
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    if (effect_[i].playing || !is_wanted(i)) continue;
    for (std::size_t value = 0; value < kValues; ++value) {
      if (effect_of(value) == i && tell(value, wished(value))) return true;
    }
    if (operate(i, PidOperation::start)) return true;
  }
  return false;
}

bool PidStream::renew_due(std::int64_t now_ns) noexcept {
  if (!finite_) return false;
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    const bool due = effect_[i].playing && is_wanted(i) && now_ns >= effect_[i].renew_ns;
    if (due && operate(i, PidOperation::start)) return true;
  }
  return false;
}

void PidStream::tell_worst(std::int64_t now_ns) noexcept {
  double worst = 0.0;
  std::size_t which = kValues;
  for (std::size_t i = 0; i < kValues; ++i) {
    if (!effect_[effect_of(i)].playing) continue;
    const double waited = static_cast<double>(std::max<std::int64_t>(1, now_ns - value_[i].since_ns));
    const double need = difference(value_[i].is, wished(i)) * waited;
    if (need <= worst || is_told(i, wished(i))) continue;
    worst = need;
    which = i;
  }
  if (which < kValues) tell(which, wished(which));
}

// By its bytes: what differs by less than the device can tell is the same.
bool PidStream::is_told(std::size_t value, const PidCondition& setting) noexcept {
  if (encode(value, setting) != value_[value].told) return false;
  value_[value].is = setting;
  return true;
}

// False where the device has that already, or knows no such thing.
bool PidStream::tell(std::size_t value, const PidCondition& setting) noexcept {
  const HidBytes report = encode(value, setting);
  if (report.size == 0 || is_told(value, setting)) return false;
  sent_ = {Sent::What::value, value, setting, report};
  return true;
}

bool PidStream::operate(std::size_t effect, PidOperation operation) noexcept {
  const HidBytes report = encode_operation(pid_, effect_[effect].block, operation, kOnce);
  const auto what = operation == PidOperation::stop ? Sent::What::stop : Sent::What::start;
  if (report.size == 0) return false;
  sent_ = {what, effect, {}, report};
  return true;
}

bool PidStream::control(PidControl control, Sent::What what) noexcept {
  const HidBytes report = encode_control(pid_, control);
  if (report.size == 0) return false;
  sent_ = {what, 0, {}, report};
  return true;
}

void PidStream::arrived(std::int64_t now_ns) noexcept {
  switch (sent_.what) {
    case Sent::What::nothing:
      break;
    case Sent::What::on:
      on_ = true;
      switched_on_ns_ = now_ns;
      break;
    case Sent::What::off:
      on_ = false;
      break;
    case Sent::What::all_stopped:
      for (Effect& effect : effect_) effect.playing = false;
      break;
    case Sent::What::start:
      started(effect_[sent_.which], sent_.which, now_ns);
      break;
    case Sent::What::stop:
      effect_[sent_.which].playing = false;
      break;
    case Sent::What::value:
      value_[sent_.which] = {sent_.setting, sent_.report, now_ns};
      break;
  }
  sent_ = {};
}

void PidStream::started(Effect& effect, std::size_t which, std::int64_t now_ns) noexcept {
  const std::int64_t stagger = effect.playing ? 0 : static_cast<std::int64_t>(which) * kRenew / 4;
  effect.playing = true;
  effect.started_ns = now_ns;
  effect.renew_ns = now_ns + kRenew - stagger;
}

// A report may tell of the time before the last command.
StickLapse PidStream::heard(const PidStatus& status, std::int64_t now_ns) noexcept {
  const PidState& told = pid_.state;
  if (!wish_.enabled) return StickLapse::none;
  if (!status.actuator_power) return StickLapse::no_power;
  if (!status.safety_switch) return StickLapse::safety_switch;
  const bool is_off = told.actuators_enabled.exists() && !status.actuators_enabled;
  if (is_off && has_switch() && on_ && now_ns - switched_on_ns_ > kBelieve) {
    on_ = false;
    return StickLapse::switched_off;
  }
  if (!told.playing.exists() || !told.block.exists() || status.playing) return StickLapse::none;
  expire(now_ns);
  for (std::size_t i = 0; i < kStickEffects; ++i) {
    Effect& effect = effect_[i];
    if (effect.block != status.block || !effect.playing || !is_wanted(i)) continue;
    if (now_ns - effect.started_ns <= kBelieve) continue;
    effect.playing = false;
    return StickLapse::effect_stopped;
  }
  return StickLapse::none;
}

}  // namespace gearshift
