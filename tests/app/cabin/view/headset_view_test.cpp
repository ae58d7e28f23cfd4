// The complete headset view on the emulated OpenXR runtime: the cabin, the hanging panel, and the instructor's mirror
// window.
#include "app/cabin/view/headset_view.h"

#include <imgui.h>
#include <malloc.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/cabin/stage/stage.h"
#include "app/cabin/view/desktop_mirror.h"
#include "engine/render/renderer.h"
#include "engine/xr/headset_thread.h"
#include "tests/engine/render/render_bench.h"
#include "tests/engine/window/injected_faults.h"
#include "tests/engine/window/x_server.h"
#include "tests/support/gates.h"
#include "tests/support/xr_runtime/control.h"

using namespace gearshift;
using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;
using glm::dvec3;
using Kind = xr_test::Event::Kind;
using glm::vec3;

namespace {

constexpr double kNear = 0.05;          // [m]
constexpr glm::ivec2 kPanel{400, 300};  // [px]
const EyePose kRoomInCabin{{0.3, -0.5, 0.2}, glm::angleAxis(0.4, dvec3(0, 1, 0))};

// A head whose yaw changes by up to 100 deg/s, which is 1.1 degrees per display period of 11 ms.
xr_test::Pose turning_head(double seconds) {
  return {dvec3(0.05 * std::sin(4.0 * seconds), 1.0 + 0.03 * std::cos(3.0 * seconds), 0.1 * std::sin(2.0 * seconds)),
          glm::angleAxis(0.25 * std::sin(7.0 * seconds), dvec3(0, 1, 0)) *
              glm::angleAxis(0.15 * std::cos(5.0 * seconds), dvec3(1, 0, 0)) *
              glm::angleAxis(0.05 * std::sin(3.0 * seconds), dvec3(0, 0, 1))};
}

// A view of the test runtime's headset, opened.
std::unique_ptr<HeadsetView> open_view(const HeadsetViewConfig& config, gearshift::engine::Window& window,
                                       UiContext& ui) {
  auto opening = std::make_unique<OpeningHeadset>(config);
  while (!opening->is_open()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return std::make_unique<HeadsetView>(std::move(opening), window, ui);
}

struct HeadsetRig {
  explicit HeadsetRig(int samples = 1, bool worn = true) : window(400, 300, "mirror") {
    choose_software_driver();
    setenv("GEARSHIFT_VALIDATION", "1", 1);
    xr_test::Control& xr = xr_test::control();
    xr.start();
    xr.script.stage = false;
    xr.script.recommended_width = 256;
    xr.script.recommended_height = 192;
    xr.script.capture_every = 1;
    if (!worn) xr.script.polls_before_ready = 1000000;  // keeps the OpenXR session idle
    HeadsetViewConfig config;
    config.samples = samples;
    config.near_plane = kNear;
    config.panel = kPanel;
    view = open_view(config, window, ui);
  }
  ~HeadsetRig() {
    CHECK(view->validation_messages() == 0);
    view.reset();
    CHECK(HeadsetThread::wait_for_ended(std::chrono::seconds(20)));
    CHECK(xr_test::complaints() == "");
    CHECK(xr_test::control().record.live_handles == 0);
  }

  // Shows one frame, with a red square in the panel's upper left corner.
  void frame(const FrameScene& scene, const HeadsetPanel* panel = nullptr, VisibleRegion visible = {}) {
    window.poll();
    ui.begin({static_cast<float>(kPanel.x), static_cast<float>(kPanel.y), 0.01f, 1.0f});
    ImGui::GetForegroundDrawList()->AddRectFilled({0.0f, 0.0f}, {40.0f, 30.0f}, IM_COL32(255, 0, 0, 255));
    ui.end();
    // On a busy machine the runtime may not return in time from a call.
    do {
      (void)view->begin();
      view->draw(scene, kRoomInCabin, panel, visible);
    } while (view->is_held());
  }

  gearshift::engine::Window window;
  UiContext ui;
  std::unique_ptr<HeadsetView> view;
};

// A green wall that fills the view ahead of the room's origin.
FrameScene green_wall(HeadsetRig& rig) {
  Model model;
  add_rectangle(model, "Lamp", {9.0f, 9.0f}, add_material(model, lamp({0.0f, 4.0f, 0.0f})), {});
  rig.view->set_model(model);
  FrameScene scene = scene_at_rest(model);
  scene.nodes[0].world = glm::translate(glm::mat4(1.0f), vec3(kRoomInCabin * dvec3(0.0, 0.0, -1.0))) *
                         glm::mat4_cast(glm::quat(kRoomInCabin.orientation));
  return scene;
}

std::vector<const xr_test::FrameRecord*> shown_frames() {
  std::vector<const xr_test::FrameRecord*> shown;
  for (const xr_test::FrameRecord& frame : xr_test::control().record.frames)
    if (frame.projection() != nullptr) shown.push_back(&frame);
  return shown;
}

// The pose of an eye in the cabin at `seconds` of the script, computed by hand from the head's pose, half the
// interpupillary distance to the side, and the room's pose.
EyePose eye_at(double seconds, int eye) {
  const xr_test::Pose head = turning_head(seconds);
  const dvec3 at = head.position + head.orientation * dvec3(eye == 0 ? -0.0315 : 0.0315, 0.0, 0.0);
  return {kRoomInCabin.position + kRoomInCabin.orientation * at, kRoomInCabin.orientation * head.orientation};
}

Fov fov_of_script(int eye) {
  const xr_test::Fov& fov = xr_test::control().script.fov[static_cast<std::size_t>(eye)];
  return {fov.left, fov.right, fov.down, fov.up};
}

// [px] The projection of `point` by an asymmetric pinhole camera, computed without matrices.
dvec2 pinhole(const EyePose& eye, const Fov& fov, dvec3 point, dvec2 size) {
  const dvec3 in_eye = glm::conjugate(eye.orientation) * (point - eye.position);
  const double x = in_eye.x / -in_eye.z, y = in_eye.y / -in_eye.z;
  return {size.x * (x - std::tan(fov.left)) / (std::tan(fov.right) - std::tan(fov.left)),
          size.y * (std::tan(fov.up) - y) / (std::tan(fov.up) - std::tan(fov.down))};
}

// [px] The centroid of a convex polygon.
dvec2 centroid_of(const std::vector<dvec2>& corners) {
  double area = 0.0;
  dvec2 sum(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const double cross = a.x * b.y - b.x * a.y;
    area += cross;
    sum += cross * (a + b) / 3.0;
  }
  return sum / area;
}

double linear(std::uint8_t stored) {
  const double value = stored / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// [px] The centroid of everything brighter than the background, weighted by pixel coverage.
dvec2 centroid_of(const Image& picture) {
  dvec2 sum(0.0);
  double weight = 0.0;
  const double ground = linear(picture.pixel(0, 0)[0]);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double w = linear(picture.pixel(x, y)[0]) - ground;
      if (w < 0.01) continue;
      sum += w * dvec2(x + 0.5, y + 0.5);
      weight += w;
    }
  }
  return sum / weight;
}

}  // namespace

