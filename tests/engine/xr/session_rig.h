// Our headset session on the OpenXR test runtime, run frame by frame. A frame draws one colour per eye.
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

namespace gearshift::test {

constexpr double kRigNear = 0.05;                        // [m]
constexpr glm::ivec2 kRigEye{48, 32}, kRigPanel{16, 8};  // [px]

// Everything a program needs for a headset, used correctly.
struct SessionRig {
  // validates: false when memory is measured, because the validation layer keeps some data about every object ever
  // created.
  explicit SessionRig(bool validates = true)
      : runtime((choose_software_driver(), xr_test::control(), std::make_unique<engine::HeadsetRuntime>())),
        fixture(validates ? std::make_unique<GpuFixture>(config_with(*runtime)) : nullptr),
        gpu_without_fixture(validates ? nullptr : std::make_unique<engine::Gpu>(config_with(*runtime))),
        session(std::make_unique<engine::HeadsetSession>(*runtime, gpu(), engine::HeadsetConfig{kRigEye, kRigPanel})),
        ring(std::make_unique<engine::FrameRing>(gpu())),
        eyes_drawn(colour_image(gpu(), kRigEye, 2)),
        panel_drawn(colour_image(gpu(), kRigPanel, 1)) {}

  ~SessionRig() { gpu().wait_idle(); }
  SessionRig(const SessionRig&) = delete;
  SessionRig& operator=(const SessionRig&) = delete;

  engine::Gpu& gpu() { return fixture ? fixture->gpu() : *gpu_without_fixture; }

  static engine::GpuConfig config_with(engine::HeadsetRuntime& factory) {
    engine::GpuConfig config;
    config.factory = &factory;
    return config;
  }

  static engine::GpuImage colour_image(engine::Gpu& gpu, glm::ivec2 size, std::uint32_t layers) {
    return {gpu,
            {.width = static_cast<std::uint32_t>(size.x),
             .height = static_cast<std::uint32_t>(size.y),
             .layers = layers,
             .format = VK_FORMAT_R8G8B8A8_SRGB,
             .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}};
  }

  static void clear(VkCommandBuffer commands, engine::GpuImage& image, std::uint32_t layer,
                    std::array<float, 3> linear) {
    engine::transition(commands, image, engine::ImageUse::copy_to);
    const VkClearColorValue colour{.float32 = {linear[0], linear[1], linear[2], 1.0f}};
    const VkImageSubresourceRange range{
        .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .baseArrayLayer = layer, .layerCount = 1};
    vkCmdClearColorImage(commands, image.get(), engine::layout_of(engine::ImageUse::copy_to), &colour, 1, &range);
  }

  static void copy_to_image(VkCommandBuffer commands, engine::GpuImage& from, engine::GpuImage* to) {
    engine::transition(commands, from, engine::ImageUse::copy_from);
    engine::transition(commands, *to, engine::ImageUse::copy_to);
    engine::copy_image(commands, from, *to);
  }

  // Draws the left eye red, the right eye green, the panel blue, and depth 1/4 everywhere.
  void draw(const engine::HeadsetSession::Images& images) {
    VkCommandBuffer commands = ring->begin();
    clear(commands, eyes_drawn, 0, {1.0f, 0.0f, 0.0f});
    clear(commands, eyes_drawn, 1, {0.0f, 1.0f, 0.0f});
    copy_to_image(commands, eyes_drawn, images.colour);
    if (images.depth) {
      engine::transition(commands, *images.depth, engine::ImageUse::copy_to);
      const VkClearDepthStencilValue quarter{.depth = 0.25f};
      const VkImageSubresourceRange both{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .levelCount = 1, .layerCount = 2};
      vkCmdClearDepthStencilImage(commands, images.depth->get(), engine::layout_of(engine::ImageUse::copy_to), &quarter,
                                  1, &both);
    }
    if (images.panel) {
      clear(commands, panel_drawn, 0, {0.0f, 0.0f, 1.0f});
      copy_to_image(commands, panel_drawn, images.panel);
    }
    session->transition_for_release(commands);
    ring->end();
  }

  // One iteration of a program's loop. Returns an empty value while the session is not running.
  std::optional<engine::HeadsetFrame> run_frame() {
    session->poll();
    if (!session->is_running()) return std::nullopt;
    const engine::HeadsetFrame frame = session->wait();
    eyes = session->locate(frame);
    engine::HeadsetSession::Images images;
    if (frame.should_render) images = session->acquire_images(panel.has_value());
    if (images.colour) {
      draw(images);
      eyes = session->locate(frame);
    }
    session->end(frame, images.colour ? &eyes : nullptr, kRigNear, panel ? &*panel : nullptr);
    return frame;
  }

  // Runs frames until the session is in that state, but at most max_frames. Returns true if the state was reached.
  bool reaches(engine::HeadsetState state, int max_frames = 40) {
    for (int i = 0; i < max_frames && session->state() != state; ++i) (void)run_frame();
    return session->state() == state;
  }

  std::unique_ptr<engine::HeadsetRuntime> runtime;
  std::unique_ptr<GpuFixture> fixture;
  std::unique_ptr<engine::Gpu> gpu_without_fixture;
  std::unique_ptr<engine::HeadsetSession> session;
  std::unique_ptr<engine::FrameRing> ring;
  engine::GpuImage eyes_drawn, panel_drawn;
  std::optional<engine::HeadsetPanel> panel;
  engine::HeadsetEyes eyes;
};

// Checks that neither Khronos' validation layer nor the runtime complained, and that no OpenXR object is left.
inline void check_no_violations() {
  CHECK(xr_test::complaints() == "");
  CHECK(xr_test::control().record.live_handles == 0);
  CHECK(xr_test::control().record.leaks == 0);
}

// Returns the message of the exception that `function` throws; empty if it throws none.
template <class Error, class Function>
std::string thrown(const Function& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  } catch (const std::exception& other) {
    FAIL_CHECK("another error: " << other.what());
  }
  return "";
}

}  // namespace gearshift::test
