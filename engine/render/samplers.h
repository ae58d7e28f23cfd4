// Samplers of the renderer.
#pragma once

#include "engine/gpu/gpu_image.h"
#include "engine/model/model.h"

namespace gearshift {

Sampler texture_sampler(const Gpu& gpu, const Texture& texture);
Sampler picture_sampler(const Gpu& gpu);  // tables and pictures: linear, clamped
Sampler reflection_sampler(const Gpu& gpu);
Sampler shadow_sampler(const Gpu& gpu);  // for gathers: the shader weighs the comparisons

}  // namespace gearshift
