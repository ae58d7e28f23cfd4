#include "app/stage/dial_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "app/stage/instruments.h"
#include "app/stage/pieces.h"

namespace gearshift {
namespace {

// The dial on the print atlas, as assets/models/craft/prints.py draws it: in its upper left corner, as wide as a dial.
constexpr int kDial = 672;                                 // [px]
constexpr double kUnit = kDial / 512.0;                    // [px] of the lengths below
constexpr double kNumbersFrom = 132.0;                     // what stands further in is no number
constexpr double kTicksFrom = 200.0;                       // from here out: ticks and arc
constexpr double kArcFrom = 227.0, kEnd = 240.0;           // the arc
constexpr double kRim = 242.0;                             // nothing is printed further out but the rim
constexpr double kTickStep = 250.0, kNumberStep = 1000.0;  // [1/min]
constexpr double kGround = 30.0;                           // of 255: what is darker is no ink

using Colour = std::array<double, 3>;  // of 255, sRGB

// One of the two pictures: its inks.
struct Print {
  Colour red, arc;
};
constexpr std::array<Print, 2> kPrints{{{{235.0, 50.0, 40.0}, {205.0, 28.0, 24.0}},   // reflects
                                        {{188.0, 40.0, 32.0}, {150.0, 12.0, 8.0}}}};  // glows
constexpr Colour kWhite{236.0, 238.0, 240.0};

glm::dvec2 off_middle(int x, int y) {  // [px] right, up
  return {x + 0.5 - 0.5 * kDial, 0.5 * kDial - (y + 0.5)};
}

// [1/min] that a needle shows there; beyond the scale below 0 or above its top.
double value_at(glm::dvec2 off) {
  const double zero = needle_angle(0.0, kTachTop), top = needle_angle(kTachTop, kTachTop);
  return kTachTop * (zero + std::atan2(off.x, off.y)) / (zero - top);
}

// 0 to 1: how far a pixel lies within an edge that it is `inside` [px] of.
double soft(double inside) {
  return std::clamp(0.5 + inside, 0.0, 1.0);
}

class RedLine {
 public:
  // before: the dial's field as the file has it. from [1/min]
  RedLine(const Image& before, Image& picture, const Print& print, double from)
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
  // The scale is symmetric: its left half has every tick of the right one, and no arc over them.
  void paint(int x, int y, double radius, glm::dvec2 off) {
    const bool is_tick = radius > kTicksFrom;
    const std::uint8_t* printed = before_.pixel(is_tick ? std::min(x, kDial - 1 - x) : x, y);
    std::uint8_t* out = picture_.pixel(x, y);
    std::copy(printed, printed + 3, out);
    if (printed[0] <= kGround && radius < kArcFrom - 1.0) return;  // most of the dial
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

  // A tick, or a number, is of one colour.
  bool is_red(double value, double step) const { return step * std::round(value / step) >= from_; }

  Colour inked(double strength, bool red) const {
    Colour ink = red ? print_.red : kWhite;
    const double share = strength / ink[0];
    for (double& channel : ink) channel *= share;
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

  const Image& before_;
  Image& picture_;
  const Print& print_;
  double from_;
};

int texture_of(const TextureUse& use) {
  if (use.texture == kNone) throw std::runtime_error("the cabin's material Prints has no picture to print on");
  return use.texture;
}

Image dial_field(const Model& model, int texture) {
  const Image& picture = model.textures[static_cast<std::size_t>(texture)].pixels;
  if (picture.width < kDial || picture.height < kDial)
    throw std::runtime_error("the cabin's picture of its prints is too small for a dial");
  return crop(picture, 0, 0, kDial, kDial);
}

}  // namespace

DialPrint::DialPrint(const Model& model) {
  const Material& prints = model.materials[static_cast<std::size_t>(needed_material(model, "Prints"))];
  texture_ = {texture_of(prints.base_colour_map), texture_of(prints.emissive_map)};
  for (std::size_t i = 0; i < 2; ++i) as_filed_[i] = dial_field(model, texture_[i]);
}

bool DialPrint::print(Model& model, double red_line) {
  if (!(red_line > 0.0) || red_line == red_line_) return false;
  red_line_ = red_line;
  const double from = red_line * 30.0 / std::numbers::pi;
  for (std::size_t i = 0; i < 2; ++i) {
    Image& picture = model.textures[static_cast<std::size_t>(texture_[i])].pixels;
    RedLine(as_filed_[i], picture, kPrints[i], from).draw();
  }
  return true;
}

}  // namespace gearshift
