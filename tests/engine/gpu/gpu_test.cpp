#include "engine/gpu/gpu.h"

#include <stdlib.h>

#include <string>

#include <doctest/doctest.h>

#include "engine/gpu/gpu_buffer.h"
#include "tests/engine/gpu/canvas.h"
#include "tests/support/gpu_fixture.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

// Sets an environment variable for the enclosing scope.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const std::string& value) : name_(name) {
    const char* before = getenv(name);
    had_ = before != nullptr;
    if (had_) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~ScopedVariable() {
    if (had_) {
      setenv(name_, before_.c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }

 private:
  const char* name_;
  bool had_ = false;
  std::string before_;
};

std::string rejection() {
  try {
    const Gpu gpu(GpuConfig{});
  } catch (const GpuError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a device has a name, and its traits match the limits that it reports") {
  GpuFixture fixture;
  const Gpu& gpu = fixture.gpu();
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(gpu.physical(), &properties);
  CHECK(gpu.traits().name == properties.deviceName);
  CHECK(gpu.traits().is_cpu == (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU));
  CHECK(gpu.traits().tick_ns == static_cast<double>(properties.limits.timestampPeriod));
  if (gpu.traits().is_cpu) CHECK(gpu.traits().max_anisotropy == 1.0f);
  CHECK(gpu.supports(VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_FILTER_LINEAR_BIT));
  CHECK_FALSE(gpu.supports(VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_FEATURE_2_DEPTH_STENCIL_ATTACHMENT_BIT));
}

TEST_CASE("GEARSHIFT_GPU selects a device by part of its name, and an unknown name is rejected with one sentence") {
  choose_software_driver();
  std::string name;
  {
    GpuFixture fixture;
    name = fixture.gpu().traits().name;
  }
  {
    const ScopedVariable chosen("GEARSHIFT_GPU", name.substr(0, 4));
    GpuFixture fixture;
    CHECK(fixture.gpu().traits().name == name);
  }
  const ScopedVariable chosen("GEARSHIFT_GPU", "no such card");
  const std::string why = rejection();
  CHECK(why.find("no such card") != std::string::npos);
  CHECK(why.find(name) != std::string::npos);
  CHECK(why.back() == '.');
}

TEST_CASE("without a driver the error names the package that provides one") {
  choose_software_driver();
  const ScopedVariable nowhere("VK_ICD_FILENAMES", "/nonexistent.json");
  CHECK(rejection().find("mesa-vulkan-drivers") != std::string::npos);
}

TEST_CASE("an error is a GpuError that names call and code; a lost device is a GpuLost") {
  CHECK_NOTHROW(check(VK_SUCCESS, "call"));
  CHECK_NOTHROW(check(VK_SUBOPTIMAL_KHR, "call"));
  CHECK_THROWS_WITH_AS(check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "call"), "call failed: VK_ERROR_OUT_OF_DEVICE_MEMORY",
                       GpuError);
  CHECK_THROWS_WITH_AS(check(VK_ERROR_DEVICE_LOST, "call"), "call failed: VK_ERROR_DEVICE_LOST", GpuLost);
  bool was_lost = false;
  try {
    check(VK_ERROR_OUT_OF_HOST_MEMORY, "call");
  } catch (const GpuLost&) {
    was_lost = true;
  } catch (const GpuError&) {
  }
  CHECK_FALSE(was_lost);
}

TEST_CASE("timeline values grow with each submission and are reached when the work is done") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  FrameRing ring(gpu);
  std::uint64_t last = 0;
  for (int frame = 0; frame < 5; ++frame) {
    ring.begin();
    const std::uint64_t value = ring.end();
    CHECK(value == last + 1);
    last = value;
  }
  CHECK_FALSE(gpu.is_done(last + 1));
  gpu.wait(last);
  CHECK(gpu.is_done(last));
}

TEST_CASE("a frame ring uses its slots in turn, and waits while the frame of a slot is still being drawn") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  FrameRing ring(gpu);
  Canvas canvas(gpu, 512, 512);
  std::array<std::uint64_t, kFramesInFlight> newest{};
  for (int frame = 0; frame < 6; ++frame) {
    VkCommandBuffer commands = ring.begin();
    CHECK(ring.slot() == frame % kFramesInFlight);
    auto& of_slot = newest[static_cast<std::size_t>(ring.slot())];
    CHECK(gpu.is_done(of_slot));
    canvas.draw(commands, {0.0f, 0.0f, 0.0f, 1.0f});
    of_slot = ring.end();
  }
  ring.wait();
  CHECK(gpu.is_done(newest[0]));
  CHECK(gpu.is_done(newest[1]));
}

TEST_CASE("a frame that was begun and never ended leaves the ring usable") {
  GpuFixture fixture;
  FrameRing ring(fixture.gpu());
  for (int frame = 0; frame < 2 * kFramesInFlight; ++frame) ring.begin();
  ring.begin();
  CHECK(ring.end() == 1);
}

TEST_CASE("run_once() has completed the work when it returns, and passes on exceptions") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  GpuBuffer buffer(gpu, 4096, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::read_back);
  run_once(gpu, [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, buffer.get(), 0, 4096, 0xa5a5a5a5u); });
  CHECK(buffer.mapped()[0] == std::byte{0xa5});
  CHECK(buffer.mapped()[4095] == std::byte{0xa5});
  CHECK_THROWS_AS(run_once(gpu, [](VkCommandBuffer) { throw std::runtime_error("no"); }), std::runtime_error);
}
