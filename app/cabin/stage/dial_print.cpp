#include "app/cabin/stage/dial_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/cabin/stage/mesh_parts.h"
#include "app/cabin/stage/strokes.h"
#include "haptics/files/parameter.h"

namespace gearshift::cabin {
namespace {

// The dials are the left two fields of the texture atlas, as drawn by assets/models/craft/prints.py. Sizes are in its
// unit.
constexpr int kDial = 672;                                          // [px] side of a square dial
constexpr double kUnit = kDial / 512.0;                             // [px]
constexpr double kRim = 242.0;                                      // radius beyond which the model's rim stays
constexpr double kFace = 248.0;                                     // radius of the face
constexpr double kArcFrom = 227.0, kEnd = 240.0;                    // inner and outer radius of the red arc
constexpr double kTickEnd = 238.0, kMajor = 206.0, kMinor = 222.0;  // outer end, inner ends
constexpr double kMajorWidth = 7.0, kMinorWidth = 3.0;
constexpr double kNumbers = 166.0;                                             // radius of the numbers' centres
constexpr double kTachHeight = 41.0, kSpeedHeight = 23.0, kUnitHeight = 18.0;  // of digits
constexpr double kStrokeWidth = 0.19;                                          // relative to the height
constexpr double kUnitBelow = 92.0;                                            // from the centre to the unit's name

using Colour = glm::dvec3;  // sRGB, 0 to 255

// An ink's colours in base-colour and emissive texture.
using Ink = std::array<Colour, 2>;
constexpr Colour kWhite{236.0, 238.0, 240.0}, kRed{235.0, 50.0, 40.0}, kGrey{150.0, 158.0, 166.0};
constexpr Ink kArc{{{205.0, 28.0, 24.0}, {150.0, 12.0, 8.0}}};
constexpr double kGlow = 0.8;  // emission, relative to the base colour

Ink ink(const Colour& colour) {
  return {colour, kGlow * colour};
}

// Coverage, 0 to 1, of a pixel whose centre is `inside` [px] from an edge; `inside` is negative outside the edge.
double soft(double inside) {
  return std::clamp(0.5 + inside, 0.0, 1.0);
}

class DialPainter {
 public:
  // left: [px] of the dial in both pictures.
  DialPainter(std::array<engine::Image*, 2> pictures, int left, const DialScale& scale)
      : pictures_(pictures), left_(left), scale_(scale) {
    clear();
  }

  void red_from(double value) {
    for (int y = 0; y < kDial; ++y) {
      for (int x = 0; x < kDial; ++x) mix(x, y, kArc, arc_at(off_middle(x, y), value));
    }
  }

  void number(double value, const std::string& text, double height, const Colour& colour) {
    write(text, point(value, kNumbers), height, colour);
  }

  void unit(const std::string& text) { write(text, {0.0, -kUnitBelow}, kUnitHeight, kGrey); }

  // The ends of a stroke are round, so its line is shorter by half its width.
  void tick(double value, bool major, const Colour& colour) {
    const double width = major ? kMajorWidth : kMinorWidth, from = major ? kMajor : kMinor;
    draw({{point(value, from + 0.5 * width), point(value, kTickEnd - 0.5 * width)}, width}, ink(colour));
  }

 private:
  // In the dial's unit from its middle, positive right and up.
  static glm::dvec2 off_middle(int x, int y) {
    return glm::dvec2{x + 0.5 - 0.5 * kDial, 0.5 * kDial - (y + 0.5)} / kUnit;
  }

  glm::dvec2 point(double value, double radius) const {
    const double angle = needle_angle(value, scale_.top);
    return radius * glm::dvec2(-std::sin(angle), std::cos(angle));
  }

  // The face as the model's file has it: rings that get darker outwards, and no light.
  void clear() {
    for (int y = 0; y < kDial; ++y) {
      for (int x = 0; x < kDial; ++x) {
        const double radius = glm::length(off_middle(x, y));
        if (radius >= kRim) continue;
        const double grey = std::floor(9.0 + 13.0 * (1.0 - std::max(1.0, std::ceil(60.0 * radius / kFace)) / 60.0));
        mix(x, y, {Colour(grey, grey, grey + 2.0), Colour(0.0)}, 1.0);
      }
    }
  }

  void mix(int x, int y, const Ink& ink, double covered) {
    if (covered <= 0.0) return;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      std::uint8_t* out = pictures_[i]->pixel(left_ + x, y);
      for (int c = 0; c < 3; ++c)
        out[c] = static_cast<std::uint8_t>(std::lround(out[c] + covered * (ink[i][c] - out[c])));
    }
  }

