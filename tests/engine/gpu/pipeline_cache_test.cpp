#include "engine/gpu/pipeline_cache.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "engine/gpu/pipeline.h"
#include "tests/engine/gpu/glsl.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

VkPhysicalDeviceProperties some_device() {
  VkPhysicalDeviceProperties device{.vendorID = 0x10de, .deviceID = 0x2684};
  for (std::size_t i = 0; i < VK_UUID_SIZE; ++i) device.pipelineCacheUUID[i] = static_cast<std::uint8_t>(i);
  return device;
}

// Data like a driver's: the header that Vulkan specifies, followed by arbitrary bytes.
std::vector<std::byte> content_for(const VkPhysicalDeviceProperties& device) {
  VkPipelineCacheHeaderVersionOne header{.headerSize = sizeof(VkPipelineCacheHeaderVersionOne),
                                         .headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE,
                                         .vendorID = device.vendorID,
                                         .deviceID = device.deviceID};
  std::memcpy(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE);
  std::vector<std::byte> content(sizeof header + 100, std::byte{77});
  std::memcpy(content.data(), &header, sizeof header);
  return content;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

void compile_something(Gpu& gpu) {
  const auto vertex = compile_glsl("vert", "#version 450\nvoid main() { gl_Position = vec4(0.0); }");
  const PipelineLayout layout = make_pipeline_layout(gpu, {}, 0);
  CHECK(make_pipeline(gpu, {.vertex = vertex, .layout = layout.get(), .depth = VK_FORMAT_D32_SFLOAT}));
}

}  // namespace

TEST_CASE("a saved cache is loaded unchanged for the device that it was made on, and for no other") {
  const TempFolder folder;
  const auto file = folder / "deep/down/pipelines";
  const auto device = some_device();
  CHECK(load_pipeline_cache(file, device).empty());
  save_pipeline_cache(file, content_for(device));
  CHECK(load_pipeline_cache(file, device) == content_for(device));
  auto other_vendor = device, other_device = device, other_driver = device;
  other_vendor.vendorID = 0x1002;
  other_device.deviceID = 1;
  other_driver.pipelineCacheUUID[VK_UUID_SIZE - 1] ^= 1;
  for (const auto& foreign : {other_vendor, other_device, other_driver}) {
    CHECK(load_pipeline_cache(file, foreign).empty());
  }
}

TEST_CASE("a folder or an oversized file in place of the cache is ignored") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "pipelines");
  CHECK(load_pipeline_cache(folder / "pipelines", some_device()).empty());
  const auto huge = folder / "huge";
  save_pipeline_cache(huge, content_for(some_device()));
  std::filesystem::resize_file(huge, std::uintmax_t{1} << 40);  // sparse
  CHECK(load_pipeline_cache(huge, some_device()).empty());
}

TEST_CASE("a cache that is truncated or has any byte changed is ignored") {
  const TempFolder folder;
  const auto file = folder / "pipelines";
  save_pipeline_cache(file, content_for(some_device()));
  const std::string complete = bytes_of(file);
  REQUIRE(complete.size() > 100);
  for (std::size_t length = 0; length < complete.size(); ++length) {
    write(file, complete.substr(0, length));
    CHECK(load_pipeline_cache(file, some_device()).empty());
  }
  for (std::size_t i = 0; i < complete.size(); ++i) {
    std::string changed = complete;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    write(file, changed);
    CHECK(load_pipeline_cache(file, some_device()).empty());
  }
  write(file, complete);
  CHECK_FALSE(load_pipeline_cache(file, some_device()).empty());
}

TEST_CASE("saving leaves one complete file and no other; a path that cannot be written is not an error") {
  const TempFolder folder;
  save_pipeline_cache(folder / "pipelines", content_for(some_device()));
  save_pipeline_cache(folder / "pipelines", content_for(some_device()));
  const auto files = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  CHECK(files == 1);
  save_pipeline_cache("/proc/none/pipelines", content_for(some_device()));
  std::filesystem::create_directory(folder / "taken");
  save_pipeline_cache(folder / "taken", content_for(some_device()));
  CHECK(std::filesystem::is_directory(folder / "taken"));
}

TEST_CASE("a device starts with its own cache, with a truncated one and with none") {
  const TempFolder folder;
  GpuConfig config;
  config.pipeline_cache = folder / "pipelines";
  const auto run = [&] {
    GpuFixture fixture(config);
    compile_something(fixture.gpu());
  };
  run();
  const std::string complete = bytes_of(config.pipeline_cache);
  CHECK_FALSE(complete.empty());
  run();
  CHECK_FALSE(bytes_of(config.pipeline_cache).empty());
  write(config.pipeline_cache, complete.substr(0, complete.size() / 2));
  run();
  CHECK(bytes_of(config.pipeline_cache).size() >= complete.size());  // rewritten
}
