#include "haptics/contact/virtual_coupling.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace gearshift {
namespace {

using glm::dvec2;

// Mean penetration over the coming hold, from the penetration now (s0) and predicted (s1). [m]
dvec2 mean_penetration(dvec2 now, dvec2 then, double depth_now, double depth_then, dvec2 step) noexcept {
  if (depth_now > 0.0 && depth_then > 0.0) return 0.5 * (now + then);
  if (depth_then > 0.0) {  // entry: s1^2 / (2 (s1 - s0)), s0 <= 0 the way still to go
    const dvec2 normal = then / depth_then;
    const double travel = std::max(glm::dot(step, normal), depth_then);
    return then * (0.5 * depth_then / travel);
  }
  const dvec2 normal = now / depth_now;  // exit: s0^2 / (2 (s0 - s1))
  const double travel = std::max(-glm::dot(step, normal), depth_now);
  return now * (0.5 * depth_now / travel);
}

}  // namespace

Coupled couple(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
               const LeverMotion& motion) noexcept {
  const dvec2 step = motion.velocity * coupling.horizon;
  const dvec2 predicted = motion.position + step;
  const Proxy ahead = move_proxy(gate, passage, proxy, predicted, 0.0);
  const dvec2 now = motion.position - proxy.position;
  const dvec2 then = predicted - ahead.position;
  const double depth_now = glm::length(now);
  const double depth_then = glm::length(then);
  Coupled out{{0.0, 0.0}, 0.5 * (proxy.position + ahead.position)};
  if (depth_now == 0.0 && depth_then == 0.0) return out;

  out.force = -coupling.stiffness * mean_penetration(now, then, depth_now, depth_then, step);
  if (depth_now == 0.0) return out;
  const dvec2 inward = now / depth_now;
  out.force -= coupling.damping * glm::dot(motion.velocity, inward) * inward;
  out.force -= std::max(0.0, glm::dot(out.force, inward)) * inward;
  return out;
}

}  // namespace gearshift