TEST_CASE("with a scripted head, each eye is drawn from its pose at the frame's display time, within 0.1 px") {
  HeadsetRig rig(4);
  xr_test::control().script.head = turning_head;
  xr_test::control().script.early_error = 0.03;  // [m] position error of the early prediction
  Model model;
  Material black = paint(vec3(0.0f));
  const vec3 ahead(kRoomInCabin.orientation * dvec3(0.0, 0.0, -1.0));
  // A lamp 0.8 m ahead, in front of a dark wall that fills the view.
  const dvec3 middle = kRoomInCabin.position + kRoomInCabin.orientation * dvec3(0.05, 1.02, -0.8);
  const int lamp_node = add_rectangle(model, "Lamp", {0.12f, 0.09f}, add_material(model, lamp(vec3(4.0f))), {});
  const int wall = add_rectangle(model, "Wall", {9.0f, 9.0f}, add_material(model, black), {});
  rig.view->set_model(model);
  FrameScene scene = scene_at_rest(model);
  const glm::mat4 turned = glm::mat4_cast(glm::quat(kRoomInCabin.orientation));
  scene.nodes[static_cast<std::size_t>(lamp_node)].world = glm::translate(glm::mat4(1.0f), vec3(middle)) * turned;
  scene.nodes[static_cast<std::size_t>(wall)].world =
      glm::translate(glm::mat4(1.0f), vec3(middle) + 1.2f * ahead) * turned;
  for (int i = 0; i < 16; ++i) rig.frame(scene);
  double worst = 0.0, other_time = 0.0;
  const auto frames = shown_frames();
  REQUIRE(frames.size() >= 12);
  for (const xr_test::FrameRecord* frame : frames) {
    for (int eye = 0; eye < 2; ++eye) {
      const Image& picture = frame->projection()->views[static_cast<std::size_t>(eye)].picture;
      const auto expected = [&](double seconds) {
        std::vector<dvec2> corners;
        for (const dvec2 corner : {dvec2(-1, -1), dvec2(1, -1), dvec2(1, 1), dvec2(-1, 1)}) {
          const dvec3 point = middle + kRoomInCabin.orientation * dvec3(0.12 * corner.x, 0.09 * corner.y, 0.0);
          corners.push_back(pinhole(eye_at(seconds, eye), fov_of_script(eye), point, {picture.width, picture.height}));
        }
        return centroid_of(corners);
      };
      const dvec2 measured = centroid_of(picture);
      worst = std::max(worst, glm::length(measured - expected(frame->time)));
      other_time = std::max(other_time, glm::length(measured - expected(frame->time - 1.0 / 90.0)));
    }
  }
  MESSAGE("worst " << worst << " px; one period earlier " << other_time << " px");
  CHECK(worst < 0.1);
  CHECK(other_time > 1.0);  // [px] proves that the check above would notice a view drawn for the previous period
}

