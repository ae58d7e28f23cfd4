// Compares stereo pictures of the real cabin, drawn in one pass or in two, with the picture of each eye alone. The near
// plane of the camera intersects the steering wheel.
#include <array>

#include <doctest/doctest.h>

#include "tests/picture/cabin_rig.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

constexpr double kCutsTheWheel = 0.42;  // [m] near plane, beyond the wheel's rim at 0.40 m

// Box [m] that each eye sees completely. The shadow map is fitted to the visible part of this box, so one eye and two
// eyes use the same map.
constexpr ShadowBounds kAboutTheGate{{0.22f, 0.0f, -0.40f}, {0.44f, 0.25f, -0.20f}};

RenderConfig small(int eyes, int samples, EyePasses passes = EyePasses::automatic) {
  RenderConfig config;
  config.width = 320;
  config.height = 240;
  config.eyes = eyes;
  config.samples = samples;
  config.eye_passes = passes;
  return config;
}

std::array<View, 2> both_views(const RenderConfig& config) {
  const Fov centre = symmetric_fov(1.2, static_cast<double>(config.width) / config.height);
  const StereoEyes eyes = stereo_eyes(camera("driver"), centre, 0.063, 2.0);
  return {view_from(eyes.pose[0], eyes.fov[0], kCutsTheWheel), view_from(eyes.pose[1], eyes.fov[1], kCutsTheWheel)};
}

void check_against_single_views(int samples, EyePasses passes) {
  const RenderConfig two = small(2, samples, passes);
  CabinRig stereo(two);
  const std::array<View, 2> views = both_views(two);
  const StageInput input = resting_in(stereo.gate, 3);
  stereo.stage.place(input);
  FrameScene scene = stereo.stage.scene();
  scene.shadow_bounds = kAboutTheGate;
  stereo.renderer.draw(scene, views);

  CabinRig mono(small(1, samples));
  for (int eye = 0; eye < 2; ++eye) {
    mono.renderer.draw(scene, {&views[static_cast<std::size_t>(eye)], 1});
    const Image reference = mono.renderer.read_eye(0);
    const ImageDifference error = difference(stereo.renderer.read_eye(eye), reference, 1);
    CHECK_MESSAGE(error.fraction_beyond == 0.0, "eye ", eye, ", worst ", error.worst, "/255");
  }
  const ImageDifference eyes = difference(stereo.renderer.read_eye(0), stereo.renderer.read_eye(1), 3);
  CHECK(eyes.fraction_beyond > 0.05);  // the left and right pictures differ
}

}  // namespace

TEST_CASE("each eye drawn in one pass equals its single view, with geometry cut at the near plane") {
  check_against_single_views(1, EyePasses::layered);
  check_against_single_views(4, EyePasses::layered);
}

TEST_CASE("each eye drawn in a pass of its own equals its single view") {
  check_against_single_views(1, EyePasses::one_by_one);
  check_against_single_views(4, EyePasses::one_by_one);
}
