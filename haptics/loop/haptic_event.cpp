#include "haptics/loop/haptic_event.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "haptics/files/number_text.h"
#include "haptics/gate/gate.h"

namespace gearshift::haptics {
namespace {

constexpr std::int64_t kContactApart = 30'000'000;  // [ns] a touch after this time away from the wall is a new impact

bool has(const TraceSample& cycle, std::uint32_t flag) {
  return (cycle.out.flags & flag) != 0;
}

// [m/s] speed of the lever into the wall
double impact_speed(const HapticSnapshot& out) {
  const glm::dvec2 penetration = out.lever - out.proxy;
  return std::abs(glm::dot(out.velocity, penetration / glm::length(penetration)));
}

// [1] part of the tuned wall stiffness that the reversal limiter leaves; 1 before the first cycle
double stiffness_fraction(const TraceSample& cycle) {
  const double tuned = cycle.tuning.wall_stiffness;
  return tuned > 0.0 && cycle.out.wall_stiffness > 0.0 ? cycle.out.wall_stiffness / tuned : 1.0;
}

}  // namespace

std::string describe(const HapticEvent& event, bool push_estimated) {
  switch (event.kind) {
    case EventKind::gear_engaged:
      return gear_name(static_cast<int>(event.value)) + std::string(" engaged");
    case EventKind::gear_left:
      return gear_name(static_cast<int>(event.value)) + std::string(" disengaged");
    case EventKind::wall_contact:
      return "wall hit at " + fixed_text(event.value, 2) + " m/s";
    case EventKind::over_push_begin:
      return "over-push: " + fixed_text(event.value, 0) + (push_estimated ? " N, estimated" : " N");
    case EventKind::over_push_end:
      return "over-push ended";
    case EventKind::saturation_begin:
      return "saturated: " + fixed_text(event.value, 0) + " N requested";
    case EventKind::saturation_end:
      return "saturation ended";
    case EventKind::guard_changed:
      return describe(static_cast<GuardState>(static_cast<int>(event.value)));
    case EventKind::stiffness_lowered:
      return "chatter: wall softened to " + fixed_text(event.value, 0) + " N/m";
  }
  return "?";
}

void EventDetector::update(const TraceSample& now, std::vector<HapticEvent>& events) {
  if (now.out.cycle <= previous_.out.cycle) *this = {};
  const HapticSnapshot& out = now.out;
  const HapticSnapshot& before = previous_.out;
  const auto emit = [&](EventKind kind, double value) { events.push_back({kind, out.cycle, out.time_ns, value}); };
  const auto emit_change = [&](std::uint32_t flag, EventKind begin, EventKind end, double value) {
    if (has(now, flag) != has(previous_, flag)) emit(has(now, flag) ? begin : end, value);
  };
  if (out.gear != before.gear && before.gear != kNeutralGear) emit(EventKind::gear_left, before.gear);
  if (out.gear != before.gear && out.gear != kNeutralGear) emit(EventKind::gear_engaged, out.gear);
  emit_change(kFlagOverPush, EventKind::over_push_begin, EventKind::over_push_end, glm::length(out.f_h));
  emit_change(kFlagSaturated, EventKind::saturation_begin, EventKind::saturation_end,
              glm::length(out.wall_force + out.feel_force + out.load_force));
  if (has(now, kFlagContact) && out.time_ns - touched_ns_ > kContactApart)
    emit(EventKind::wall_contact, impact_speed(out));
  if (has(now, kFlagContact)) touched_ns_ = out.time_ns;
  if (stiffness_fraction(now) < stiffness_fraction(previous_)) emit(EventKind::stiffness_lowered, out.wall_stiffness);
  if (out.guard != before.guard) emit(EventKind::guard_changed, static_cast<double>(out.guard));
  previous_ = now;
}

}  // namespace gearshift::haptics