TEST_CASE("pictures and depths submitted for both eyes equal those of a renderer for a single eye") {
  const Gate gate = shipped_gate("paper");
  StageConfig cabin;
  cabin.gate = gate;
  Stage stage(cabin, GEARSHIFT_ASSETS "/models");
  FrameScene scene = stage.scene();
  // The shadow bounds are inside the view of each eye, so both eyes use the same shadow map.
  scene.shadow_bounds = {{0.22f, 0.0f, -0.40f}, {0.44f, 0.25f, -0.20f}};
  HeadsetRig rig;
  const EyePose seat = camera("driver");
  // The head is at the driver's eyes and looks at the lever. The head moves between the early and the late pose
  // prediction.
  const EyePose in_room = inverse(kRoomInCabin) * seat;
  const auto head = [&](double seconds) {
    return xr_test::Pose{in_room.position + dvec3(0.0, 0.1 * seconds, 0.0),
                         in_room.orientation * glm::angleAxis(0.3 * seconds, dvec3(0, 1, 0))};
  };
  xr_test::control().script.head = head;
  rig.view->set_model(stage.model());
  xr_test::control().script.capture_every = 0;  // while the driver compiles, the runtime would wait for the picture
  for (int i = 0; i < 5; ++i) rig.frame(scene);
  xr_test::control().script.capture_every = 1;
  rig.frame(scene);
  const auto frames = shown_frames();
  REQUIRE(!frames.empty());
  const xr_test::LayerRecord& shown = *frames.back()->projection();

  GpuFixture fixture;
  RenderConfig config;
  config.width = 256;
  config.height = 192;
  config.keep_depth = true;
  config.late_margin = 0.1f;
  Renderer single(fixture.gpu(), config);
  single.set_model(stage.model());
  for (int eye = 0; eye < 2; ++eye) {
    CAPTURE(eye);
    const xr_test::Pose at = head(frames.back()->time);
    const dvec3 aside = at.orientation * dvec3(eye == 0 ? -0.0315 : 0.0315, 0.0, 0.0);
    const EyePose pose = kRoomInCabin * EyePose{at.position + aside, at.orientation};
    const View view = view_from(pose, fov_of_script(eye), kNear);
    single.draw(scene, {&view, 1});
    const xr_test::ViewRecord& submitted = shown.views[static_cast<std::size_t>(eye)];
    const ImageDifference apart = difference(submitted.picture, single.read_eye(0), 3);
    MESSAGE("eye " << eye << ": " << 100.0 * apart.fraction_beyond << " % of the pixels are beyond 3/255, worst "
                   << apart.worst);
    CHECK(apart.fraction_beyond < 0.005);
    const Image depth = read_back(fixture.gpu(), single.depth());
    REQUIRE(submitted.depth.values.size() == 256 * 192);
    std::size_t off = 0;
    for (std::size_t i = 0; i < submitted.depth.values.size(); ++i) {
      float reference = 0.0f;
      std::memcpy(&reference, &depth.rgba[4 * i], 4);
      off += std::abs(submitted.depth.values[i] - reference) > 1e-4f;
    }
    CHECK(off < submitted.depth.values.size() / 200);
  }
  // Negative control: the two eyes see different pictures.
  CHECK(difference(shown.views[0].picture, shown.views[1].picture, 3).fraction_beyond > 0.1);
}

