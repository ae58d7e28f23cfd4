// Tests sequences of frames: several frames in flight, changed models, and rejected input.
#include <cstring>

#include "engine/gpu/gpu_buffer.h"
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::vec3;

namespace {

// Copies the picture of its frame before the next frame overwrites it.
struct PictureCopy final : Renderer::Finish {
  PictureCopy(Gpu& gpu, int width, int height)
      : buffer(gpu, VkDeviceSize{4} * static_cast<unsigned>(width * height), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               MemoryKind::read_back) {}
  void record(VkCommandBuffer commands, GpuImage& colour, int) override {
    expect(colour, ImageUse::copy_from);
    const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                 .imageExtent = {colour.desc().width, colour.desc().height, 1}};
    vkCmdCopyImageToBuffer(commands, colour.get(), layout_of(ImageUse::copy_from), buffer.get(), 1, &copy);
    make_copies_visible_to_host(commands);
  }
  Image picture(int width, int height) const {
    Image image{width, height, std::vector<std::uint8_t>(buffer.size())};
    std::memcpy(image.rgba.data(), buffer.mapped(), buffer.size());
    return image;
  }
  GpuBuffer buffer;
};

// Fills the left half of the picture with one colour.
struct HalfCover final : Overlay {
  void draw(VkCommandBuffer commands, VkExtent2D extent, int) override {
    const VkClearAttachment clear{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .clearValue = {{{0.5f, 0.25f, 1.0f, 1.0f}}}};
    const VkClearRect left{{{0, 0}, {extent.width / 2, extent.height}}, 0, 1};
    vkCmdClearAttachments(commands, 1, &clear, 1, &left);
    ++drawn;
  }
  int drawn = 0;
};

Model patch() {
  Model model;
  add_rectangle(model, "Patch", {0.3f, 0.3f}, add_material(model, lamp({1, 1, 1})), {});
  return model;
}

// The patch, shifted by changing its vertices.
DeformedMesh shifted_patch(float x) {
  DeformedMesh mesh{0, rectangle(0.3f, 0.3f)};
  for (Vertex& vertex : mesh.vertices) vertex.position.x += x;
  return mesh;
}

}  // namespace

TEST_CASE("each frame in flight shows its own deformed mesh, even far away from the original mesh") {
  GpuFixture fixture;
  const RenderConfig config = small_picture();
  Renderer renderer(fixture.gpu(), config);
  renderer.set_environment(constant_sky(vec3(0.0f)));
  const Model model = patch();
  renderer.set_model(model);
  FrameScene scene = scene_at_rest(model);
  scene.nodes[0].world =
      glm::translate(glm::mat4(1.0f), vec3(-4.0f, 0.0f, 0.0f));  // the node is outside the view; its vertices are not
  const View view = view_at(config, look_at({0, 0, 3}, {0, 0, 0}));
  std::vector<PictureCopy> copies;
  for (int i = 0; i < 7; ++i) copies.emplace_back(fixture.gpu(), config.width, config.height);
  std::uint64_t last = 0;
  for (int i = 0; i < 7; ++i) {
    scene.deformed = {shifted_patch(4.0f + 0.25f * static_cast<float>(i - 3))};
    // draw() does not wait for earlier frames.
    last = renderer.draw(scene, {&view, 1}, {}, copies[static_cast<std::size_t>(i)]);
  }
  fixture.gpu().wait(last);
  for (int i = 0; i < 7; ++i) {
    const glm::dvec3 expected = project(view, {0.25 * (i - 3), 0.0, 0.0}, {160, 120});
    const glm::dvec2 measured = centroid(copies[static_cast<std::size_t>(i)].picture(160, 120), 1);
    CAPTURE(i);
    CHECK(std::abs(measured.x - expected.x) < 0.5);
  }
}

TEST_CASE("two nodes with one mesh each show their own vertices, and a third node shows those of the model") {
  GpuFixture fixture;
  const RenderConfig config = small_picture();
  Renderer renderer(fixture.gpu(), config);
  renderer.set_environment(constant_sky(vec3(0.0f)));
  Model model = patch();
  for (const char* name : {"Second", "Third"}) add_node(model, name, 0, {});
  renderer.set_model(model);
  FrameScene scene = scene_at_rest(model);
  scene.deformed = {shifted_patch(-1.0f), shifted_patch(1.0f)};
  scene.deformed[0].node = 0;
  scene.deformed[1].node = 1;
  const View view = view_at(config, look_at({0, 0, 3}, {0, 0, 0}));
  renderer.draw(scene, {&view, 1});
  const Image picture = renderer.read_eye(0);
  for (const double x : {-1.0, 0.0, 1.0}) {
    const glm::dvec3 at = project(view, {x, 0.0, 0.0}, {160, 120});
    CAPTURE(x);
    CHECK(picture.pixel(int(at.x), int(at.y))[0] > 100);
  }
}