  double arc_at(glm::dvec2 off, double from) const {
    const double radius = glm::length(off);
    if (radius < kArcFrom - 1.0 || radius > kEnd + 1.0) return 0.0;
    const double zero = needle_angle(0.0, scale_.top), top = needle_angle(scale_.top, scale_.top);
    const double value = scale_.top * (zero + std::atan2(off.x, off.y)) / (zero - top);
    const double px_per_value = (zero - top) / scale_.top * radius * kUnit;
    const double along = std::min(value - from, scale_.top - value) * px_per_value;
    return soft(along) * soft(std::min(radius - kArcFrom, kEnd - radius) * kUnit);
  }

  void write(const std::string& text, glm::dvec2 centre, double height, const Colour& colour) {
    for (const Stroke& stroke : text_strokes(text, centre, height, kStrokeWidth * height, glm::vec3(1.0f)))
      draw(stroke, ink(colour));
  }

  void draw(const Stroke& stroke, const Ink& ink) {
    glm::dvec2 low = stroke.line.front(), high = low;
    for (const glm::dvec2 p : stroke.line) low = glm::min(low, p), high = glm::max(high, p);
    const double reach = 0.5 * stroke.width + 1.0;
    const auto pixel = [](double off) { return std::clamp(static_cast<int>(kUnit * off + 0.5 * kDial), 0, kDial - 1); };
    for (int y = pixel(-high.y - reach); y <= pixel(reach - low.y); ++y) {
      for (int x = pixel(low.x - reach); x <= pixel(high.x + reach); ++x)
        mix(x, y, ink, stroke_coverage(stroke, off_middle(x, y), 1.0 / kUnit));
    }
  }

  std::array<engine::Image*, 2> pictures_;
  int left_;
  DialScale scale_;
};

void print_tach(std::array<engine::Image*, 2> pictures, const DialScale& scale, double red_line) {
  DialPainter dial(pictures, 0, scale);
  const double red = red_line / haptics::kTurnPerMinute;
  dial.red_from(red);
  const double unit = scale.step < 1000.0 ? 100.0 : 1000.0;
  const int intervals = static_cast<int>(std::lround(scale.top / scale.step)) * scale.ticks;
  for (int i = 0; i <= intervals; ++i) {
    const double value = i * scale.step / scale.ticks;
    const Colour& colour = value >= red ? kRed : kWhite;
    const bool major = i % scale.ticks == 0;
    dial.tick(value, major, colour);
    if (major) dial.number(value, fmt::format("{:.0f}", value / unit), kTachHeight, colour);
  }
  dial.unit(fmt::format("1/min x{:.0f}", unit));
}

void print_speed(std::array<engine::Image*, 2> pictures, const DialScale& scale, vehicle::SpeedUnit unit) {
  DialPainter dial(pictures, kDial, scale);
  const int intervals = static_cast<int>(std::lround(scale.top / scale.step)) * scale.ticks;
  for (int i = 0; i <= intervals; ++i) {
    const double value = i * scale.step / scale.ticks;
    const bool major = i % scale.ticks == 0;
    dial.tick(value, major, kWhite);
    if (major) dial.number(value, fmt::format("{:.0f}", value), kSpeedHeight, kWhite);
  }
  dial.unit(to_string(unit));
}

int texture_of(const engine::Model& model, const engine::TextureUse& use) {
  if (use.texture == engine::kNone) throw std::runtime_error("the cabin's material 'Prints' has no texture");
  const engine::Image& picture = model.textures[static_cast<std::size_t>(use.texture)].pixels;
  if (picture.width < 2 * kDial || picture.height < kDial)
    throw std::runtime_error("the texture of the cabin's material 'Prints' is too small for two dials");
  return use.texture;
}

}  // namespace

DialPrint::DialPrint(const engine::Model& model) {
  const engine::Material& prints = model.materials[static_cast<std::size_t>(required_material(model, "Prints"))];
  texture_ = {texture_of(model, prints.base_colour_map), texture_of(model, prints.emissive_map)};
}

bool DialPrint::print(engine::Model& model, const vehicle::VehicleState& car) {
  if (!(car.red_line > 0.0)) return false;
  const DialScale tach = tach_scale(car.red_line), speed = speed_scale(car.top_speed, car.speed_unit);
  if (tach == tach_ && car.red_line == red_line_ && speed == speed_ && car.speed_unit == unit_) return false;
  tach_ = tach;
  red_line_ = car.red_line;
  speed_ = speed;
  unit_ = car.speed_unit;
  std::array<engine::Image*, 2> pictures{};
  for (std::size_t i = 0; i < 2; ++i) pictures[i] = &model.textures[static_cast<std::size_t>(texture_[i])].pixels;
  print_tach(pictures, tach, car.red_line);
  print_speed(pictures, speed, car.speed_unit);
  return true;
}

}  // namespace gearshift::cabin
