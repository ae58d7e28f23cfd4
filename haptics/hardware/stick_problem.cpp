#include "haptics/hardware/stick_problem.h"

namespace gearshift::haptics {
namespace {

constexpr std::uint64_t bit_of(std::size_t kind) noexcept {
  return std::uint64_t{1} << kind;
}
constexpr std::uint64_t reported_bit_of(std::size_t kind) noexcept {
  return bit_of(kind) << 32;
}

// A stick without power moves, or rests, as if a strong hand held it.
constexpr const char* kIfNotFelt = "; if you felt no force, check the stick's power supply and its safety switch";

std::string sentence(StickProblem problem, std::int64_t a, std::int64_t b) {
  switch (problem) {
    case StickProblem::wrong_length:
      return "the stick sends a report of " + std::to_string(a) + " bytes, but its descriptor declares " +
             std::to_string(b) + "; the report is ignored";
    case StickProblem::unknown_report:
      return "the stick sends report " + std::to_string(a) +
             ", which its descriptor does not define; the report is ignored";
    case StickProblem::frozen:
      return "the stick's position has not changed for " + std::to_string(a) +
             " s while the force changed; its readings are ignored until the position changes" + kIfNotFelt;
    case StickProblem::faded_out:
      return "the stick's position has not changed for " + std::to_string(a) +
             " s under force; the motors are off until you turn them on again" + kIfNotFelt;
    case StickProblem::position_jump:
      return "the stick's position jumped by " + std::to_string(a) + " % of its range between two reports";
    case StickProblem::switched_off:
      return "the stick switched its motors off by itself; they stay off until you turn them on again";
    case StickProblem::effect_stopped:
      return "the stick stopped an effect by itself; the effect was started again";
    case StickProblem::no_power:
      return "the stick reported that its motors have no power, so they are off; check its power supply, then turn "
             "them "
             "on "
             "again";
    case StickProblem::safety_switch:
      return "the stick reported that its safety switch is open, so its motors are off; close the switch, then turn "
             "them "
             "on again";
    case StickProblem::output_stuck:
      return "the stick accepts no output; its last force ends by itself";
    case StickProblem::slow_output:
      return "the stick takes " + std::to_string(a) + " ms per output, but responded after " + std::to_string(b) +
             " ms when it was calibrated; the motors are off until you turn them on again";
    case StickProblem::reversed:
      return "the stick pushes the other way than when it was calibrated; the motors are off until you turn them on "
             "again; run: gearshift devices --calibrate";
    case StickProblem::silent:
      return "the lever does not follow the stick's forces; the motors are off until you turn them on again; check the "
             "stick's power supply and its safety switch, or run: gearshift devices --calibrate";
    case StickProblem::overpowered:
      return "the lever moved by " + std::to_string(a) + " mm against the stick's full force" + kIfNotFelt;
    case StickProblem::no_commands:
      break;
  }
  return "no force was commanded for " + std::to_string(a) + " ms; the motors are off until you turn them on again";
}

}  // namespace

void StickProblems::raise(StickProblem problem, std::int64_t a, std::int64_t b) noexcept {
  const auto kind = static_cast<std::size_t>(problem);
  if ((raised_and_reported_.load(std::memory_order_relaxed) & bit_of(kind)) != 0) return;
  detail_[kind].a.store(a, std::memory_order_relaxed);
  detail_[kind].b.store(b, std::memory_order_relaxed);
  raised_and_reported_.fetch_or(bit_of(kind), std::memory_order_release);
}

void StickProblems::raise_again(StickProblem problem) noexcept {
  const auto kind = static_cast<std::size_t>(problem);
  raised_and_reported_.fetch_and(~reported_bit_of(kind), std::memory_order_relaxed);
  raise(problem);
}

void StickProblems::reset() noexcept {
  raised_and_reported_.store(0, std::memory_order_relaxed);
}

std::optional<std::string> StickProblems::take() {
  std::uint64_t now = raised_and_reported_.load(std::memory_order_acquire);
  const auto is_unreported = [&now](std::size_t kind) {
    return (now & bit_of(kind)) != 0 && (now & reported_bit_of(kind)) == 0;
  };
  for (std::size_t kind = 0; kind < kStickProblems; ++kind) {
    while (is_unreported(kind)) {
      if (!raised_and_reported_.compare_exchange_weak(now, now | reported_bit_of(kind), std::memory_order_acquire))
        continue;
      return sentence(static_cast<StickProblem>(kind), detail_[kind].a.load(std::memory_order_relaxed),
                      detail_[kind].b.load(std::memory_order_relaxed));
    }
  }
  return std::nullopt;
}

}  // namespace gearshift::haptics
