// The pointer in the cabin: a beam of light with a ball at its end.
#pragma once

#include <glm/vec3.hpp>

#include "engine/model/model.h"

namespace gearshift::cabin {

struct Beam {
  glm::dvec3 from{0.0}, to{0.0};  // [m] ends of the beam in the cabin
};

inline constexpr const char* kBeamNode = "PointerBeam";  // node of the beam: 1 m long along its -Z, 4 mm thick
inline constexpr const char* kBeamEndNode = "PointerEnd";

// The value is below 1, so that the beam is drawn as a blended mesh, which casts no shadow.
inline constexpr float kBeamOpacity = 0.9f;

void add_pointer_beam(engine::Model& model);

// Places the beam's node. beam.from and beam.to must differ.
void place_beam_stick(const Beam& beam, engine::Node& stick);

}  // namespace gearshift::cabin
