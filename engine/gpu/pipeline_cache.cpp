#include "engine/gpu/pipeline_cache.h"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <string>

namespace gearshift::engine {
namespace {

// Our header in front of the driver's data. Drivers check device and version, but trust the rest of the data to be
// complete.
struct CacheHeader {
  std::array<char, 8> magic{'g', 's', 'c', 'a', 'c', 'h', 'e', '1'};
  std::uint64_t size = 0;
  std::uint64_t sum = 0;
};

// FNV-1a, 64 bits: http://www.isthe.com/chongo/tech/comp/fnv/
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (const std::byte b : bytes) sum = (sum ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
  return sum;
}

constexpr std::uintmax_t kMaxCacheBytes = std::uintmax_t{256} << 20;  // [bytes] limit; drivers store a few MiB

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(file, problem)) return {};
  const std::uintmax_t size = std::filesystem::file_size(file, problem);
  if (problem || size > kMaxCacheBytes) return {};
  std::ifstream in(file, std::ios::binary);
  std::vector<std::byte> bytes(size);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return in ? bytes : std::vector<std::byte>{};
}

bool matches_device(std::span<const std::byte> content, const VkPhysicalDeviceProperties& device) {
  VkPipelineCacheHeaderVersionOne header;
  if (content.size() < sizeof header) return false;
  std::memcpy(&header, content.data(), sizeof header);
  return header.headerSize >= sizeof header && header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         header.vendorID == device.vendorID && header.deviceID == device.deviceID &&
         std::memcmp(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

}  // namespace

std::vector<std::byte> load_pipeline_cache(const std::filesystem::path& file,
                                           const VkPhysicalDeviceProperties& device) {
  std::vector<std::byte> bytes = read_file(file);
  CacheHeader header;
  if (bytes.size() < sizeof header) return {};
  std::memcpy(&header, bytes.data(), sizeof header);
  const auto content = std::span<const std::byte>(bytes).subspan(sizeof header);
  const bool is_complete =
      header.magic == CacheHeader{}.magic && header.size == content.size() && header.sum == checksum(content);
  if (!is_complete || !matches_device(content, device)) return {};
  return {content.begin(), content.end()};
}

void save_pipeline_cache(const std::filesystem::path& file, std::span<const std::byte> content) noexcept {
  try {
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    const std::filesystem::path part = file.string() + "." + std::to_string(getpid());
    CacheHeader header;
    header.size = content.size();
    header.sum = checksum(content);
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(&header), sizeof header);
    out.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    out.close();
    std::error_code ignored;
    if (out) {
      std::filesystem::rename(part, file, ignored);
    } else {
      std::filesystem::remove(part, ignored);
    }
  } catch (const std::exception&) {
    return;  // not fatal: the next start compiles the pipelines again
  }
}

}  // namespace gearshift::engine
