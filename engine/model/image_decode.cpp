#include "engine/model/image_decode.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>

#include <fmt/core.h>

#include "engine/model/gltf.h"

namespace gearshift::engine {

namespace {

void check_sizes(const std::vector<EncodedImage>& encoded) {
  std::uint64_t pixels = 0;
  for (const EncodedImage& image : encoded) {
    ImageSize size;
    try {
      size = encoded_size(image.bytes);
    } catch (const std::runtime_error& e) {
      throw GltfError(fmt::format("{} cannot be used ({})", image.path, e.what()));
    }
    if (size.width > kMaxTextureSide || size.height > kMaxTextureSide) {
      throw GltfError(fmt::format("{} has {} x {} pixels, but may have at most {} per side", image.path, size.width,
                                  size.height, kMaxTextureSide));
    }
    pixels += static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height) *
              static_cast<std::uint64_t>(image.uses);
    if (pixels > kMaxTexturePixels) throw GltfError("the textures have too many pixels in total");
  }
}

Image decoded(const EncodedImage& image) {
  try {
    return decode_image(image.bytes);
  } catch (const std::runtime_error& e) {
    throw GltfError(fmt::format("{} cannot be used ({})", image.path, e.what()));
  }
}

}  // namespace

std::vector<Image> decode_images(const std::vector<EncodedImage>& encoded) {
  check_sizes(encoded);
  std::vector<Image> images(encoded.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < encoded.size(); i = next++) images[i] = decoded(encoded[i]);
  };
  const std::size_t workers = std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), encoded.size());
  std::vector<std::future<void>> running;
  for (std::size_t i = 1; i < workers; ++i) running.push_back(std::async(std::launch::async, work));
  std::exception_ptr failed;
  try {
    work();
  } catch (...) {
    failed = std::current_exception();
  }
  for (std::future<void>& worker : running) {
    try {
      worker.get();
    } catch (...) {
      if (!failed) failed = std::current_exception();
    }
  }
  if (failed) std::rethrow_exception(failed);
  return images;
}

}  // namespace gearshift::engine
