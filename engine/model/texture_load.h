// Pictures of a model, decoded side by side.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/image/image.h"

namespace gearshift {

struct EncodedImage {
  std::string place;  // for sentences: "images[3]"
  std::span<const std::uint8_t> bytes;
  int uses = 1;  // copies of its pixels that the model will hold
};

// In their order. Throws GltfError with the reason alone: no PNG or JPEG, broken, beyond gltf.h's bounds - judged by the
// headers of all before any is decoded.
std::vector<Image> decode_images(const std::vector<EncodedImage>& encoded);

}  // namespace gearshift
