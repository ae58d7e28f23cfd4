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
  int uses = 1;  // number of textures that get a copy of the pixels
};

// Returns the decoded images in the order of `encoded`. Throws GltfError if an image is not PNG or JPEG, is corrupt, or
// exceeds the limits of gltf.h; the message states only the reason. Checks the sizes in the headers of all images
// before it decodes any image.
std::vector<Image> decode_images(const std::vector<EncodedImage>& encoded);

}  // namespace gearshift::engine
