// Environment light on the GPU, outdoors and indoors: the visible sky, prefiltered reflections, irradiance, and the
// BRDF table.
#pragma once

#include "engine/gpu/gpu_image.h"
#include "engine/light/environment.h"

namespace gearshift::engine {

struct LightMaps {
  PrefilteredCube sky;                   // sharp, one level
  PrefilteredCube reflections, indoors;  // by roughness
  Irradiance irradiance, irradiance_indoors;
};
LightMaps light_maps(const Radiance& open, const Radiance& indoors);  // CPU only

struct LightTextures {
  GpuImage sky, reflections, indoors, brdf;
  ImageView sky_view, reflections_view, indoors_view, brdf_view;
  Irradiance irradiance, irradiance_indoors;
};
void upload_light(Gpu& gpu, const LightMaps& maps, LightTextures& into);
void upload_brdf(Gpu& gpu, const BrdfTable& table, LightTextures& into);

}  // namespace gearshift::engine
