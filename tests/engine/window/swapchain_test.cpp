#include "engine/window/swapchain.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include <doctest/doctest.h>

#include "engine/gpu/commands.h"
#include "engine/gpu/overlay.h"
#include "tests/engine/window/injected_faults.h"
#include "tests/engine/window/x_server.h"
#include "tests/support/gpu_fixture.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

constexpr int kWidth = 160, kHeight = 90;
using Rgb = std::array<int, 3>;

// Colours of the four quarters of a picture, which reveal its scale, position and orientation.
constexpr std::array<Rgb, 4> kQuarters{{{200, 30, 40}, {20, 180, 60}, {30, 60, 220}, {230, 200, 20}}};

Image four_quarters() {
  Image image{.width = kWidth, .height = kHeight, .rgba = {}};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const bool right = i % kWidth >= kWidth / 2, low = i / kWidth >= kHeight / 2;
    const Rgb& c = kQuarters[static_cast<std::size_t>(2 * low + right)];
    for (const int channel : {c[0], c[1], c[2], 255}) image.rgba.push_back(static_cast<std::uint8_t>(channel));
  }
  return image;
}

Image plain(Rgb colour) {
  Image image{.width = kWidth, .height = kHeight, .rgba = {}};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    for (const int channel : {colour[0], colour[1], colour[2], 255}) {
      image.rgba.push_back(static_cast<std::uint8_t>(channel));
    }
  }
  return image;
}

GpuConfig for_window() {
  GpuConfig config;
  config.instance_extensions = gearshift::engine::Window::instance_extensions();
  config.swapchain = true;
  return config;
}

// A window that presents a picture with two layers: one with four coloured quarters, the other plain grey.
class PictureWindow {
 public:
  explicit PictureWindow(bool vsync = true) : fixture_(for_window()), swapchain_(gpu(), window, vsync), ring_(gpu()) {
    std::vector<std::byte> texels;
    for (const Image& layer : {four_quarters(), plain({90, 90, 90})}) {
      const auto bytes = std::as_bytes(std::span(layer.rgba));
      texels.insert(texels.end(), bytes.begin(), bytes.end());
    }
    const std::vector<std::vector<std::byte>> levels{texels};
    picture_ = make_texture(gpu(), {.width = kWidth, .height = kHeight, .layers = 2, .format = kColourFormat}, levels);
    run_once(gpu(), [&](VkCommandBuffer commands) { transition(commands, picture_, ImageUse::copy_from); });
    window.poll();
    id = server.find("shown");
    REQUIRE(id != 0);
  }
  ~PictureWindow() { gpu().wait_idle(); }

  // One iteration of a program's loop. Returns true if a picture was presented.
  bool frame() {
    window.poll();
    if (!swapchain_.acquire()) return false;
    VkCommandBuffer commands = ring_.begin();
    swapchain_.record(commands, picture_, layers);
    ring_.end(swapchain_.acquired(), swapchain_.rendered());
    swapchain_.present();
    return true;
  }
  bool frame_within(int turns) {
    for (int i = 0; i < turns; ++i) {
      if (frame()) return true;
    }
    return false;
  }

  // Presents frames until the screen satisfies the predicate; returns false after ten seconds.
  template <class Predicate>
  bool eventually_shows(const Predicate& predicate) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (std::chrono::steady_clock::now() < end) {
      frame();
      if (predicate(server.picture(id))) return true;
    }
    return false;
  }

  Gpu& gpu() { return fixture_.gpu(); }
  const Swapchain& swapchain() const { return swapchain_; }
  Swapchain& swapchain() { return swapchain_; }
  bool silent() const { return fixture_.silent(); }

  XServer server;
  gearshift::engine::Window window{320, 180, "shown"};
  ::Window id = 0;
  std::vector<ShownLayer> layers{{}};

 private:
  GpuFixture fixture_;
  GpuImage picture_;
  Swapchain swapchain_;
  FrameRing ring_;
};

bool is_colour(const Image& image, double x, double y, Rgb expected) {
  const auto* p = image.pixel(static_cast<int>(x), static_cast<int>(y));
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(p[i] - expected[i]) > 2) return false;
  }
  return true;
}

// Checks that the centre of each quarter of [left, left + width) x [top, top + height) has the quarter's colour.
bool shows_quarters(const Image& image, double left, double top, double width, double height) {
  for (std::size_t q = 0; q < 4; ++q) {
    const double x = left + width * (q % 2 == 0 ? 0.25 : 0.75);
    const double y = top + height * (q < 2 ? 0.25 : 0.75);
    if (!is_colour(image, x, y, kQuarters[q])) return false;
  }
  return true;
}

// Checks that the 16:9 picture is shown as wide or as high as the window allows.
bool shows_picture(const Image& image, int width, int height) {
  if (image.width != width || image.height != height) return false;
  const double scale = std::min(static_cast<double>(width) / kWidth, static_cast<double>(height) / kHeight);
  const double w = kWidth * scale, h = kHeight * scale;
  return shows_quarters(image, (width - w) / 2, (height - h) / 2, w, h);
}

}  // namespace

