// Compares our drawing of a Dear ImGui frame with a CPU reference (ui_raster.h).
#include <array>
#include <functional>
#include <string>

#include <doctest/doctest.h>

#include "engine/gpu/commands.h"
#include "engine/gpu/gpu_image.h"
#include "engine/ui/ui.h"
#include "engine/ui/ui_style.h"
#include "tests/engine/ui/ui_raster.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/pictures.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

constexpr std::array<int, 3> kBackground{40, 80, 120};

// A picture whose UNORM view receives the overlay, as in the renderer.
struct Screen {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  UiContext context;
  UiOverlay overlay{gpu, context};
  UiInput size;

  explicit Screen(float width = 320.0f, float height = 200.0f) {
    size.width = width;
    size.height = height;
  }

  void build(const std::function<void(ImDrawList&)>& paint) {
    context.begin(size);
    paint(*ImGui::GetBackgroundDrawList());
    context.end();
  }

  Image draw(int slot = 0) {
    GpuImage picture(gpu, {.width = static_cast<std::uint32_t>(size.width),
                           .height = static_cast<std::uint32_t>(size.height),
                           .format = kColourFormat,
                           .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                           .second_format = kOverlayFormat});
    const ImageView view = make_view(gpu, picture, VK_IMAGE_VIEW_TYPE_2D, 0, 1, kOverlayFormat);
    run_once(gpu, [&](VkCommandBuffer commands) {
      transition(commands, picture, ImageUse::colour_target);
      const VkRenderingAttachmentInfo colour{
          .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
          .imageView = view.get(),
          .imageLayout = layout_of(ImageUse::colour_target),
          .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
          .clearValue = {
              .color = {.float32 = {kBackground[0] / 255.0f, kBackground[1] / 255.0f, kBackground[2] / 255.0f, 1.0f}}}};
      const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                 .renderArea = {.extent = picture.extent()},
                                 .layerCount = 1,
                                 .colorAttachmentCount = 1,
                                 .pColorAttachments = &colour};
      vkCmdBeginRendering(commands, &info);
      overlay.draw(commands, picture.extent(), slot);
      vkCmdEndRendering(commands);
    });
    return read_back(gpu, picture);
  }
  Image expected() const { return UiRaster(*ImGui::GetDrawData(), kBackground).draw(); }
};

std::array<int, 3> at(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return {p[0], p[1], p[2]};
}

int pixels_unlike(const Image& image, std::array<int, 3> colour) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) count += at(image, x, y) != colour;
  }
  return count;
}

}  // namespace

TEST_CASE("a rectangle has its colour, exactly, in its pixels and in no other") {
  Screen screen;
  screen.build([](ImDrawList& list) { list.AddRectFilled({10, 20}, {60, 50}, IM_COL32(200, 100, 50, 255)); });
  const Image image = screen.draw();
  CHECK(at(image, 10, 20) == std::array{200, 100, 50});
  CHECK(at(image, 59, 49) == std::array{200, 100, 50});
  CHECK(at(image, 9, 20) == kBackground);
  CHECK(at(image, 10, 19) == kBackground);
  CHECK(at(image, 60, 49) == kBackground);
  CHECK(at(image, 59, 50) == kBackground);
  CHECK(pixels_unlike(image, kBackground) == 50 * 30);
}

TEST_CASE("half transparency blends half of the background, display-referred") {
  Screen screen;
  screen.build([](ImDrawList& list) { list.AddRectFilled({0, 0}, {8, 8}, IM_COL32(255, 255, 255, 128)); });
  const std::array<int, 3> blended = at(screen.draw(), 4, 4);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(blended[i] == doctest::Approx(255.0 * 128.0 / 255.0 + kBackground[i] * 127.0 / 255.0).epsilon(0.01));
}

