#include "app/view/desktop_mirror.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "app/view/ui_canvas.h"
#include "engine/gpu/commands.h"
#include "engine/window/swapchain.h"

namespace gearshift {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPeriod = std::chrono::microseconds(33'000);

// As large as the part of a canvas of that size allows, in its middle. [px]
VkRect2D place_in(const SeenPart& part, VkExtent2D canvas, VkExtent2D picture) {
  const glm::dvec2 size(canvas.width, canvas.height);
  const glm::dvec2 low = part.low * size, room = (part.high - part.low) * size;
  const double scale = std::min(room.x / picture.width, room.y / picture.height);
  const glm::dvec2 shown = scale * glm::dvec2(picture.width, picture.height);
  const glm::dvec2 corner = low + 0.5 * (room - shown);
  const auto whole = [](double px) { return static_cast<std::int32_t>(std::floor(px)); };
  const VkOffset2D at{std::max(0, whole(corner.x)), std::max(0, whole(corner.y))};
  const auto length = [&](double px, std::int32_t from, std::uint32_t side) {
    return std::min(static_cast<std::uint32_t>(std::max(1, whole(px))), side - static_cast<std::uint32_t>(from));
  };
  return {at, {length(shown.x, at.x, canvas.width), length(shown.y, at.y, canvas.height)}};
}

}  // namespace

struct DesktopMirror::State {
  State(Gpu& device, Window& window, UiContext& ui)
      : gpu(device), swapchain(device, window, false), canvas(device, ui), ring(device) {}

  Gpu& gpu;
  Swapchain swapchain;
  UiCanvas canvas;
  FrameRing ring;
  Clock::time_point next = Clock::now();
};

DesktopMirror::DesktopMirror(Gpu& gpu, Window& window, UiContext& ui)
    : state_(std::make_unique<State>(gpu, window, ui)) {}

DesktopMirror::~DesktopMirror() {
  state_->gpu.wait_idle();
}

bool DesktopMirror::is_due() const {
  return Clock::now() >= state_->next;
}

void DesktopMirror::show(GpuImage& picture, const SeenPart& part) {
  State& s = *state_;
  if (!s.swapchain.acquire()) return;
  s.next = Clock::now() + kPeriod;
  s.canvas.fit(s.swapchain.extent());
  VkCommandBuffer commands = s.ring.begin();
  GpuImage& canvas = s.canvas.begin(commands);
  expect(picture, ImageUse::copy_from);
  blit_into(commands, picture, 0, canvas, place_in(part, canvas.extent(), picture.extent()));
  s.canvas.draw(commands, s.ring.slot());
  s.swapchain.record(commands, canvas, std::array{ShownLayer{}});
  s.ring.end(s.swapchain.acquired(), s.swapchain.rendered());
  s.swapchain.present();
}

}  // namespace gearshift