TEST_CASE("a picture is as large as its part of the window allows, centred, with its aspect kept") {
  const VkExtent2D picture{1600, 900};
  const auto is = [](VkRect2D r, int x, int y, std::uint32_t w, std::uint32_t h) {
    return r.offset.x == x && r.offset.y == y && r.extent.width == w && r.extent.height == h;
  };
  CHECK(is(placement_of({}, picture, {1600, 900}), 0, 0, 1600, 900));
  CHECK(is(placement_of({}, picture, {800, 900}), 0, 225, 800, 450));
  CHECK(is(placement_of({}, picture, {3200, 900}), 800, 0, 1600, 900));
  CHECK(is(placement_of({.from = 0.0f, .to = 0.5f}, picture, {1600, 900}), 0, 225, 800, 450));
  CHECK(is(placement_of({.from = 0.5f, .to = 1.0f}, picture, {1600, 900}), 800, 225, 800, 450));
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {  // the placement is never outside the window, whatever its size
    const VkExtent2D window{1 + static_cast<std::uint32_t>(random() % 50),
                            1 + static_cast<std::uint32_t>(random() % 50)};
    const float cut = static_cast<float>(random() % 101) / 100.0f;
    for (const ShownLayer& layer : {ShownLayer{0, 0.0f, cut}, ShownLayer{1, cut, 1.0f}}) {
      const VkRect2D rect = placement_of(layer, picture, window);
      CHECK(rect.offset.x >= 0);
      CHECK(rect.offset.y >= 0);
      CHECK(rect.extent.width >= 1);
      CHECK(rect.extent.height >= 1);
      CHECK(static_cast<std::uint32_t>(rect.offset.x) + rect.extent.width <= window.width);
      CHECK(static_cast<std::uint32_t>(rect.offset.y) + rect.extent.height <= window.height);
    }
  }
}

TEST_CASE("a picture of the window's size is shown byte for byte") {
  for (const bool vsync : {true, false}) {
    PictureWindow shown(vsync);
    shown.server.resize(shown.id, kWidth, kHeight);
    const Image expected = four_quarters();
    CHECK(shown.eventually_shows([&](const Image& screen) { return screen.rgba == expected.rgba; }));
    CHECK(shown.swapchain().extent().width == kWidth);
  }
}

TEST_CASE("a scaled picture keeps its aspect, and the rest is black") {
  PictureWindow shown;
  shown.server.resize(shown.id, 500, 180);
  CHECK(shown.eventually_shows([](const Image& screen) {
    return shows_picture(screen, 500, 180) && is_colour(screen, 40, 90, {0, 0, 0}) &&
           is_colour(screen, 460, 90, {0, 0, 0});
  }));
  shown.server.resize(shown.id, 160, 300);
  CHECK(shown.eventually_shows([](const Image& screen) {
    return shows_picture(screen, 160, 300) && is_colour(screen, 80, 50, {0, 0, 0}) &&
           is_colour(screen, 80, 250, {0, 0, 0});
  }));
}

TEST_CASE("two layers are shown side by side") {
  PictureWindow shown;
  shown.layers = {{.layer = 0, .from = 0.0f, .to = 0.5f}, {.layer = 1, .from = 0.5f, .to = 1.0f}};
  CHECK(shown.eventually_shows([](const Image& screen) {
    return shows_quarters(screen, 0, 45, 160, 90) && is_colour(screen, 240, 90, {90, 90, 90}) &&
           is_colour(screen, 240, 20, {0, 0, 0});
  }));
}

TEST_CASE("a hundred sizes, sometimes minimised: each is shown, validation is silent, nothing leaks") {
  PictureWindow shown;
  REQUIRE(shown.frame_within(10));
  const VkDeviceSize before = shown.gpu().allocated();
  std::mt19937 random(9);
  int width = 0, height = 0;
  for (int i = 0; i < 100; ++i) {
    width = 1 + static_cast<int>(random() % 700);
    height = 1 + static_cast<int>(random() % 500);
    if (i % 10 == 3) {
      shown.server.unmap(shown.id);
      shown.window.poll();
      CHECK_FALSE(shown.frame());
      shown.server.resize(shown.id, width, height);
      shown.server.map(shown.id);
    } else if (i % 10 == 7) {
      shown.window.set_full_screen(!shown.window.full_screen());
      shown.frame();
      shown.server.resize(shown.id, width, height);
    } else {
      shown.server.resize(shown.id, width, height);
    }
    shown.frame_within(20);
    const VkExtent2D extent = shown.swapchain().extent();
    CHECK(extent.width == static_cast<std::uint32_t>(width));
    CHECK(extent.height == static_cast<std::uint32_t>(height));
  }
  CHECK(shown.swapchain().rebuild_count() >= 100);
  CHECK(shown.eventually_shows([&](const Image& screen) { return shows_picture(screen, width, height); }));
  CHECK(shown.gpu().allocated() == before);
}

