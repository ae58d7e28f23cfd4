// Chooses the next output report that brings a stick closer to the current command: one report at a time, most
// important first. Pure logic without a clock or a device.
//
//   1  off        after release() or while disabled: actuators off, each effect stopped, values to zero
//                 (not "stop all": firmware may take it for a switch, ignore it, or forget its effects)
//   2  on         actuators on; for each effect needed but not playing: first its values, then its start
//   3  renew      an effect that has played for kRenewAfter is started again, long before it ends
//   4  values     the value with the largest product of error and waiting time, so that no value waits forever
//   5  nothing    if nothing has changed
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "haptics/files/parameter.h"
#include "haptics/hardware/stick_command.h"
#include "haptics/hid/pid_report.h"

namespace gearshift::haptics {

inline constexpr double kEffectDuration = 0.3;  // [s] an effect ends after this time unless it is renewed
inline constexpr double kRenewAfter = 0.1;      // [s] time after an effect's start at which it is started again

enum class StickEffect : std::uint8_t { constant_x, constant_y, spring, damper };
inline constexpr std::size_t kStickEffects = 4;
PidEffect kind_of(StickEffect effect) noexcept;
using StickBlocks = std::array<int, kStickEffects>;  // effect block index per effect; kNoBlock: not created

// How the sign of a constant force is sent. Some firmware loses the sign of the magnitude while the effect plays.
enum class SignStyle : std::uint8_t { magnitude, direction };
const char* file_key(SignStyle style) noexcept;
constexpr SignStyle last_value(SignStyle) {
  return SignStyle::direction;
}

// How the effects name their axes and signs, as measured by the calibration. Aligned, because clang locks an atomic of
// this size otherwise, and the haptic cycle must not.
struct alignas(4) StickStyle {
  AxisStyle constants = AxisStyle::direction, conditions = AxisStyle::bits;
  SignStyle signs = SignStyle::magnitude;
  bool operator==(const StickStyle&) const = default;
};

template <>
inline constexpr Parameter<StickStyle, AxisStyle, SignStyle> kParameters<StickStyle>[] = {
    {&StickStyle::constants, "constants", "constants_by", FileRange{}, "how they name their axes"},
    {&StickStyle::conditions, "conditions", "conditions_by", FileRange{}, ""},
    {&StickStyle::signs, "signs", "signs_by", FileRange{}, "of constant forces"},
};
static_assert(DescribesAll<StickStyle>);

// The reports that set an effect's parameters, in order; all values are zero afterwards.
class EffectReports {
 public:
  // `duration` [s] as in PidEffectSettings
  EffectReports(const PidLayout& pid, StickEffect effect, int block, StickStyle style, double duration) noexcept;
  std::span<const HidBytes> all() const noexcept { return {reports_.data(), size_}; }
  bool has_settings() const noexcept { return has_settings_; }  // false: the device's reports cannot hold the block

 private:
  void add(const HidBytes& report) noexcept;

  std::array<HidBytes, 5> reports_;
  std::size_t size_ = 0;
  bool has_settings_ = false;
};

// A fault found in a device's state report.
enum class StickFault : std::uint8_t { none, switched_off, effect_stopped, no_power, safety_switch };

class ReportScheduler {
 public:
  explicit ReportScheduler(const PidLayout& pid) noexcept : pid_(pid) {}  // pid must outlive the scheduler

  // Starts from the state in which prepare_stick() leaves the device: actuators off, nothing playing, every value zero.
  // `finite`: whether effects end by themselves after kEffectDuration.
  void begin(const StickBlocks& blocks, bool finite, StickStyle style) noexcept;
  void set_style(StickStyle style) noexcept;  // switches the motors off until it has been sent

  void set_command(const StickCommand& command) noexcept { command_ = command; }
  void release() noexcept { released_ = true; }  // switches the motors off first, whatever the command says

