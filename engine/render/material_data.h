// A glTF material in the layout that the shader reads.
#pragma once

#include <array>

#include "engine/model/model.h"
#include "shaders/shared.h"

namespace gearshift::engine {

std::array<const TextureUse*, shader::kMaps> maps_of(const Material& material);  // indexed by shader::kMap...
std::uint32_t features_of(const Material& material, bool vertex_colours);
shader::MaterialData data_of(const Material& material);

}  // namespace gearshift::engine
