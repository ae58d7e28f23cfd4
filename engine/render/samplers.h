// Texture samplers for tables, pictures, reflections and shadows.
#pragma once

#include "engine/gpu/gpu_image.h"
#include "engine/model/model.h"

namespace gearshift::engine {

Sampler texture_sampler(const Gpu& gpu, const Texture& texture);
Sampler picture_sampler(const Gpu& gpu);  // for tables and pictures: linear, clamped
Sampler reflection_sampler(const Gpu& gpu);
Sampler shadow_sampler(const Gpu& gpu);  // for textureGather: the shader weights the comparisons

}  // namespace gearshift::engine