  // Returns the next report; size 0: none. Must be called after the previous report has arrived; otherwise the previous
  // report counts as lost and is scheduled again.
  HidBytes next(std::int64_t now_ns) noexcept;
  void arrived(std::int64_t now_ns) noexcept;
  StickStyle style() const noexcept { return style_; }  // whose settings have been sent
  StickFault on_report(const PidStatus& status, std::int64_t now_ns) noexcept;

  // Forces, springs and dampers that the device renders now.
  std::array<double, 2> force() const noexcept;      // [1] constant forces
  std::array<PidSpring, 2> spring() const noexcept;  // coefficient 0: none
  std::array<double, 2> damper() const noexcept;     // [1] coefficients
  // A reason, from the newest state report, why the stick may be silent.
  StickFault doubt() const noexcept { return doubt_; }
  bool drives() const noexcept;  // the actuators are on and an effect is playing, as far as is known

 private:
  // The values sent to the device: constant X, Y, spring X, Y, damper X, Y. The magnitude of a constant force is stored
  // as its coefficient.
  static constexpr std::size_t kValues = 6;
  static constexpr std::size_t effect_of(std::size_t value) noexcept { return value < 2 ? value : value / 2 + 1; }

  struct Effect {
    int block = kNoBlock;
    bool playing = false;
    bool is_reversed = false;  // its direction, with SignStyle::direction
    std::int64_t started_ns = 0;
    std::int64_t renew_ns = 0;  // staggered, so that effects are not all renewed at once
  };
  struct Value {
    PidCondition current;
    HidBytes sent;
    std::int64_t since_ns = 0;
    bool is_told = false;  // since the effect was wanted; a value that changes in every cycle must not delay its start
  };
  struct Sent {  // the report in transit
    enum class Kind : std::uint8_t { nothing, setting, on, off, all_stopped, start, stop, reverse, value };
    Kind kind = Kind::nothing;
    std::size_t index = 0;
    PidCondition setting;
    HidBytes report;
  };

  bool supports(PidControl control) const noexcept {
    return pid_.device_control.control.supports(static_cast<std::size_t>(control));
  }
  bool has_switch() const noexcept {
    return supports(PidControl::enable_actuators) && supports(PidControl::disable_actuators);
  }
  bool plays() const noexcept;
  bool is_wanted(std::size_t effect) const noexcept;
  PidCondition target_value(std::size_t value) const noexcept;
  HidBytes encode(std::size_t value, const PidCondition& setting) const noexcept;

  void expire(std::int64_t now_ns) noexcept;
  bool lacks_style() const noexcept { return is_style_mixed_ || wanted_style_ != style_; }
  bool send_setting() noexcept;
  bool has_wrong_direction(std::size_t value, const PidCondition& setting) const noexcept;
  bool reverse(std::size_t value) noexcept;
  void next_off() noexcept;
  void next_on(std::int64_t now_ns) noexcept;
  bool start_if_wanted() noexcept;
  bool renew_if_due(std::int64_t now_ns) noexcept;
  void send_worst(std::int64_t now_ns) noexcept;
  bool is_current(std::size_t value, const PidCondition& setting) noexcept;
  bool send_value(std::size_t value, const PidCondition& setting) noexcept;
  bool operate(std::size_t effect, PidOperation operation) noexcept;
  bool control(PidControl control, Sent::Kind kind) noexcept;
  void started(Effect& effect, std::size_t index, std::int64_t now_ns) noexcept;

  const PidLayout& pid_;
  StickCommand command_;
  bool released_ = false;
  bool finite_ = true;
  StickStyle style_, wanted_style_;
  std::size_t settings_sent_ = 0;  // reports of the wanted style
  bool is_style_mixed_ = false;    // the stick has some settings of a style that was not sent whole
  // A device that never set a bit of its state report may not use it.
  bool said_power_ = false, said_safety_switch_ = false, said_actuators_ = false;
  StickFault doubt_ = StickFault::none;
  bool on_ = false;  // actuators
  std::int64_t switched_on_ns_ = 0;
  std::array<Effect, kStickEffects> effect_{};
  std::array<Value, kValues> value_{};
  Sent sent_;
};

}  // namespace gearshift::haptics