TEST_CASE("the panel hangs in its place and shows all of its picture or the requested part") {
  HeadsetRig rig;
  Model model;
  add_rectangle(model, "Wall", {1.0f, 1.0f}, add_material(model, paint(vec3(0.5f))), {0.0f, 0.0f, -3.0f});
  rig.view->set_model(model);
  HeadsetPanel panel{{{0.1, 1.1, -1.4}, glm::dquat(1, 0, 0, 0)}, {1.2, 0.9}};
  for (int i = 0; i < 5; ++i) rig.frame(scene_at_rest(model), &panel);
  panel.low = {0.05, 0.0};
  panel.high = {0.55, 0.5};
  rig.frame(scene_at_rest(model), &panel);
  const auto frames = shown_frames();
  REQUIRE(frames.size() >= 3);
  const xr_test::LayerRecord& full = *frames[frames.size() - 2]->quad();
  CHECK(full.width == 1.2f);
  const xr_test::ViewRecord& all = full.views[0];
  CHECK(all.rect.width == 400);
  CHECK(all.rect.height == 300);
  const auto pixel = [](const Image& picture, int x, int y) {
    const std::uint8_t* p = picture.pixel(x, y);
    return std::array<int, 4>{p[0], p[1], p[2], p[3]};
  };
  CHECK(pixel(all.picture, 20, 15) == std::array{255, 0, 0, 255});
  // The panel is transparent here, so the cabin is visible.
  CHECK(pixel(all.picture, 60, 15) == std::array{0, 0, 0, 0});
  CHECK(pixel(all.picture, 200, 200) == std::array{0, 0, 0, 0});
  const xr_test::ViewRecord& part = frames.back()->quad()->views[0];
  CHECK(part.rect.x == 20);
  CHECK(part.rect.width == 200);
  CHECK(part.rect.height == 150);
  CHECK(pixel(part.picture, 10, 15) == std::array{255, 0, 0, 255});
  CHECK(pixel(part.picture, 30, 15) == std::array{0, 0, 0, 0});
}

TEST_CASE("the instructor sees the left eye's picture in the area that the panel leaves free, and the panel") {
  XServer server;
  HeadsetRig rig;
  const FrameScene scene = green_wall(rig);
  const ::Window id = server.find("mirror");
  REQUIRE(id != 0);
  Image picture;
  for (int i = 0; i < 60; ++i) {
    rig.frame(scene, nullptr, {{0.25, 0.0}, {1.0, 1.0}});
    picture = server.picture(id);
    if (picture.pixel(250, 150)[1] > 200) break;
  }
  // The panel leaves 300 x 300 of 400 x 300 px free. In that area, the eye's picture of 256 x 192 px is scaled to 300 x
  // 225.
  CHECK(picture.pixel(250, 150)[1] > 200);
  CHECK(picture.pixel(110, 150)[1] > 200);
  CHECK(picture.pixel(90, 150)[1] == 0);   // left of the eye's picture
  CHECK(picture.pixel(250, 20)[1] == 0);   // above the picture
  CHECK(picture.pixel(20, 15)[0] == 255);  // the panel's red square
}

