#include "haptics/gate/gate_feel.h"

#include <algorithm>
#include <cmath>

#include "haptics/gate/aisle.h"

namespace gearshift::haptics {
namespace {

// The buffer's potential is V = -force g(u) W(y). g rises smoothly from the buffer's inner edge to the closed wall, and
// its slope is zero at this wall. So a lever that is pressed into the wall at one y and leaves it at another y gains no
// energy. W is constant beyond the aisle's walls for the same reason.
struct Rise {
  double value, slope;  // g, dg/dx
};

Rise buffer_rise(const Buffer& buffer, double x) noexcept {
  const double width = buffer.wall - buffer.inner;  // [m] positive if the closed wall is on the right
  const double u = std::clamp((x - buffer.inner) / width, 0.0, 1.0);
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / width};
}

struct Turn {
  double shape, integral;  // w, W(y) [m]
};

// The buffer's deflection across the aisle, with peak 1. With slots on both sides it points away from the centre line
// and peaks at half_aisle / sqrt(5). With one slot it points towards this slot and peaks at the centre line.
Turn buffer_turn(const Buffer& buffer, double half_aisle, double y) noexcept {
  const double v = std::clamp(y / half_aisle, -1.0, 1.0);
  const double rest = 1.0 - v * v;
  if (buffer.forward_open && buffer.back_open) {
    const double norm = 25.0 * std::sqrt(5.0) / 16.0;  // 1 / (maximum of v (1 - v^2)^2), so that the peak is 1
    return {norm * v * rest * rest, norm * half_aisle * (1.0 - rest * rest * rest) / 6.0};
  }
  const double sign = buffer.forward_open ? 1.0 : -1.0;
  const double area = v * (1.0 - v * v * (2.0 / 3.0 - v * v / 5.0)) + sign * 8.0 / 15.0;
  return {sign * rest * rest, sign * half_aisle * area};
}

glm::dvec2 buffer_force(const Gate& gate, const Buffer& buffer, glm::dvec2 p) noexcept {
  const bool inside = buffer.wall < buffer.inner ? p.x < buffer.inner : p.x > buffer.inner;
  if (!inside) return {0.0, 0.0};
  const Rise rise = buffer_rise(buffer, p.x);
  const Turn turn = buffer_turn(buffer, gate.half_aisle, p.y);
  return {buffer.force * rise.slope * turn.integral, buffer.force * rise.value * turn.shape};
}

double shift_sign(double y) noexcept {
  return y < 0.0 ? -1.0 : 1.0;
}

const FeelCurve& shift_curve(const Gate& gate, glm::dvec2 p) noexcept {
  const int slot = slot_at(gate, p);
  return slot == kNoSlot ? gate.aisle_feel : slot_of(gate, slot).feel;
}

// [m] an aisle's spring also acts this far outside the aisle, where rounding may leave the proxy
constexpr double kEdge = 1e-9;

// No aisle reaches into a place's circle that does not lead through the place, so the circle alone decides.
int place_at(const Gate& gate, glm::dvec2 p) noexcept {
  for (int i = 0; i < gate.slot_count; ++i) {
    if (depth_in(gate, i, p) > 0.0) return i;
  }
  return kNoSlot;
}

// `force`: [N] along the way from `center` to `p`
glm::dvec2 radial(glm::dvec2 center, glm::dvec2 p, double force) noexcept {
  const double distance = glm::distance(p, center);
  return distance > 0.0 ? force / distance * (p - center) : glm::dvec2(0.0);
}

// A sum of potentials, each a function of the distance from a place or, inside one aisle, of the position along it. They
// are constant where the aisles on which they depend meet others, so no way through the aisles makes the sum ambiguous.
glm::dvec2 mechanism_feel(const Gate& gate, glm::dvec2 p) noexcept {
  glm::dvec2 force{0.0};
  const int place = place_at(gate, p);
  if (place != kNoSlot) {
    const Slot& slot = slot_of(gate, place);
    force -= radial(slot.at, p, feel_force(slot.feel, depth_in(gate, place, p)));
  }
  for (const Aisle& aisle : aisles(gate)) {
    if (aisle.spring.pieces > 0 && contains(whole(aisle), p, kEdge))
      force += feel_force(aisle.spring, position_along(aisle, p)) * aisle.along;
  }
  const glm::dvec2 neutral = rest_position(gate, kNeutralGear);
  return force + radial(neutral, p, feel_force(gate.return_feel, glm::distance(p, neutral)));
}

double max_mechanism_stiffness(const Gate& gate) noexcept {
  double place = 0.0, spring = 0.0;
  for (const Slot& slot : slots(gate)) place = std::max(place, -slope_range(slot.feel).min);
  for (const Aisle& aisle : aisles(gate)) spring = std::max(spring, -slope_range(aisle.spring).min);
  return place + spring - slope_range(gate.return_feel).min;
}

}  // namespace

int slot_at(const Gate& gate, glm::dvec2 point) noexcept {
  if (is_mechanism(gate)) [[unlikely]]
    return place_at(gate, point);
  if (std::abs(point.y) <= gate.half_aisle) return kNoSlot;
  const Column& column = column_of(gate, nearest_column(gate, point.x));
  return point.y > 0.0 ? column.forward_slot : column.back_slot;
}

glm::dvec2 gate_feel(const Gate& gate, glm::dvec2 proxy) noexcept {
  if (is_mechanism(gate)) [[unlikely]]
    return mechanism_feel(gate, proxy);
  const double along = feel_force(shift_curve(gate, proxy), std::abs(proxy.y));
  glm::dvec2 force{feel_force(gate.select_feel, proxy.x), shift_sign(proxy.y) * along};
  for (const Buffer& buffer : buffers(gate)) force += buffer_force(gate, buffer, proxy);
  return force;
}

double max_feel_stiffness(const Gate& gate) noexcept {
  if (is_mechanism(gate)) [[unlikely]]
    return max_mechanism_stiffness(gate);
  double steepest = std::min(slope_range(gate.select_feel).min, slope_range(gate.aisle_feel).min);
  for (const Slot& slot : slots(gate)) steepest = std::min(steepest, slope_range(slot.feel).min);
  return -steepest;
}

}  // namespace gearshift::haptics
