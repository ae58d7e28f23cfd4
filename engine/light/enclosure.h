// Light in a room with windows: sky and road through the windows, and what lining scatters of it.
//
// The room is taken for a sphere about the point that the light is wanted at, its windows and lining told by direction,
// the lining matt. In a sphere a patch lights every other one alike, whatever lies between them in angle (form factor =
// its share of the sphere), so that the light is known in closed form:
//   E1(x) = 1/4 int_W L(x -> w) dw                sky, w over the windows: cos cos' / r^2 = 1/4 on the unit sphere
//         + S (-x.s)  where the sun's ray enters through a window
//   M     = mean(albedo E1) + mean(albedo) M      what the lining gives back to itself, again and again
//   L(x)  = albedo(x) (E1(x) + M) / pi            x a direction of the lining
//
// This work is based on:
// David Goebel. Generalized Integrating-Sphere Theory. 1967
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "engine/light/environment.h"

namespace gearshift {

// What a point inside has around it, by direction (unit, +Y up).
struct Enclosure {
  std::function<bool(glm::vec3 direction)> window;
  std::function<glm::vec3(glm::vec3 direction)> albedo;  // [0, 1) linear, of the lining; asked where there is no window
};

// irradiance: of the sun, on a surface that faces it. A sun has no size here: its patch has a sharp edge.
Radiance inside(const Enclosure& room, const Radiance& open, glm::vec3 towards_sun, glm::vec3 irradiance);

// The cabin of assets/models, seen from its middle.
Enclosure car_cabin();

}  // namespace gearshift