TEST_CASE(
    "while the headset is not worn, the instructor sees the cabin from the given camera, for any pose of the headset") {
  XServer server;
  for (const bool runs : {false, true}) {
    CAPTURE(runs);
    HeadsetRig rig(1, runs);
    xr_test::control().script.timeline = {xr_test::Event{0.0, Kind::hidden, 1e6}};
    xr_test::control().script.head = [](double) {  // the headset lies on a table, facing backwards
      return xr_test::Pose{dvec3(2.0, -0.5, 1.0), glm::angleAxis(std::numbers::pi, dvec3(0, 1, 0))};
    };
    const FrameScene scene = green_wall(rig);
    Image picture;
    for (int i = 0; i < 60; ++i) {
      rig.frame(scene, nullptr, {});
      picture = server.picture(server.find("mirror"));
      if (picture.pixel(200, 150)[1] > 200 && i > 10) break;
    }
    CHECK((rig.view->state() == HeadsetState::idle) == !runs);
    CHECK(shown_frames().empty());
    CHECK(picture.pixel(200, 150)[1] > 200);
  }
}

TEST_CASE(
    "the headset's panel is independent of the window's size; the instructor sees all of it, and the mouse matches") {
  XServer server;
  HeadsetRig rig;
  const FrameScene scene = green_wall(rig);
  const HeadsetPanel panel{{{0.1, 1.1, -1.4}, glm::dquat(1, 0, 0, 0)}, {1.2, 0.9}};
  for (int i = 0; i < 5; ++i) rig.frame(scene, &panel);
  const ::Window id = server.find("mirror");
  const int swapchains = xr_test::control().record.calls["xrCreateSwapchain"];
  // In the second window, the panel's picture of 400 x 300 px becomes 200 x 150 px, with a black margin of 30 px on its
  // left.
  for (const glm::ivec2 size : {glm::ivec2(480, 300), glm::ivec2(260, 150)}) {
    CAPTURE(size.x);
    server.resize(id, size.x, size.y);
    const double scale = size.y / 300.0, aside = 0.5 * (size.x - 400.0 * scale);
    const auto at = [&](double x, double y) { return dvec2(aside, 0.0) + scale * dvec2(x, y); };
    const auto is_red = [&](const Image& picture, dvec2 p) {
      if (picture.width != size.x) return false;
      const std::uint8_t* pixel = picture.pixel(static_cast<int>(p.x), static_cast<int>(p.y));
      return pixel[0] > 200 && pixel[1] < 50;
    };
    const auto shows_all = [&](const Image& picture) {
      return is_red(picture, at(37.0, 27.0)) && !is_red(picture, at(43.0, 15.0)) &&
             !is_red(picture, {aside - 3.0, 15.0});
    };
    Image picture;
    for (int i = 0; i < 60 && !shows_all(picture); ++i) {  // the first frames may still show the previous picture
      rig.frame(scene, &panel);
      picture = server.picture(id);
    }
    CHECK(shows_all(picture));
    CHECK(glm::distance(in_mirrored_panel(at(37.0, 27.0), kPanel, size), dvec2(37.0, 27.0)) < 0.5);
    CHECK(in_mirrored_panel({aside - 3.0, 15.0}, kPanel, size).x < 0.0);
  }
  CHECK(xr_test::control().record.calls["xrCreateSwapchain"] == swapchains);
  CHECK(shown_frames().back()->quad()->views[0].rect.width == kPanel.x);
}

