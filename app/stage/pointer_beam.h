// Where somebody points in the cabin: a stick of light, and a ball of it at what is pointed at.
#pragma once

#include <glm/vec3.hpp>

#include "engine/model/model.h"

namespace gearshift {

struct Beam {
  glm::dvec3 from{0.0}, to{0.0};  // [m] cabin
};

inline constexpr const char* kBeamNode = "PointerBeam";  // one metre along its -Z, 4 mm thick
inline constexpr const char* kBeamEndNode = "PointerEnd";

// Blended, so that it is no caster: light has no shadow.
inline constexpr float kBeamOpacity = 0.9f;

void add_pointer_beam(Model& model);

// The stick needs a length: from and to are not the same point.
void place_beam_stick(const Beam& beam, Node& stick);

}  // namespace gearshift
