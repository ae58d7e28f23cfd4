#include <array>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/pipeline.h"
#include "tests/engine/gpu/canvas.h"
#include "tests/engine/gpu/glsl.h"
#include "tests/support/gpu_fixture.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

struct Point {
  float x, y, z;
};
using Triangle = std::array<Point, 3>;

// Shaders that take red and green from specialization constants, and blue and alpha from push constants.
constexpr const char* kVertex = R"(#version 450
layout(location = 0) in vec3 position;
void main() { gl_Position = vec4(position, 1.0); })";
constexpr const char* kFragment = R"(#version 450
layout(constant_id = 0) const uint red = 0u;
layout(constant_id = 1) const uint green = 0u;
layout(push_constant) uniform Push { float blue, alpha; };
layout(location = 0) out vec4 colour;
void main() { colour = vec4(red / 255.0, green / 255.0, blue, alpha); })";

struct Brush {
  Brush(Gpu& device, std::uint32_t red, std::uint32_t green, Blend blend, Depth depth)
      : gpu(device), layout(make_pipeline_layout(gpu, {}, 8)) {
    const auto vertex = compile_glsl("vert", kVertex);
    const auto fragment = compile_glsl("frag", kFragment);
    const std::array constants{red, green};
    pipeline =
        make_pipeline(gpu, {.vertex = vertex,
                            .fragment = fragment,
                            .layout = layout.get(),
                            .input = {.stride = sizeof(Point), .attributes = {{.format = VK_FORMAT_R32G32B32_SFLOAT}}},
                            .colour = VK_FORMAT_R8G8B8A8_UNORM,
                            .depth = VK_FORMAT_D32_SFLOAT,
                            .blend = blend,
                            .depth_use = depth,
                            .constants = constants});
  }
  void stroke(VkCommandBuffer commands, const GpuBuffer& triangle, float blue, float alpha) {
    const std::array push{blue, alpha};
    const VkDeviceSize start = 0;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    vkCmdPushConstants(commands, layout.get(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, 8,
                       push.data());
    VkBuffer vertices = triangle.get();
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &start);
    vkCmdDraw(commands, 3, 1, 0, 0);
  }
  Gpu& gpu;
  PipelineLayout layout;
  Pipeline pipeline;
};

GpuBuffer upload(Gpu& gpu, const Triangle& triangle) {
  return make_device_buffer(gpu, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, std::as_bytes(std::span(triangle)));
}

Triangle full_screen_triangle(float depth) {
  return {{{-1, -1, depth}, {3, -1, depth}, {-1, 3, depth}}};
}

std::array<int, 4> colour_at(const Image& image, int x, int y) {
  const auto* p = image.pixel(x, y);
  return {p[0], p[1], p[2], p[3]};
}

}  // namespace

TEST_CASE("a cleared target reads back as its clear value in every pixel") {
  GpuFixture fixture;
  Canvas canvas(fixture.gpu(), 37, 23);
  run_once(fixture.gpu(), [&](VkCommandBuffer commands) {
    canvas.draw(commands, {51.0f / 255.0f, 102.0f / 255.0f, 1.0f, 0.0f});
  });
  const Image image = read_back(fixture.gpu(), canvas.colour);
  REQUIRE(image.width == 37);
  REQUIRE(image.height == 23);
  for (int i = 0; i < 37 * 23; ++i) CHECK(colour_at(image, i % 37, i / 37) == std::array{51, 102, 255, 0});
}

TEST_CASE("a triangle covers the pixels whose centres lie inside it and no others") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  constexpr int side = 128;
  Canvas canvas(gpu, side, side);
  Brush brush(gpu, 200, 100, Blend::none, Depth::none);
  const Triangle triangle{{{-0.83f, -0.71f, 0.5f}, {0.91f, -0.13f, 0.5f}, {-0.27f, 0.77f, 0.5f}}};
  const GpuBuffer vertices = upload(gpu, triangle);
  run_once(gpu, [&](VkCommandBuffer commands) {
    canvas.draw(commands, {}, [&] { brush.stroke(commands, vertices, 50.0f / 255.0f, 1.0f); });
  });
  const Image image = read_back(gpu, canvas.colour);
  // Converts a vertex to pixels. Pixels whose centre is less than 0.01 pixel from an edge are not checked, because the
  // rasterizer snaps vertices to 1/256 pixel.
  const auto pixel = [](Point p) { return std::array{(p.x + 1) * side / 2.0, (p.y + 1) * side / 2.0}; };
  int inside = 0, undecided = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      double nearest = 1e9;
      for (std::size_t e = 0; e < 3; ++e) {
        const auto a = pixel(triangle[e]), b = pixel(triangle[(e + 1) % 3]);
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        nearest = std::min(nearest, (dx * (y + 0.5 - a[1]) - dy * (x + 0.5 - a[0])) / std::hypot(dx, dy));
      }
      if (std::abs(nearest) < 0.01) {
        ++undecided;
        continue;
      }
      inside += nearest > 0.0;
      const std::array<int, 4> expected = nearest > 0.0 ? std::array{200, 100, 50, 255} : std::array{0, 0, 0, 0};
      CHECK(colour_at(image, x, y) == expected);
    }
  }
  CHECK(inside > 4000);
  CHECK(undecided < 20);
}