TEST_CASE("a window without a free image costs the headset neither a wait nor a frame") {
  HeadsetRig rig;
  Model model;
  add_rectangle(model, "Wall", {1.0f, 1.0f}, add_material(model, paint(vec3(0.5f))), {0.0f, 0.0f, -3.0f});
  rig.view->set_model(model);
  for (int i = 0; i < 5; ++i) rig.frame(scene_at_rest(model));
  injected_faults.never_free = true;
  injected_faults.waited_ns = 0;
  const std::size_t asked = injected_faults.acquired_with.size(), before = shown_frames().size();
  while (injected_faults.acquired_with.size() < asked + 10) rig.frame(scene_at_rest(model));
  const std::size_t shown = shown_frames().size() - before;
  injected_faults.never_free = false;
  CHECK(shown >= 10);
  CHECK(injected_faults.waited_ns == 0);
  CHECK(rig.view->timing().dropped == 0);
}

TEST_CASE("a picture scale refers to the headset's recommended size, is rounded to even numbers, and limited") {
  for (const auto& [scale, width] : {std::pair{1.0, 256}, {0.5, 128}, {0.33, 84}, {2.0, 300}}) {
    xr_test::Control& xr = xr_test::control();
    xr.start();
    xr.script.recommended_width = 256;
    xr.script.recommended_height = 192;
    xr.script.max_width = 300;
    choose_software_driver();
    gearshift::engine::Window window(200, 150, "scaled");
    UiContext ui;
    HeadsetViewConfig config;
    config.scale = scale;
    config.samples = 1;
    config.panel = {32, 16};
    CHECK(open_view(config, window, ui)->eye_size().x == width);
  }
}

namespace {

std::size_t entries(const char* folder) {
  const auto all = std::filesystem::directory_iterator(folder);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

// [MiB] The anonymous memory that the process uses.
double resident() {
  malloc_trim(0);
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("RssAnon:", 0) == 0) return std::stod(line.substr(8)) / 1024.0;
  return 0.0;
}

}  // namespace

// Creates everything that the program creates again after it lost the headset: OpenXR runtime, device, renderer,
// session and the instructor's window. Repeats this 20 times, or GEARSHIFT_XR_RESTARTS times. The software driver leaks
// a little memory per device, less with each repetition, so only the memory of the second half is checked.
TEST_CASE("a headset view that is created repeatedly leaks no file, no thread, and little memory") {
  choose_software_driver();
  unsetenv("GEARSHIFT_VALIDATION");  // the validation layer keeps data about every object, which would look like a leak
  const char* asked = std::getenv("GEARSHIFT_XR_RESTARTS");
  const int restarts = asked != nullptr ? std::atoi(asked) : 20;
  gearshift::engine::Window window(200, 150, "again");
  UiContext ui;
  xr_test::Control& xr = xr_test::control();
  std::size_t files = 0, threads = 0;
  double half_way = 0.0;
  for (int i = 0; i < restarts; ++i) {
    xr.start();
    xr.script.recommended_width = xr.script.recommended_height = 32;
    HeadsetViewConfig config;
    config.samples = 1;
    {
      const std::unique_ptr<HeadsetView> view = open_view(config, window, ui);
      for (int k = 0; k < 5; ++k) {
        window.poll();
        ui.begin({200.0f, 150.0f, 0.01f, 1.0f});
        ui.end();
        (void)view->begin();
        view->draw({}, {}, nullptr, {});
      }
      CHECK(!shown_frames().empty());
    }
    CHECK(HeadsetThread::wait_for_ended(std::chrono::seconds(20)));
    CHECK(xr.record.live_handles == 0);
    if (i == 0) files = entries("/proc/self/fd"), threads = entries("/proc/self/task");
    if (i == restarts / 2) half_way = resident();
  }
  const double more = resident() - half_way;
  MESSAGE(restarts << " views, the second half of them: " << more << " MiB more");
  CHECK(entries("/proc/self/fd") <= files);
  for (int i = 0; i < 100 && entries("/proc/self/task") > threads;
       ++i)  // the kernel removes a joined thread a little later
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(entries("/proc/self/task") <= threads);
  CHECK(more < 1.0 * restarts / 2);
}
