// Our session at the test runtime, frame by frame; what a frame draws is one colour an eye.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/gpu/commands.h"
#include "engine/xr/headset_session.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/xr_runtime/control.h"

namespace gearshift {

constexpr double kRigNear = 0.05;                        // [m]
constexpr glm::ivec2 kRigEye{48, 32}, kRigPanel{16, 8};  // [px]

// Everything that a program has of a headset. Made by the book or thrown by it.
struct SessionRig {
  // validates: not where memory is counted: the layer keeps some of all that was ever made.
  explicit SessionRig(bool validates = true)
      : runtime((choose_software_driver(), xr_test::control(), std::make_unique<HeadsetRuntime>())),
        fixture(validates ? std::make_unique<GpuFixture>(made_by(*runtime)) : nullptr),
        bare(validates ? nullptr : std::make_unique<Gpu>(made_by(*runtime))),
        session(std::make_unique<HeadsetSession>(*runtime, gpu(), HeadsetConfig{kRigEye, kRigPanel})),
        ring(std::make_unique<FrameRing>(gpu())),
        eyes_drawn(colour_image(gpu(), kRigEye, 2)),
        panel_drawn(colour_image(gpu(), kRigPanel, 1)) {}

  ~SessionRig() { gpu().wait_idle(); }
  SessionRig(const SessionRig&) = delete;
  SessionRig& operator=(const SessionRig&) = delete;

  Gpu& gpu() { return fixture ? fixture->gpu() : *bare; }

  static GpuConfig made_by(HeadsetRuntime& maker) {
    GpuConfig config;
    config.maker = &maker;
    return config;
  }

  static GpuImage colour_image(Gpu& gpu, glm::ivec2 size, std::uint32_t layers) {
    return {gpu,
            {.width = static_cast<std::uint32_t>(size.x),
             .height = static_cast<std::uint32_t>(size.y),
             .layers = layers,
             .format = VK_FORMAT_R8G8B8A8_SRGB,
             .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}};
  }

  static void clear(VkCommandBuffer commands, GpuImage& image, std::uint32_t layer, std::array<float, 3> linear) {
    transition(commands, image, ImageUse::copy_to);
    const VkClearColorValue colour{.float32 = {linear[0], linear[1], linear[2], 1.0f}};
    const VkImageSubresourceRange range{
        .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .baseArrayLayer = layer, .layerCount = 1};
    vkCmdClearColorImage(commands, image.get(), layout_of(ImageUse::copy_to), &colour, 1, &range);
  }

  static void put(VkCommandBuffer commands, GpuImage& from, GpuImage* to) {
    transition(commands, from, ImageUse::copy_from);
    transition(commands, *to, ImageUse::copy_to);
    copy_whole(commands, from, *to);
  }

  // Left red, right green, panel blue, depth 1/4 everywhere.
  void draw(const HeadsetSession::Images& images) {
    VkCommandBuffer commands = ring->begin();
    clear(commands, eyes_drawn, 0, {1.0f, 0.0f, 0.0f});
    clear(commands, eyes_drawn, 1, {0.0f, 1.0f, 0.0f});
    put(commands, eyes_drawn, images.colour);
    if (images.depth) {
      transition(commands, *images.depth, ImageUse::copy_to);
      const VkClearDepthStencilValue quarter{.depth = 0.25f};
      const VkImageSubresourceRange both{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .levelCount = 1, .layerCount = 2};
      vkCmdClearDepthStencilImage(commands, images.depth->get(), layout_of(ImageUse::copy_to), &quarter, 1, &both);
    }
    if (images.panel) {
      clear(commands, panel_drawn, 0, {0.0f, 0.0f, 1.0f});
      put(commands, panel_drawn, images.panel);
    }
    session->ready_to_give(commands);
    ring->end();
  }

  // One turn of a program. Empty where the session does not run.
  std::optional<HeadsetFrame> turn() {
    session->poll();
    if (!session->runs()) return std::nullopt;
    const HeadsetFrame frame = session->wait(std::chrono::hours(1)).value();
    eyes = session->locate(frame);
    HeadsetSession::Images images;
    if (frame.is_shown) images = session->take_images(panel.has_value());
    if (images.colour) {
      draw(images);
      eyes = session->locate(frame);
    }
    session->end(frame, images.colour ? &eyes : nullptr, kRigNear, panel ? &*panel : nullptr);
    return frame;
  }

  // Until it is in that state; at most so many turns.
  bool comes_to(HeadsetState state, int turns = 40) {
    for (int i = 0; i < turns && session->state() != state; ++i) (void)turn();
    return session->state() == state;
  }

  std::unique_ptr<HeadsetRuntime> runtime;
  std::unique_ptr<GpuFixture> fixture;
  std::unique_ptr<Gpu> bare;
  std::unique_ptr<HeadsetSession> session;
  std::unique_ptr<FrameRing> ring;
  GpuImage eyes_drawn, panel_drawn;
  std::optional<HeadsetPanel> panel;
  HeadsetEyes eyes;
};

// The runtime had nothing to object, and nothing is left at it.
inline void check_by_the_book() {
  const xr_test::Record& record = xr_test::control().record;
  for (const xr_test::Violation& broken : record.violations)
    FAIL_CHECK(broken.rule << ": " << broken.function << " " << broken.detail);
  CHECK(record.live_handles() == 0);
  for (const std::string& leak : record.leaks) FAIL_CHECK(leak);
}

// What fun throws, as text; empty: nothing.
template <class Error, class Fun>
std::string thrown(const Fun& fun) {
  try {
    fun();
  } catch (const Error& error) {
    return error.what();
  } catch (const std::exception& other) {
    FAIL_CHECK("another error: " << other.what());
  }
  return "";
}

}  // namespace gearshift
