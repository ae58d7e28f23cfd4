// Compares the lever in its gate with a reviewed reference picture, and with pictures that must not match it.
//
// GEARSHIFT_WRITE_GOLDEN=1 rewrites the reference: review it before you commit it.
#include <cstdlib>
#include <filesystem>

#include <doctest/doctest.h>

#include "engine/image/image.h"
#include "tests/picture/cabin_rig.h"
#include "tests/support/pictures.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

// Design goal: at most 0.5 % of the pixels differ by more than 3/255 in any channel.
constexpr int kTolerance = 3;
constexpr double kMaxFractionBeyond = 0.005;

const std::filesystem::path kGolden = GEARSHIFT_TEST_DATA "/golden/lever_in_third.png";

RenderConfig config_of_golden() {
  RenderConfig config;
  config.width = 640;
  config.height = 360;
  config.samples = 4;
  return config;
}

// The part of the picture with the knob, the rod, the plate and some of the console.
Image around_lever(const Image& picture) {
  return crop(picture, 200, 60, 240, 240);
}

Image lever_picture(CabinRig& rig, const StageInput& input) {
  return around_lever(rig.picture(input, cabin_view(camera("lever"), rig.renderer.config())));
}

bool matches_golden(const Image& picture) {
  const ImageDifference error = difference(picture, read_png(kGolden), kTolerance);
  MESSAGE("PSNR ", error.psnr, " dB, ", 100.0 * error.fraction_beyond, " % of the pixels beyond ", kTolerance, "/255");
  return error.fraction_beyond <= kMaxFractionBeyond;
}

}  // namespace

TEST_CASE("the lever in third matches the reference; moved by 2 mm, or without normal maps, it does not") {
  RenderConfig config = config_of_golden();
  StageInput third;
  {
    CabinRig rig(config);
    third = resting_in(rig.gate, 3);
    const Image picture = lever_picture(rig, third);
    if (std::getenv("GEARSHIFT_WRITE_GOLDEN")) write_png(kGolden, picture);
    CHECK(matches_golden(picture));

    StageInput moved = third;
    moved.lever.proxy.x += 0.002;
    CHECK_FALSE(matches_golden(lever_picture(rig, moved)));
    CHECK(matches_golden(lever_picture(rig, third)));
  }
  config.normal_maps = false;
  CabinRig smooth(config);
  CHECK_FALSE(matches_golden(lever_picture(smooth, third)));
}
