#include "app/cabin/stage/boot.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gearshift::cabin {
namespace {

constexpr float kCollar = 0.058f;                 // [m] the collar height H in boot.h
constexpr glm::vec3 kPivot{0.0f, -0.030f, 0.0f};  // [m] the pivot P in boot.h

}  // namespace

void deform_boot(std::span<const engine::Vertex> rest, const glm::dquat& lever, std::vector<engine::Vertex>& out) {
  const glm::mat3 turn = glm::mat3_cast(glm::quat(lever));
  const glm::mat3 change = turn - glm::mat3(1.0f);
  out.resize(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const engine::Vertex& from = rest[i];
    engine::Vertex& to = out[i];
    to = from;
    const float t = std::clamp(from.position.y / kCollar, 0.0f, 1.0f);
    const float w = t * t * (3.0f - 2.0f * t);
    const float slope = 6.0f * t * (1.0f - t) / kCollar;  // dw/dy
    const glm::vec3 moved = change * (from.position - kPivot);
    to.position = from.position + w * moved;
    // Jacobian J of the bending map in boot.h: J = 1 + w (R - 1) + d grad(w)^T, with d = P + R (p - P) - p, which is
    // `moved`. A normal is transformed with the inverse transpose of J, a tangent with J.
    glm::mat3 jacobian = glm::mat3(1.0f) + w * change;
    jacobian[1] += slope * moved;
    to.normal = glm::normalize(glm::transpose(glm::inverse(jacobian)) * from.normal);
    const glm::vec3 along = jacobian * glm::vec3(from.tangent);
    to.tangent = glm::vec4(glm::normalize(along - to.normal * glm::dot(along, to.normal)), from.tangent.w);
  }
}

}  // namespace gearshift::cabin
