// A simulated hand on the knob, and the driver that moves its target.
//
// The hand has mass, damping and stiffness. It pulls the lever towards a target and may add a push. These forces act
// along the arcs on which the joints move the tip, so that lever and hand together remain one axis per joint, with an
// exact solution. An elastic hand is a second mass behind its grip: the fingers move with the lever, the hand moves
// with its target, and a spring and a damper join them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>

#include "haptics/files/parameter.h"

namespace gearshift::haptics {

struct HandImpedance {
  double mass = 0.0;            // [kg] mass of the hand, which moves with the lever, or behind an elastic grip
  double damping = 0.0;         // [N s/m] force per velocity relative to the target
  double stiffness = 0.0;       // [N/m] force per distance from the target
  double finger_mass = 0.0;     // [kg] mass before the grip, which moves with the lever
  double grip_damping = 0.0;    // [N s/m] force per velocity of the hand relative to the lever
  double grip_stiffness = 0.0;  // [N/m] force per distance of the hand from the lever; 0: the hand is rigid
  bool is_elastic() const noexcept { return grip_stiffness > 0.0; }
  bool operator==(const HandImpedance&) const = default;
};

template <>
inline constexpr Parameter<HandImpedance> kParameters<HandImpedance>[] = {
    {&HandImpedance::mass, "mass", "mass_kg", FileRange{0.0, 1e3}, "Mass that moves with the lever."},
    {&HandImpedance::damping, "damping", "damping_n_s_per_m", FileRange{0.0, 1e4},
     "Damping towards the target's velocity."},
    {&HandImpedance::stiffness, "stiffness", "stiffness_n_per_m", FileRange{0.0, 1e6}, "Stiffness towards the target."},
    {&HandImpedance::finger_mass, "finger_mass", "finger_mass_kg", FileRange{0.0, 1e3},
     "Mass of an elastic hand that moves with the lever."},
    {&HandImpedance::grip_damping, "grip_damping", "grip_damping_n_s_per_m", FileRange{0.0, 1e3},
     "Damping of an elastic hand's grip."},
    {&HandImpedance::grip_stiffness, "grip_stiffness", "grip_stiffness_n_per_m", FileRange{0.0, 1e5},
     "Stiffness of an elastic hand's grip; 0: rigid."},
};
static_assert(DescribesAll<HandImpedance>);

inline constexpr HandImpedance kBareHand{0.0, 0.0, 0.0};
inline constexpr HandImpedance kLightHand{0.1, 5.0, 200.0};
inline constexpr HandImpedance kGripHand{0.15, 10.0, 500.0};
inline constexpr HandImpedance kArmHand{0.8, 5.5, 568.0};
// A hand around a handle: two of the three masses of a hand-arm model. The third one, the arm, is replaced by the target.
// The values are a choice, of the order of such models: ISO 10068, which has some, was not at hand. No law depends on them,
// because campaigns and benches draw other grips around them (app/lab/contact/contact_campaign.h).
inline constexpr HandImpedance kElasticHand{0.486, 18.9, 132.0, 0.0267, 207.5, 4368.0};
// Two fingertips on the knob, each with 6 g, 5 N s/m and 800 N/m, which are chosen values, in front of an arm (0.554 kg,
// 6.45 N s/m, 135 N/m: Scientific Reports 5, srep18004, Fig. 3).
inline constexpr HandImpedance kPinchHand{0.554, 6.45, 135.0, 0.012, 10.0, 1600.0};

struct NamedHand {
  std::string_view name;
  HandImpedance hand;
};
inline constexpr std::array<NamedHand, 4> kNamedHands{
    {{"bare", kBareHand}, {"light", kLightHand}, {"grip", kGripHand}, {"arm", kArmHand}}};
inline constexpr std::array<NamedHand, 2> kElasticHands{{{"elastic", kElasticHand}, {"pinch", kPinchHand}}};
inline constexpr double kMinElasticMass = 0.001;  // [kg] a mass behind a grip cannot be zero

// [N/m] a hand with less stiffness cannot move a lever to a target
inline constexpr double kMinLeadingStiffness = 50.0;

// Returns the hand itself, or kGripHand if the hand is too soft to move a lever.
constexpr HandImpedance leading_hand(const HandImpedance& hand) noexcept {
  return hand.stiffness < kMinLeadingStiffness ? kGripHand : hand;
}

// Parses a hand's name, "mass,damping,stiffness" or, for an elastic hand, "mass,damping,stiffness,finger mass,grip
// damping,grip stiffness", in kg, N s/m and N/m, each finite and >= 0. Returns an empty optional for any other text.
std::optional<HandImpedance> parse_hand(std::string_view text);
// Returns the hand's name, or its numbers as parse_hand() reads them.
std::string hand_text(const HandImpedance& hand);

struct HandTarget {
  glm::dvec2 position{0.0};   // [m] in the gate plane
  glm::dvec2 velocity{0.0};   // [m/s]
  glm::dvec2 push{0.0};       // [N] additional force, independent of the target
  bool pressed_down = false;  // the knob is pushed down or the reverse button is held
  bool lifted = false;        // lift ring held
};

// Supplies the hand's target. Called once per device period on the haptic thread, so it must be real-time safe.
class HandDriver {
 public:
  virtual ~HandDriver() = default;
  // `time`: time since the start [s]. `lever`: present position of the tip [m].
  virtual HandTarget next(double time, glm::dvec2 lever) noexcept = 0;
};

// A hand that never moves and never pushes.
class IdleHand final : public HandDriver {
 public:
  HandTarget next(double, glm::dvec2) noexcept override { return {}; }
};

}  // namespace gearshift::haptics
