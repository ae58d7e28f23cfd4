#include "app/cabin/stage/dial_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "app/cabin/stage/instruments.h"
#include "app/cabin/stage/mesh_parts.h"
#include "haptics/files/parameter.h"

namespace gearshift::cabin {
namespace {

// Layout of the dial in the upper left corner of the texture atlas, as drawn by assets/models/craft/prints.py.
constexpr int kDial = 672;                                 // [px] side of the square dial
constexpr double kUnit = kDial / 512.0;                    // [px] unit of the radii below
constexpr double kNumbersFrom = 132.0;                     // inner radius of the numbers
constexpr double kTicksFrom = 200.0;                       // inner radius of ticks and arc
constexpr double kArcFrom = 227.0, kEnd = 240.0;           // inner and outer radius of the red arc
constexpr double kRim = 242.0;                             // radius beyond which there is only the rim
constexpr double kTickStep = 250.0, kNumberStep = 1000.0;  // [1/min] between ticks, between numbers
constexpr double kGround = 30.0;                           // 0 to 255: a darker pixel is background

using Colour = std::array<double, 3>;  // sRGB, 0 to 255

// Colours of the red print in one of the dial's two textures.
struct Print {
  Colour red, arc;
};
constexpr std::array<Print, 2> kPrints{{{{235.0, 50.0, 40.0}, {205.0, 28.0, 24.0}},   // base colour
                                        {{188.0, 40.0, 32.0}, {150.0, 12.0, 8.0}}}};  // emissive
constexpr Colour kWhite{236.0, 238.0, 240.0};

glm::dvec2 off_middle(int x, int y) {  // [px] from the dial's middle, positive right and up
  return {x + 0.5 - 0.5 * kDial, 0.5 * kDial - (y + 0.5)};
}

// [1/min] The value that a needle pointing at this position would show; outside the scale, the value is below 0 or
// above kTachTop.
double value_at(glm::dvec2 off) {
  const double zero = needle_angle(0.0, kTachTop), top = needle_angle(kTachTop, kTachTop);
  return kTachTop * (zero + std::atan2(off.x, off.y)) / (zero - top);
}

// Coverage, 0 to 1, of a pixel whose centre is `inside` [px] from an edge; `inside` is negative outside the edge.
double soft(double inside) {
  return std::clamp(0.5 + inside, 0.0, 1.0);
}

class RedLinePainter {
 public:
  // before: the dial as in the model file. picture: the texture to paint. from [1/min]: start of the red range.
  RedLinePainter(const engine::Image& before, engine::Image& picture, const Print& print, double from)
      : before_(before), picture_(picture), print_(print), from_(from) {}

  void draw() {
    for (int y = 0; y < kDial; ++y) {
      for (int x = 0; x < kDial; ++x) {
        const glm::dvec2 off = off_middle(x, y);
        const double radius = glm::length(off) / kUnit;
        if (radius > kNumbersFrom && radius < kRim) paint(x, y, radius, off);
      }
    }
  }

 private:
  // Paints one pixel. Ticks are always copied from the left half of the original dial, which has no red arc; the right
  // half can use them too, because the scale is symmetric.
  void paint(int x, int y, double radius, glm::dvec2 off) {
    const bool is_tick = radius > kTicksFrom;
    const std::uint8_t* printed = before_.pixel(is_tick ? std::min(x, kDial - 1 - x) : x, y);
    std::uint8_t* out = picture_.pixel(x, y);
    std::copy(printed, printed + 3, out);
    if (printed[0] <= kGround && radius < kArcFrom - 1.0) return;  // background, i.e. most of the dial
    const double value = value_at(off);
    Colour colour{static_cast<double>(printed[0]), static_cast<double>(printed[1]), static_cast<double>(printed[2])};
    const double ink = std::clamp((colour[0] - kGround) / (print_.red[0] - kGround), 0.0, 1.0);
    if (ink > 0.0) colour = inked(colour[0], is_red(value, is_tick ? kTickStep : kNumberStep));
    const double covered = arc_at(radius, value) * (1.0 - ink);
    for (std::size_t i = 0; i < 3; ++i) {
      const double mixed = colour[i] + covered * (print_.arc[i] - colour[i]);
      out[i] = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0, 255.0)));
    }
  }

  // True if the tick or number nearest to the value is red. Its nominal value decides, so all its pixels get the same
  // colour.
  bool is_red(double value, double step) const { return step * std::round(value / step) >= from_; }

  Colour inked(double strength, bool red) const {
    Colour ink = red ? print_.red : kWhite;
    const double factor = strength / ink[0];
    for (double& channel : ink) channel *= factor;
    return ink;
  }

  double arc_at(double radius, double value) const {
    if (from_ >= kTachTop) return 0.0;
    const double sweep = needle_angle(0.0, kTachTop) - needle_angle(kTachTop, kTachTop);
    const double px_per_rpm = sweep / kTachTop * radius * kUnit;
    const double along = std::min(value - from_, kTachTop - value) * px_per_rpm;
    const double across = std::min(radius - kArcFrom, kEnd - radius) * kUnit;
    return soft(along) * soft(across);
  }

  const engine::Image& before_;
  engine::Image& picture_;
  const Print& print_;
  double from_;
};

int texture_of(const engine::TextureUse& use) {
  if (use.texture == engine::kNone) throw std::runtime_error("the cabin's material 'Prints' has no texture");
  return use.texture;
}

engine::Image dial_field(const engine::Model& model, int texture) {
  const engine::Image& picture = model.textures[static_cast<std::size_t>(texture)].pixels;
  if (picture.width < kDial || picture.height < kDial)
    throw std::runtime_error("the texture of the cabin's material 'Prints' is too small for a dial");
  return engine::crop(picture, 0, 0, kDial, kDial);
}

}  // namespace

DialPrint::DialPrint(const engine::Model& model) {
  const engine::Material& prints = model.materials[static_cast<std::size_t>(required_material(model, "Prints"))];
  texture_ = {texture_of(prints.base_colour_map), texture_of(prints.emissive_map)};
  for (std::size_t i = 0; i < 2; ++i) original_[i] = dial_field(model, texture_[i]);
}

bool DialPrint::print(engine::Model& model, double red_line) {
  if (!(red_line > 0.0) || red_line == red_line_) return false;
  red_line_ = red_line;
  const double from = red_line / haptics::kTurnPerMinute;
  for (std::size_t i = 0; i < 2; ++i) {
    engine::Image& picture = model.textures[static_cast<std::size_t>(texture_[i])].pixels;
    RedLinePainter(original_[i], picture, kPrints[i], from).draw();
  }
  return true;
}

}  // namespace gearshift::cabin
