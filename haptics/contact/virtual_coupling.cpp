#include "haptics/contact/virtual_coupling.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gearshift::haptics {
namespace {

using glm::dvec2;

// Mean penetration [m] into the wall during the coming period. In the comments below, s0 is the present penetration and
// s1 the predicted penetration at the end of the period; both are negative outside the wall.
dvec2 mean_penetration(dvec2 now, dvec2 then, double depth_now, double depth_then, dvec2 step) noexcept {
  if (depth_now > 0.0 && depth_then > 0.0) return 0.5 * (now + then);
  if (depth_then > 0.0) {  // entering the wall: mean depth s1^2 / (2 (s1 - s0)); -s0 is the distance to the wall
    const dvec2 normal = then / depth_then;
    const double travel = std::max(glm::dot(step, normal), depth_then);
    return then * (0.5 * depth_then / travel);
  }
  const dvec2 normal = now / depth_now;  // leaving the wall: mean depth s0^2 / (2 (s0 - s1))
  const double travel = std::max(-glm::dot(step, normal), depth_now);
  return now * (0.5 * depth_now / travel);
}

}  // namespace

double solved_force_inside(const Coupling& coupling, double begin, double free_end, double compliance) noexcept {
  const double k = coupling.stiffness, d = coupling.damping / coupling.period;
  return (0.5 * k * (begin + free_end) + d * (free_end - begin)) / (1.0 + compliance * (0.5 * k + d));
}

double solved_force(const Coupling& coupling, double begin, double free_end, double compliance) noexcept {
  const double k = coupling.stiffness, d = coupling.damping / coupling.period;
  if (begin <= 0.0 && free_end <= 0.0) return 0.0;
  if (begin < 0.0) {  // entering the wall: `end` solves stiff end^2 - p end + begin free_end = 0
    const double stiff = 1.0 + compliance * (0.5 * k + d);
    const double p = free_end + begin + compliance * d * begin;
    const double end = (p + std::sqrt(p * p - 4.0 * stiff * begin * free_end)) / (2.0 * stiff);
    return (free_end - end) / compliance;
  }
  const double inside = solved_force_inside(coupling, begin, free_end, compliance);
  if (free_end - compliance * inside >= 0.0) return std::max(0.0, inside);
  // Leaving the wall: return exactly the energy stored in the spring, F (begin - end) = K begin^2 / 2.
  const double travel_out = begin - free_end;
  return k * begin * begin / (travel_out + std::sqrt(travel_out * travel_out + 2.0 * compliance * k * begin * begin));
}

ContactForce contact_force(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
                           const LeverMotion& motion) noexcept {
  const bool predicts = coupling.hold == ContactHold::half_sample;
  const double horizon = predicts ? coupling.period * (1.0 + 2.0 * coupling.delay) : 0.0;
  const dvec2 step = motion.velocity * horizon;
  const dvec2 predicted = motion.position + step;
  const Proxy ahead = move_proxy(gate, passage, proxy, predicted, 0.0);
  const dvec2 now = motion.position - proxy.position;
  const dvec2 then = predicted - ahead.position;
  ContactForce out{{0.0, 0.0}, 0.5 * (proxy.position + ahead.position)};
  if (now == dvec2(0.0) && then == dvec2(0.0)) return out;  // without the square roots
  const double depth_now = glm::length(now);
  const double depth_then = glm::length(then);
  if (depth_now == 0.0 && depth_then == 0.0) return out;

  out.force = -coupling.stiffness * mean_penetration(now, then, depth_now, depth_then, step);
  if (depth_now == 0.0) return out;
  const dvec2 inward = now / depth_now;
  out.force -= coupling.damping * glm::dot(motion.velocity, inward) * inward;
  out.force -= std::max(0.0, glm::dot(out.force, inward)) * inward;
  return out;
}

ContactForce contact_force(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
                           const ObservedMotion& motion) noexcept {
  const Proxy begin = move_proxy(gate, passage, proxy, motion.position, 0.0);
  const Proxy end = move_proxy(gate, passage, begin, motion.end, 0.0);
  const dvec2 now = motion.position - begin.position;
  const dvec2 then = motion.end - end.position;
  const double depth_now = glm::length(now);
  const double depth_then = glm::length(then);
  ContactForce out{{0.0, 0.0}, 0.5 * (begin.position + end.position)};
  if (depth_now == 0.0 && depth_then == 0.0) return out;

  const dvec2 inward = depth_then > 0.0 ? then / depth_then : now / depth_now;
  const double x0 = depth_now > 0.0 ? glm::dot(now, inward) : glm::dot(motion.position - end.position, inward);
  const double x1 = depth_then > 0.0 ? depth_then : glm::dot(motion.end - begin.position, inward);
  const double compliance = glm::dot(inward * inward, motion.compliance);
  out.force = -solved_force(coupling, x0, x1, compliance) * inward;
  return out;
}

const char* file_key(ContactHold hold) noexcept {
  static constexpr const char* kNames[] = {"automatic", "zero_order", "half_sample", "observer"};
  return kNames[static_cast<int>(hold)];
}

const char* to_string(ContactHold hold) noexcept {
  static constexpr const char* kTexts[] = {"automatic hold", "zero-order hold", "half-sample hold", "observer hold"};
  return kTexts[static_cast<int>(hold)];
}

}  // namespace gearshift::haptics