TEST_CASE("a deformed mesh of the wrong size, a scene of a different model and a wrong number of views are rejected") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  const Model model = patch();
  renderer.set_model(model);
  const View view = view_at(renderer.config(), look_at({0, 0, 3}, {0, 0, 0}));
  FrameScene good = scene_at_rest(model), scene = good;
  scene.deformed = {{0, std::vector<Vertex>(3)}};
  CHECK_THROWS_AS(renderer.draw(scene, {&view, 1}), std::invalid_argument);
  scene.deformed = {{7, rectangle(1, 1)}};
  CHECK_THROWS_AS(renderer.draw(scene, {&view, 1}), std::invalid_argument);
  CHECK_THROWS_AS(renderer.draw(FrameScene{}, {&view, 1}), std::invalid_argument);
  CHECK_THROWS_AS(renderer.draw(good, {}), std::invalid_argument);
  scene = good;
  scene.mirror = 5;
  CHECK_THROWS_AS(renderer.draw(scene, {&view, 1}), std::invalid_argument);
  CHECK_NOTHROW(renderer.draw(good, {&view, 1}));
  CHECK(centroid(renderer.read_eye(0), 0).x > 0.0);
}

TEST_CASE("a configuration out of range is rejected, and the renderer stays unchanged") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  const auto refused = [&](auto change) {
    RenderConfig config = small_picture();
    change(config);
    CHECK_THROWS_AS(renderer.resize(config), std::invalid_argument);
  };
  refused([](RenderConfig& c) { c.width = 0; });
  refused([](RenderConfig& c) { c.height = 20000; });
  refused([](RenderConfig& c) { c.eyes = 3; });
  refused([](RenderConfig& c) { c.samples = 2; });
  refused([](RenderConfig& c) { c.shadow_side = 5; });
  refused([](RenderConfig& c) { c.mirror_height = -1; });
  CHECK(renderer.config().width == 160);
}

TEST_CASE("a new model replaces the previous one, even while frames are in flight") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  renderer.set_environment(constant_sky(vec3(0.0f)));
  const View view = view_at(renderer.config(), look_at({0, 0, 3}, {0, 0, 0}));
  for (int i = 0; i < 4; ++i) {
    Model model;
    add_rectangle(model, "Patch", {0.3f, 0.3f}, add_material(model, lamp(i % 2 == 0 ? vec3(1, 0, 0) : vec3(0, 1, 0))),
                  {});
    renderer.set_model(model);
    renderer.draw(scene_at_rest(model), {&view, 1});
    renderer.draw(scene_at_rest(model), {&view, 1});
  }
  const Image last = renderer.read_eye(0);
  CHECK(centroid(last, 1).x > 0.0);
  CHECK(centroid(last, 0, 100).x < 0.0);
}

TEST_CASE("an overlay covers only its part of every eye's picture, in display values") {
  GpuFixture fixture;
  for (const int samples : {1, 4}) {
    RenderConfig config = small_picture();
    config.eyes = 2;
    config.samples = samples;
    Renderer renderer(fixture.gpu(), config);
    renderer.set_environment(constant_sky({0.1f, 0.4f, 0.1f}));
    const View view = view_at(config, look_at({0, 0, 3}, {0, 0, 0}));
    const std::array views{view, view};
    HalfCover cover;
    Overlay* const overlay = &cover;
    renderer.draw(FrameScene{}, views, {&overlay, 1});
    CHECK(cover.drawn == 2);
    for (int eye = 0; eye < 2; ++eye) {
      const Image picture = renderer.read_eye(eye);
      CHECK(std::abs(picture.pixel(20, 60)[0] - 128) <= 1);
      CHECK(picture.pixel(20, 60)[1] == 64);
      CHECK(picture.pixel(20, 60)[2] == 255);
      check_displayed(picture, 140, 60, {0.1, 0.4, 0.1});
    }
  }
}

TEST_CASE("a frame of a million triangles is drawn to the last of them") {
  GpuFixture fixture;
  const RenderConfig config = small_picture(32, 24);
  Renderer renderer(fixture.gpu(), config);
  renderer.set_environment(constant_sky(vec3(0.0f)));
  constexpr std::uint32_t kNodes = 200, kTriangles = 5000;
  Model model = patch();
  for (std::uint32_t i = 1; i < kTriangles; ++i) model.indices.insert(model.indices.end(), {0u, 0u, 0u});
  model.meshes[0].primitives[0].index_count = 3 * kTriangles;
  model.nodes.resize(kNodes, model.nodes[0]);
  add_rectangle(model, "Last", {0.3f, 0.3f}, add_material(model, lamp({0, 1, 0})), {0.0f, 0.0f, 0.1f});
  renderer.set_model(model);
  const View view = view_at(config, look_at({0, 0, 3}, {0, 0, 0}));
  renderer.draw(scene_at_rest(model), {&view, 1});
  const Image picture = renderer.read_eye(0);
  CHECK(picture.pixel(16, 12)[1] > picture.pixel(16, 12)[0] + 100);  // the green square is in front of the white patch
}

TEST_CASE("the times of the passes add up to the time of the frame") {
  GpuFixture fixture;
  RenderConfig config = small_picture();
  config.shadow_side = 64;
  Renderer renderer(fixture.gpu(), config);
  const Model model = patch();
  renderer.set_model(model);
  const View view = view_at(config, look_at({0, 0, 3}, {0, 0, 0}));
  for (int i = 0; i < 4; ++i) renderer.draw(scene_at_rest(model), {&view, 1});
  const PassTimes& t = renderer.times();
  REQUIRE(fixture.gpu().traits().timestamp_bits > 0);
  CHECK(t.main > 0.0);
  CHECK(t.all == doctest::Approx(t.shadow + t.depth + t.mirror + t.main + t.overlay));
}
