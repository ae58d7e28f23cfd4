// Under a mirrored sun, the right-hand-drive cabin must be the mirror image of the left-hand-drive cabin, except for
// lettering. This detects lighting from the wrong side, also through normal maps, and wrong culling.
#include <algorithm>
#include <array>
#include <string>

#include <doctest/doctest.h>

#include "engine/light/enclosure.h"
#include "tests/picture/cabin_rig.h"
#include "tests/support/pictures.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

constexpr int kWidth = 640, kHeight = 360;  // [px]

RenderConfig config_of_sides(bool normal_maps = true) {
  RenderConfig config;
  config.width = kWidth;
  config.height = kHeight;
  config.samples = 4;
  config.normal_maps = normal_maps;
  return config;
}

struct Region {
  const char* camera;
  int x, y, width, height;  // [px] in the picture of the left-hand-drive cabin
};
constexpr Region kRegions[] = {{"driver", 480, 190, 160, 130},  // passenger's door, edge of the seat
                               {"ahead", 500, 0, 140, 200},     // pillar and roof, and land next to them
                               {"gate", 280, 40, 360, 320},     // hand and seat, whose leather has normal maps
                               {"cluster", 150, 110, 340, 160}};
constexpr std::size_t kDials = 3;
constexpr Region kSeat[] = {kRegions[2]};

// Renders the views of the cameras named in `regions`. If `mirror_sun` is true, the sun's direction is mirrored left to
// right.
template <std::size_t kCameras>
std::array<Image, kCameras> render_side(DriveSide side, const Region (&regions)[kCameras], bool mirror_sun,
                                        bool normal_maps = true) {
  StageConfig cabin;
  cabin.gate = shipped_gate("paper");
  cabin.drive = side;
  CabinRig rig(config_of_sides(normal_maps), cabin);
  rig.stage.place(resting_in(rig.gate, kNeutralGear));
  FrameScene scene = rig.stage.scene();
  if (mirror_sun) scene.sun.towards.x = -scene.sun.towards.x;
  const Radiance open = day_sky(scene.sun.towards);
  rig.renderer.set_environment(open, indoor_radiance(car_cabin(), open, scene.sun.towards, scene.sun.irradiance));
  std::array<Image, kCameras> pictures;
  for (std::size_t i = 0; i < kCameras; ++i) {
    const char* name = regions[i].camera;
    const View view = cabin_view(camera(name, side), rig.renderer.config(), camera_field(name));
    rig.renderer.draw(scene, {&view, 1});
    pictures[i] = rig.renderer.read_eye(0);
  }
  return pictures;
}

Image in_mirror(Image image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width / 2; ++x)
      std::swap_ranges(image.pixel(x, y), image.pixel(x, y) + 4, image.pixel(image.width - 1 - x, y));
  }
  return image;
}

Image part(const Image& image, const Region& r) {
  return crop(image, r.x, r.y, r.width, r.height);
}

// Fraction of pixels that may differ. Edges differ, because the sample positions of a pixel are not mirror-symmetric.
constexpr double kEdges = 0.04;

ImageDifference mirror_difference(const Region& region, const Image& left, const Image& right) {
  const ImageDifference mirror_error = difference(part(left, region), part(in_mirror(right), region), 3);
  MESSAGE(std::string(region.camera) << ": " << 100.0 * mirror_error.fraction_beyond << " % beyond 3/255");
  return mirror_error;
}

}  // namespace

TEST_CASE("body and hand of the right-hand-drive cabin are a mirror image; the dials are not") {
  const auto left = render_side(DriveSide::left, kRegions, false),
             right = render_side(DriveSide::right, kRegions, true);
  for (std::size_t i = 0; i < std::size(kRegions); ++i)
    CHECK((mirror_difference(kRegions[i], left[i], right[i]).fraction_beyond < kEdges) == (i != kDials));
}

TEST_CASE("with an unmirrored sun, or without normal maps, the seat on the right is not a mirror image") {
  const auto [left] = render_side(DriveSide::left, kSeat, false);
  const auto [same_sun] = render_side(DriveSide::right, kSeat, false);
  const auto [smooth] = render_side(DriveSide::right, kSeat, true, false);
  CHECK(mirror_difference(kSeat[0], left, same_sun).fraction_beyond > 4.0 * kEdges);
  CHECK(mirror_difference(kSeat[0], left, smooth).fraction_beyond > 4.0 * kEdges);
}
