// Light in a room with windows: sky and road seen through the windows, and the light that the room's lining (its inner
// surface) scatters.
//
// The room is modelled as a sphere around the point for which the light is computed. Windows and lining are given by
// direction, and the lining is matt. In a sphere, a patch lights every other patch equally, whatever the angle between
// the two patches (form factor = fraction of the sphere's area), so there is a closed form:
//   E1(x) = 1/4 int_W L(x -> w) dw                from outside; cos cos' / r^2 = 1/4 on the unit sphere
//         + S (-x.s)  where the sun's ray enters through a window
//   M     = mean(albedo E1) + mean(albedo) M      all interreflections within the lining
//   L(x)  = albedo(x) (E1(x) + M) / pi            radiance of the lining
// Here x is a point of the lining on the unit sphere, E1 its irradiance without reflections, w a point of the windows
// W, L(x -> w) the radiance that x receives through w, S the sun's irradiance, s the direction towards the sun, and M
// the irradiance by reflected light.
//
// This work is based on:
// David Goebel. Generalized Integrating-Sphere Theory. 1967
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "engine/light/environment.h"

namespace gearshift::engine {

// Surroundings of a point inside a room, given by direction (unit vector, +Y up).
struct Enclosure {
  std::function<bool(glm::vec3 direction)> window;
  // linear albedo of the lining, from 0 to below 1; not called for window directions
  std::function<glm::vec3(glm::vec3 direction)> albedo;
};

// `irradiance`: direct sunlight on a surface that faces the sun. The sun is treated as a point, so its patch of light
// on the lining has a sharp edge.
Radiance indoor_radiance(const Enclosure& room, const Radiance& open, glm::vec3 towards_sun, glm::vec3 irradiance);

// The cabin of assets/models, seen from its centre.
Enclosure car_cabin();

}  // namespace gearshift::engine