TEST_CASE("a window that another program resizes while it draws shows the last size in the end") {
  PictureWindow shown;
  std::atomic<bool> done = false;
  std::thread other([&] {
    XServer server;
    std::mt19937 random(4);
    for (int i = 0; i < 100; ++i) {
      server.resize(shown.id, 50 + static_cast<int>(random() % 600), 50 + static_cast<int>(random() % 400));
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
    server.resize(shown.id, 480, 270);
    done = true;
  });
  int presented = 0;
  while (!done) presented += shown.frame();
  other.join();
  CHECK(presented > 0);
  CHECK(shown.eventually_shows([](const Image& screen) { return shows_picture(screen, 480, 270); }));
}

TEST_CASE("all results for a surface are handled: out of date, suboptimal, lost, timeout") {
  PictureWindow shown;
  REQUIRE(shown.frame_within(10));
  for (const VkResult result : {VK_ERROR_OUT_OF_DATE_KHR, VK_SUBOPTIMAL_KHR, VK_ERROR_SURFACE_LOST_KHR}) {
    const std::uint64_t before = shown.swapchain().rebuild_count();
    injected_faults.next_acquire = result;
    CHECK(shown.frame() == (result == VK_SUBOPTIMAL_KHR));
    CHECK(shown.frame());
    CHECK(shown.swapchain().rebuild_count() == before + 1);
    injected_faults.next_present = result;
    CHECK(shown.frame());
    CHECK(shown.frame());
    CHECK(shown.swapchain().rebuild_count() == before + 2);
  }
  const std::uint64_t before = shown.swapchain().rebuild_count();
  injected_faults.next_acquire = VK_TIMEOUT;
  CHECK_FALSE(shown.frame());
  CHECK(shown.frame());
  CHECK(shown.swapchain().rebuild_count() == before);
  CHECK(shown.eventually_shows([](const Image& screen) { return shows_picture(screen, 320, 180); }));
}

TEST_CASE("a surface lost while its images are recreated is recreated with them") {
  for (VkResult InjectedFaults::*call : {&InjectedFaults::next_capabilities, &InjectedFaults::next_create}) {
    PictureWindow shown;
    REQUIRE(shown.frame_within(10));
    injected_faults.next_present = VK_ERROR_OUT_OF_DATE_KHR;  // makes the next frame rebuild the swapchain
    REQUIRE(shown.frame());
    injected_faults.*call = VK_ERROR_SURFACE_LOST_KHR;
    CHECK_FALSE(shown.frame());
    CHECK(shown.eventually_shows([](const Image& screen) { return shows_picture(screen, 320, 180); }));
  }
}

TEST_CASE("a surface without extent is polled, and used again once it has one") {
  PictureWindow shown;
  REQUIRE(shown.frame_within(10));
  const std::uint64_t before = shown.swapchain().rebuild_count();
  injected_faults.no_extent = true;
  shown.server.resize(shown.id, 400, 300);
  while (shown.window.framebuffer() != glm::ivec2(400, 300)) shown.window.poll();
  for (int i = 0; i < 3; ++i) CHECK_FALSE(shown.frame());
  injected_faults.no_extent = false;
  CHECK(shown.frame());
  CHECK(shown.swapchain().rebuild_count() == before + 1);
}

// VUID-vkAcquireNextImageKHR-semaphore-01779: the semaphore of an acquisition must not have a pending wait. The
// semaphore of a failed acquisition has none, so it can be used again. The semaphores of earlier acquisitions may have
// one.
TEST_CASE("an acquisition that failed is tried again with the same semaphore") {
  PictureWindow shown;
  REQUIRE(shown.frame_within(10));
  injected_faults.acquired_with.clear();
  for (int i = 0; i < 5; ++i) {
    injected_faults.next_acquire = VK_TIMEOUT;
    CHECK_FALSE(shown.frame());
  }
  REQUIRE(shown.frame());
  REQUIRE(injected_faults.acquired_with.size() == 6);
  for (const VkSemaphore semaphore : injected_faults.acquired_with) {
    CHECK(semaphore == injected_faults.acquired_with.front());
  }
}

TEST_CASE("a lost device throws GpuLost; recreated window, device and swapchain show the picture again") {
  {
    PictureWindow shown;
    REQUIRE(shown.frame_within(10));
    injected_faults.next_acquire = VK_ERROR_DEVICE_LOST;
    CHECK_THROWS_AS(shown.frame(), GpuLost);
  }
  {
    PictureWindow shown;
    REQUIRE(shown.frame_within(10));
    injected_faults.next_present = VK_ERROR_DEVICE_LOST;
    CHECK_THROWS_AS(shown.frame(), GpuLost);
  }
  PictureWindow shown;
  CHECK(shown.eventually_shows([](const Image& screen) { return shows_picture(screen, 320, 180); }));
}
