// Reads PNG and JPEG and writes PNG, with stb; input is checked before it is passed to stb.
#include <stb_image.h>
#include <stb_image_write.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/core.h>

#include "engine/image/image.h"

namespace gearshift::engine {

namespace {

constexpr std::uintmax_t kMaxImageBytes = 1u << 30;

bool starts_with(std::span<const std::uint8_t> bytes, std::initializer_list<std::uint8_t> magic) {
  return bytes.size() > magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

bool is_png(std::span<const std::uint8_t> bytes) {
  return starts_with(bytes, {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'});
}

bool is_jpeg(std::span<const std::uint8_t> bytes) {
  return starts_with(bytes, {0xff, 0xd8, 0xff});
}

std::vector<std::uint8_t> encoded_png(const Image& image) {
  std::vector<std::uint8_t> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    static_cast<std::vector<std::uint8_t>*>(context)->insert(static_cast<std::vector<std::uint8_t>*>(context)->end(),
                                                             first, first + size);
  };
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), 4 * image.width) == 0) {
    throw std::runtime_error("the picture cannot be encoded");
  }
  return bytes;
}

void check_shape(const Image& image) {
  const bool sized =
      image.width > 0 && image.height > 0 && image.width <= kMaxImageSide && image.height <= kMaxImageSide;
  if (!sized ||
      image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    throw std::runtime_error("the picture has no pixels or the wrong number of them");
  }
}

// Devices and pipes (/dev/null, /dev/stdout) are written to, never replaced.
bool is_device_or_pipe(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::filesystem::file_status found = std::filesystem::status(file, unknown);
  return std::filesystem::exists(found) && !std::filesystem::is_regular_file(found) &&
         !std::filesystem::is_directory(found);
}

// Follows a symbolic link, so that the link's target is written and the link stays.
std::filesystem::path resolve_path(const std::filesystem::path& file) {
  const bool is_link = std::filesystem::is_symlink(file) && !is_device_or_pipe(file);
  return is_link ? std::filesystem::canonical(file) : file;
}

// Returns the name of the file to write: for a device or pipe the target itself, otherwise a temporary name that is
// unique to this process. The finished file is renamed to the target, so readers see either the old picture or the new
// one.
std::filesystem::path part_of(std::filesystem::path target) {
  if (!is_device_or_pipe(target)) target += fmt::format(".{}.part", getpid());
  return target;
}

}  // namespace

void write_png(const std::filesystem::path& file, const Image& image) {
  std::filesystem::path part;
  try {
    check_shape(image);
    const std::vector<std::uint8_t> bytes = encoded_png(image);
    const std::filesystem::path target = resolve_path(file);
    // Check the write permission explicitly, because renaming would replace even a write-protected file.
    if (access(target.c_str(), W_OK) != 0 && errno != ENOENT) throw std::runtime_error(std::strerror(errno));
    part = part_of(target);
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw std::runtime_error(std::strerror(errno));
    if (part != target) std::filesystem::rename(part, target);
  } catch (const std::exception& e) {
    std::error_code ignored;
    if (!is_device_or_pipe(file)) std::filesystem::remove(part, ignored);
    const auto* system = dynamic_cast<const std::system_error*>(&e);
    throw std::runtime_error(fmt::format("{}: the picture cannot be written ({})", file.string(),
                                         system != nullptr ? system->code().message() : e.what()));
  }
}

ImageSize encoded_size(std::span<const std::uint8_t> bytes) {
  // stb decodes more formats, but less robustly.
  if (!is_png(bytes) && !is_jpeg(bytes)) throw std::runtime_error("the picture is neither PNG nor JPEG");
  if (bytes.size() > kMaxImageBytes) throw std::runtime_error("the picture is too large");
  ImageSize size;
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &size.width, &size.height, &channels) == 0) {
    throw std::runtime_error("the picture's header is damaged");
  }
  if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide || size.height > kMaxImageSide) {
    throw std::runtime_error(fmt::format("the picture has {} x {} pixels, but each side may have only 1 to {}",
                                         size.width, size.height, kMaxImageSide));
  }
  return size;
}

Image decode_image(std::span<const std::uint8_t> bytes) {
  const ImageSize size = encoded_size(bytes);
  Image image{size.width, size.height, {}};
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 4),
      stbi_image_free);
  if (pixels == nullptr || width != size.width || height != size.height)
    throw std::runtime_error("the pixel data is damaged");
  image.rgba.assign(pixels.get(),
                    pixels.get() + 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return image;
}

}  // namespace gearshift::engine
