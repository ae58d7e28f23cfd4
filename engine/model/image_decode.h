// Decodes the images of a model in parallel.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/image/image.h"

namespace gearshift::engine {

struct EncodedImage {
  std::string path;  // for error messages: "images[3]"
  std::span<const std::uint8_t> bytes;
  int uses = 1;  // number of copies of its pixels in the model
};

// Returns the images in order. Throws GltfError with only the reason: not PNG or JPEG, corrupt, or beyond the limits of
// gltf.h. The limits are checked with the headers of all images before any image is decoded.
std::vector<Image> decode_images(const std::vector<EncodedImage>& encoded);

}  // namespace gearshift::engine