TEST_CASE("nothing is drawn outside a clip rectangle, and one outside the screen is allowed") {
  Screen screen;
  screen.build([](ImDrawList& list) {
    list.PushClipRect({30, 40}, {50, 70});
    list.AddRectFilled({0, 0}, {320, 200}, IM_COL32(255, 0, 0, 255));
    list.PopClipRect();
    list.PushClipRect({-500, -500}, {-10, -10});
    list.AddRectFilled({-600, -600}, {320, 200}, IM_COL32(0, 255, 0, 255));
    list.PopClipRect();
    list.PushClipRect({310, 190}, {4000, 4000});
    list.AddRectFilled({300, 180}, {4000, 4000}, IM_COL32(0, 0, 255, 255));
    list.PopClipRect();
  });
  const Image image = screen.draw();
  CHECK(at(image, 30, 40) == std::array{255, 0, 0});
  CHECK(at(image, 49, 69) == std::array{255, 0, 0});
  CHECK(at(image, 319, 199) == std::array{0, 0, 255});
  CHECK(pixels_unlike(image, kBackground) == 20 * 30 + 10 * 10);
}

TEST_CASE("text, curves and transparency match the definition to within two steps of 255") {
  Screen screen;
  screen.build([](ImDrawList& list) {
    list.AddText({12, 10}, IM_COL32_WHITE, "Gearshift 5000 N/m");
    list.AddText(ui_font(UiFont::digits), 42.0f, {12, 40}, IM_COL32(255, 190, 60, 255), "R123");
    list.AddCircleFilled({220, 100}, 33.3f, IM_COL32(90, 200, 160, 150));
    list.AddLine({10.3f, 180.2f}, {300.7f, 120.9f}, IM_COL32(255, 80, 70, 255), 2.0f);
    list.AddRect({150.5f, 20.5f}, {310.5f, 90.5f}, IM_COL32(255, 255, 255, 90), 8.0f, 0, 3.0f);
  });
  const Image image = screen.draw(), expected = screen.expected();
  const ImageDifference error = difference(image, expected, 2);
  MESSAGE("psnr " << error.psnr << " dB, worst " << error.worst << "/255");
  CHECK(error.worst <= 2);
  CHECK(pixels_unlike(image, kBackground) > 3000);
  // A picture shifted by one pixel differs, so the comparison can fail.
  CHECK(difference(crop(image, 1, 0, 318, 200), crop(expected, 0, 0, 318, 200), 2).fraction_beyond > 0.02);
}

TEST_CASE("the buffers of a slot grow with the frame, also beyond 65536 vertices, and the picture stays correct") {
  Screen screen;
  const auto tiles = [&screen](int count) {
    screen.build([count](ImDrawList& list) {
      for (int i = 0; i < count; ++i) {
        const float x = static_cast<float>(2 * (i % 160)), y = static_cast<float>(2 * ((i / 160) % 100));
        list.AddRectFilled({x, y}, {x + 1, y + 1}, IM_COL32(255, 255, 0, 255));
      }
    });
  };
  for (const int count : {10, 4000, 16000, 100}) {  // four vertices per tile: up to 64,000
    for (const int slot : {0, 1}) {
      tiles(count);
      CHECK(pixels_unlike(screen.draw(slot), kBackground) == count);
    }
  }
  tiles(40000);  // 160,000 vertices; 16,000 tiles fill the screen, the other tiles overlap these
  CHECK(ImGui::GetDrawData()->TotalVtxCount > 65536);
  CHECK(pixels_unlike(screen.draw(0), kBackground) == 16000);
}

TEST_CASE("a changed scale rebuilds the font, and drawing continues") {
  Screen screen;
  const auto text = [](ImDrawList& list) { list.AddText({4, 4}, IM_COL32_WHITE, "neutral"); };
  screen.build(text);
  const int small = pixels_unlike(screen.draw(), kBackground);
  screen.size.scale = 2.0f;
  screen.build(text);
  const Image image = screen.draw();
  CHECK(pixels_unlike(image, kBackground) > 2 * small);
  CHECK(difference(image, screen.expected()).worst <= 2);
}

TEST_CASE("an empty frame draws nothing, and an unknown texture throws") {
  Screen screen;
  CHECK(pixels_unlike(screen.draw(), kBackground) == 0);  // nothing is drawn before the first frame
  screen.build([](ImDrawList&) {});
  CHECK(pixels_unlike(screen.draw(), kBackground) == 0);
  int foreign = 77;
  screen.build([&](ImDrawList& list) { list.AddImage(&foreign, {0, 0}, {10, 10}); });
  CHECK_THROWS_AS(screen.draw(), std::logic_error);
}
