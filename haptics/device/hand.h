// A simulated hand on the knob: an impedance and the driver that moves its target.
//
// The hand holds the lever through its mass, damping and stiffness towards a target and may add a push. The impedance
// acts along the plant's arcs, so that lever and hand together remain one exactly solvable axis.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <glm/vec2.hpp>

namespace gearshift::haptics {

struct HandImpedance {
  double mass = 0.0;       // [kg] mass that moves with the lever
  double damping = 0.0;    // [N s/m] force per difference to the target's velocity
  double stiffness = 0.0;  // [N/m] force per distance to the target
};

inline constexpr HandImpedance kBareHand{0.0, 0.0, 0.0};
inline constexpr HandImpedance kLightHand{0.1, 5.0, 200.0};
inline constexpr HandImpedance kGripHand{0.15, 10.0, 500.0};
inline constexpr HandImpedance kArmHand{0.8, 5.5, 568.0};

struct NamedHand {
  std::string_view name;
  HandImpedance hand;
};
inline constexpr std::array<NamedHand, 4> kNamedHands{
    {{"bare", kBareHand}, {"light", kLightHand}, {"grip", kGripHand}, {"arm", kArmHand}}};

// [N/m] A hand softer than this cannot move a lever to a target.
inline constexpr double kMinLeadingStiffness = 50.0;

// The hand itself, or a grip if it is too soft to lead.
constexpr HandImpedance leading_hand(const HandImpedance& hand) noexcept {
  return hand.stiffness < kMinLeadingStiffness ? kGripHand : hand;
}

// Parses "bare", "light", "grip", "arm" or "M,B,K" in kg, N s/m, N/m (each finite and >= 0); empty otherwise.
std::optional<HandImpedance> parse_hand(std::string_view text);

struct HandTarget {
  glm::dvec2 position{0.0};   // [m] in the gate plane
  glm::dvec2 velocity{0.0};   // [m/s]
  glm::dvec2 push{0.0};       // [N] force in addition to the impedance
  bool pressed_down = false;  // knob pushed down or reverse button held
  bool lifted = false;        // lift ring held
};

// Supplies the hand's target. Called once per device period on the haptic thread; must be real-time safe.
class HandDriver {
 public:
  virtual ~HandDriver() = default;
  // time: since the start [s]; lever: present position of the tip [m]
  virtual HandTarget next(double time, glm::dvec2 lever) noexcept = 0;
};

// A hand that never moves and never pushes.
class IdleHand final : public HandDriver {
 public:
  HandTarget next(double, glm::dvec2) noexcept override { return {}; }
};

}  // namespace gearshift::haptics
