// Which report goes out next, so that a stick comes to do what is wished: one report at a time, what matters most first.
// Pure: it knows neither a clock nor a device.
//
//   1  off        actuators off, all stopped, values to zero: when released, or when nothing is wished
//   2  on         actuators on; an effect that is wished and does not play: its values first, then its start
//   3  go on      an effect that has played for kRenewAfter is started again, long before it ends
//   4  values     the one with the largest error times the time that it has waited, so that none starves
//   5  nothing    where nothing has changed
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "haptics/hardware/pid_wish.h"
#include "haptics/hid/pid_report.h"

namespace gearshift {

inline constexpr double kEffectDuration = 0.3;  // [s] the most that a device goes on by itself
inline constexpr double kRenewAfter = 0.1;      // [s] of an effect's time

// The effects that a stick is asked for.
enum class StickEffect : std::uint8_t { constant_x, constant_y, spring, damper };
inline constexpr std::size_t kStickEffects = 4;
using StickBlocks = std::array<int, kStickEffects>;  // of each; kNoBlock: it has none

// What a state report says that was not wished.
enum class StickLapse : std::uint8_t { none, switched_off, effect_stopped, no_power, safety_switch };

class PidStream {
 public:
  explicit PidStream(const PidLayout& pid) noexcept : pid_(pid) {}  // which must outlive it

  // The device as prepare_stick() leaves it: actuators off, nothing plays, every value zero.
  // finite: effects end by themselves after kEffectDuration.
  void begin(const StickBlocks& blocks, bool finite) noexcept;

  void want(const PidWish& wish) noexcept { wish_ = wish; }
  void release() noexcept { released_ = true; }  // off first, whatever is wished

  // Asked for when the last one has arrived. One that is asked for before counts as lost, and is thought of again.
  HidBytes next(std::int64_t now_ns) noexcept;
  void arrived(std::int64_t now_ns) noexcept;
  StickLapse heard(const PidStatus& status, std::int64_t now_ns) noexcept;

  // As the device has them.
  std::array<double, 2> force() const noexcept;      // [1] constant forces
  std::array<PidSpring, 2> spring() const noexcept;  // coefficient 0: none
  bool drives() const noexcept;                      // actuators on and something plays, as far as is known

 private:
  // Values: constant X, Y, spring X, Y, damper X, Y. A constant's magnitude is kept as a coefficient.
  static constexpr std::size_t kValues = 6;
  static constexpr std::size_t effect_of(std::size_t value) noexcept { return value < 2 ? value : value / 2 + 1; }

  struct Effect {
    int block = kNoBlock;
    bool playing = false;
    std::int64_t started_ns = 0;
    std::int64_t renew_ns = 0;  // staggered, so that they do not come all at once
  };
  struct Value {
    PidCondition is;
    HidBytes told;
    std::int64_t since_ns = 0;
  };
  struct Sent {  // what is under way
    enum class What : std::uint8_t { nothing, on, off, all_stopped, start, stop, value };
    What what = What::nothing;
    std::size_t which = 0;
    PidCondition setting;
    HidBytes report;
  };

  bool knows(PidControl control) const noexcept {
    return pid_.device_control.control.knows(static_cast<std::size_t>(control));
  }
  bool has_switch() const noexcept {
    return knows(PidControl::enable_actuators) && knows(PidControl::disable_actuators);
  }
  bool plays() const noexcept;
  bool is_wanted(std::size_t effect) const noexcept;
  PidCondition wished(std::size_t value) const noexcept;
  HidBytes encode(std::size_t value, const PidCondition& setting) const noexcept;

  void expire(std::int64_t now_ns) noexcept;
  void next_off() noexcept;
  void next_on(std::int64_t now_ns) noexcept;
  bool start_wanted() noexcept;
  bool renew_due(std::int64_t now_ns) noexcept;
  void tell_worst(std::int64_t now_ns) noexcept;
  bool is_told(std::size_t value, const PidCondition& setting) noexcept;
  bool tell(std::size_t value, const PidCondition& setting) noexcept;
  bool operate(std::size_t effect, PidOperation operation) noexcept;
  bool control(PidControl control, Sent::What what) noexcept;
  void started(Effect& effect, std::size_t which, std::int64_t now_ns) noexcept;

  const PidLayout& pid_;
  PidWish wish_;
  bool released_ = false;
  bool finite_ = true;
  bool on_ = false;  // actuators
  std::int64_t switched_on_ns_ = 0;
  std::array<Effect, kStickEffects> effect_{};
  std::array<Value, kValues> value_{};
  Sent sent_;
};

}  // namespace gearshift
