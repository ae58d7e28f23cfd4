// A sky on the GPU: what is seen of it, what is reflected, what it scatters, and the table that both need.
#pragma once

#include "engine/gpu/gpu_image.h"
#include "engine/light/environment.h"

namespace gearshift {

struct LightMaps {
  PrefilteredCube sky;          // sharp, one level
  PrefilteredCube reflections;  // by roughness
  Irradiance irradiance;
};
LightMaps light_maps(const Radiance& radiance);  // needs no GPU

struct LightTextures {
  GpuImage sky, reflections, brdf;
  ImageView sky_view, reflections_view, brdf_view;
  Irradiance irradiance;
};
void upload_light(Gpu& gpu, const LightMaps& maps, LightTextures& into);
void upload_brdf(Gpu& gpu, const BrdfTable& table, LightTextures& into);

}  // namespace gearshift
