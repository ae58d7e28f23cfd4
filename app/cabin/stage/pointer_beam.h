// The pointer in the cabin: a beam of light with a ball at its end.
#pragma once

#include <glm/vec3.hpp>

#include "engine/model/model.h"

namespace gearshift::cabin {

struct Beam {
  glm::dvec3 from{0.0}, to{0.0};  // [m] cabin
};

inline constexpr const char* kBeamNode = "PointerBeam";  // one metre along its -Z, 4 mm thick
inline constexpr const char* kBeamEndNode = "PointerEnd";

// Blended, because blended meshes cast no shadow.
inline constexpr float kBeamOpacity = 0.9f;

void add_pointer_beam(engine::Model& model);

// from and to must differ.
void place_beam_stick(const Beam& beam, engine::Node& stick);

}  // namespace gearshift::cabin
