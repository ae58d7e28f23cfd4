// The environment's BRDF at one roughness, without its table.
#pragma once

#include <array>

#include <glm/vec2.hpp>

#include "engine/light/environment.h"
#include "engine/model/model.h"

namespace gearshift {

// Scale and bias of F0 as polynomials in 2 n.v - 1, constant first: what the table of bake_brdf() says at that roughness.
using BrdfFit = std::array<glm::vec2, 8>;
BrdfFit fit_brdf(const BrdfTable& table, float roughness);

// Has it one roughness, and one that is fitted as well as the table is baked? What is smoother bends too sharply.
inline constexpr float kLeastFittedRoughness = 0.28f;
bool has_brdf_fit(const Material& material);

}  // namespace gearshift
