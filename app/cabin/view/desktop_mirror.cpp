#include "app/cabin/view/desktop_mirror.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "app/cabin/view/ui_canvas.h"
#include "engine/gpu/commands.h"
#include "engine/window/swapchain.h"

namespace gearshift::cabin {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPeriod = std::chrono::microseconds(33'000);

// [px] Rectangle of the picture, which is fitted into the visible part of the canvas and centred there.
VkRect2D place_in(const VisibleRegion& part, VkExtent2D canvas, VkExtent2D picture) {
  const glm::dvec2 size(canvas.width, canvas.height);
  const glm::dvec2 low = part.low * size, room = (part.high - part.low) * size;
  const double scale = std::min(room.x / picture.width, room.y / picture.height);
  const glm::dvec2 shown = scale * glm::dvec2(picture.width, picture.height);
  const glm::dvec2 corner = low + 0.5 * (room - shown);
  const auto to_pixel = [](double px) { return static_cast<std::int32_t>(std::floor(px)); };
  const VkOffset2D at{std::max(0, to_pixel(corner.x)), std::max(0, to_pixel(corner.y))};
  const auto length = [&](double px, std::int32_t from, std::uint32_t side) {
    return std::min(static_cast<std::uint32_t>(std::max(1, to_pixel(px))), side - static_cast<std::uint32_t>(from));
  };
  return {at, {length(shown.x, at.x, canvas.width), length(shown.y, at.y, canvas.height)}};
}

VkExtent2D extent_of(glm::ivec2 size) {
  return {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)};
}

}  // namespace

struct DesktopMirror::State {
  State(engine::Gpu& device, engine::Window& window, engine::UiContext& ui, glm::ivec2 size)
      : gpu(device), swapchain(device, window, false), canvas(device, ui), ring(device) {
    canvas.fit(extent_of(size));
  }

  engine::Gpu& gpu;
  engine::Swapchain swapchain;
  UiCanvas canvas;
  engine::FrameRing ring;
  Clock::time_point next = Clock::now();
};

glm::dvec2 in_mirrored_panel(glm::dvec2 mouse, glm::ivec2 panel, glm::ivec2 window) {
  if (std::min(window.x, window.y) <= 0) return mouse;  // the window is minimised
  const VkRect2D place = engine::placement_of(engine::ShownLayer{}, extent_of(panel), extent_of(window));
  const glm::dvec2 corner(place.offset.x, place.offset.y), shown(place.extent.width, place.extent.height);
  return (mouse - corner) / shown * glm::dvec2(panel);
}

DesktopMirror::DesktopMirror(engine::Gpu& gpu, engine::Window& window, engine::UiContext& ui, glm::ivec2 size)
    : state_(std::make_unique<State>(gpu, window, ui, size)) {}

DesktopMirror::~DesktopMirror() {
  state_->gpu.wait_idle();
}

bool DesktopMirror::is_due() const {
  return Clock::now() >= state_->next;
}

void DesktopMirror::show(engine::GpuImage& picture, const VisibleRegion& part) {
  State& s = *state_;
  if (!s.swapchain.acquire()) return;
  s.next = Clock::now() + kPeriod;
  VkCommandBuffer commands = s.ring.begin();
  engine::GpuImage& canvas = s.canvas.begin(commands);
  engine::expect(picture, engine::ImageUse::copy_from);
  engine::blit_into(commands, picture, 0, canvas, place_in(part, canvas.extent(), picture.extent()));
  s.canvas.draw(commands, s.ring.slot());
  s.swapchain.record(commands, canvas, std::array{engine::ShownLayer{}});
  s.ring.end(s.swapchain.acquired(), s.swapchain.rendered());
  s.swapchain.present();
}

}  // namespace gearshift::cabin