TEST_CASE("reverse-Z: the greater depth is nearer, in any drawing order; without a depth test the last drawn wins") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  Canvas canvas(gpu, 8, 8);
  const GpuBuffer near = upload(gpu, full_screen_triangle(0.75f)), far = upload(gpu, full_screen_triangle(0.25f));
  Brush red(gpu, 255, 0, Blend::none, Depth::write), green(gpu, 0, 255, Blend::none, Depth::write);
  Brush without_depth_test(gpu, 0, 0, Blend::none, Depth::none), test_only(gpu, 128, 128, Blend::none, Depth::test);
  const auto drawn = [&](const std::function<void(VkCommandBuffer)>& strokes) {
    run_once(gpu, [&](VkCommandBuffer commands) { canvas.draw(commands, {}, [&] { strokes(commands); }); });
    return colour_at(read_back(gpu, canvas.colour), 4, 4);
  };
  const std::array red_wins{255, 0, 0, 255};
  CHECK(drawn([&](auto c) { red.stroke(c, near, 0, 1), green.stroke(c, far, 0, 1); }) == red_wins);
  CHECK(drawn([&](auto c) { green.stroke(c, far, 0, 1), red.stroke(c, near, 0, 1); }) == red_wins);
  CHECK(drawn([&](auto c) { red.stroke(c, near, 0, 1), without_depth_test.stroke(c, far, 1, 1); }) ==
        std::array{0, 0, 255, 255});
  // A depth test without depth writes leaves the depth unchanged. A triangle behind the tested one is then still
  // visible.
  CHECK(drawn([&](auto c) { test_only.stroke(c, near, 0, 1), green.stroke(c, far, 0, 1); }) ==
        std::array{0, 255, 0, 255});
  CHECK(drawn([&](auto c) { red.stroke(c, near, 0, 1), test_only.stroke(c, far, 0, 1); }) == red_wins);
}

TEST_CASE("alpha blending is source over: s a + d (1 - a)") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  Canvas canvas(gpu, 4, 4);
  Brush brush(gpu, 240, 60, Blend::alpha, Depth::none);
  const GpuBuffer vertices = upload(gpu, full_screen_triangle(0.5f));
  for (const float alpha : {0.0f, 0.25f, 0.6f, 1.0f}) {
    run_once(gpu, [&](VkCommandBuffer commands) {
      canvas.draw(commands, {0.2f, 0.4f, 0.8f, 0.5f}, [&] { brush.stroke(commands, vertices, 1.0f, alpha); });
    });
    const auto blended = colour_at(read_back(gpu, canvas.colour), 2, 2);
    const std::array source{240.0f / 255.0f, 60.0f / 255.0f, 1.0f}, under{0.2f, 0.4f, 0.8f};
    for (std::size_t i = 0; i < 3; ++i) {
      const float expected = source[i] * alpha + under[i] * (1.0f - alpha);
      CHECK(std::abs(static_cast<float>(blended[i]) - 255.0f * expected) <= 1.0f);
    }
    CHECK(std::abs(static_cast<float>(blended[3]) - 255.0f * (alpha + 0.5f * (1.0f - alpha))) <= 1.0f);
  }
}

TEST_CASE("a texture sampled through a descriptor set has the uploaded texels") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  Image picture{.width = 16, .height = 8, .rgba = {}};
  for (int i = 0; i < 16 * 8 * 4; ++i) picture.rgba.push_back(static_cast<std::uint8_t>(i * 37 % 251));
  const GpuImage texture = make_texture(gpu, picture, false, true);
  CHECK(texture.desc().levels == 5);
  const ImageView view = make_view(gpu, texture, VK_IMAGE_VIEW_TYPE_2D);
  const Sampler sampler = make_sampler(gpu, {.anisotropic = true});
  const std::array bindings{Binding{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}};
  const SetLayout set_layout = make_set_layout(gpu, bindings);
  const PipelineLayout layout = make_pipeline_layout(gpu, std::array{set_layout.get()}, 0);
  SetPool pool(gpu, 1, std::array{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}});
  VkDescriptorSet set = pool.make(set_layout.get());
  bind_texture(gpu, set, 0, view.get(), sampler.get());
  const auto vertex = compile_glsl("vert", R"(#version 450
void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, 0.5, 1.0); })");
  const auto fragment = compile_glsl("frag", R"(#version 450
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 colour;
void main() { colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); })");
  const Pipeline pipeline = make_pipeline(gpu, {.vertex = vertex,
                                                .fragment = fragment,
                                                .layout = layout.get(),
                                                .colour = VK_FORMAT_R8G8B8A8_UNORM,
                                                .depth = VK_FORMAT_D32_SFLOAT});
  Canvas canvas(gpu, 16, 8);
  run_once(gpu, [&](VkCommandBuffer commands) {
    expect(texture, ImageUse::sampled);
    canvas.draw(commands, {}, [&] {
      vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 0, 1, &set, 0, nullptr);
      vkCmdDraw(commands, 3, 1, 0, 0);
    });
  });
  CHECK(read_back(gpu, canvas.colour).rgba == picture.rgba);
}
