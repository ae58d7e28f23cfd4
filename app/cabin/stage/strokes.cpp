#include "app/cabin/stage/strokes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/gate/aisle.h"

namespace gearshift::cabin {
namespace {

constexpr double kSharp = 0.7;  // cosine of the largest turn that is mitred; sharper turns get two rounded ends
constexpr int kCapSteps = 6;
constexpr double kGap = 0.24;  // between two characters of a text, relative to its height

// Adds an arc from angle `from` to angle `to` [deg], counter-clockwise if from < to.
void arc(Line& line, glm::dvec2 centre, glm::dvec2 radii, double from, double to) {
  const int steps = std::max(3, static_cast<int>(std::ceil(std::abs(to - from) / 15.0)));
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::numbers::pi / 180.0 * (from + (to - from) * i / steps);
    line.push_back(centre + radii * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
}

std::vector<Line> six() {
  Line line;
  arc(line, {0.56, 0.32}, {0.54, 0.68}, 96.0, 180.0);
  arc(line, {0.30, 0.30}, {0.28, 0.30}, 180.0, 540.0);
  return {line};
}

constexpr double kLetter = 0.68;  // height of a small letter, relative to a digit

// Adds a stem and `arches` arches of a small letter: n, m, h.
std::vector<Line> arched(double stem, int arches, double width) {
  std::vector<Line> lines{{{0.06, 0.0}, {0.06, stem}}};
  for (int i = 0; i < arches; ++i) {
    const double left = 0.06 + i * width;
    Line line;
    arc(line, {left + 0.5 * width, kLetter - 0.26}, {0.5 * width, 0.26}, 180.0, 0.0);
    line.emplace_back(left + width, 0.0);
    lines.push_back(line);
  }
  return lines;
}

// The glyph of a capital letter that is no other glyph.
std::vector<Line> capital(char letter) {
  Line a, b;
  switch (letter) {
    case 'A':
      return {{{0.02, 0.0}, {0.30, 1.0}, {0.58, 0.0}}, {{0.13, 0.36}, {0.47, 0.36}}};
    case 'B':
      arc(a, {0.30, 0.76}, {0.24, 0.24}, 90.0, -90.0);
      arc(b, {0.30, 0.26}, {0.28, 0.26}, 90.0, -90.0);
      a.insert(a.begin(), {{0.06, 0.0}, {0.06, 1.0}});
      a.emplace_back(0.06, 0.52);
      b.emplace_back(0.06, 0.0);
      return {a, b};
    case 'C':
      arc(a, {0.32, 0.50}, {0.28, 0.50}, 50.0, 310.0);
      return {a};
    case 'D':
      a = {{0.06, 0.0}, {0.06, 1.0}};
      arc(a, {0.20, 0.50}, {0.38, 0.50}, 90.0, -90.0);
      a.emplace_back(0.06, 0.0);
      return {a};
    case 'E':
      return {{{0.54, 1.0}, {0.08, 1.0}, {0.08, 0.0}, {0.56, 0.0}}, {{0.08, 0.52}, {0.46, 0.52}}};
    case 'F':
      return {{{0.54, 1.0}, {0.08, 1.0}, {0.08, 0.0}}, {{0.08, 0.52}, {0.46, 0.52}}};
    case 'G':
      arc(a, {0.32, 0.50}, {0.28, 0.50}, 50.0, 330.0);
      a.insert(a.end(), {{0.57, 0.46}, {0.34, 0.46}});
      return {a};
    case 'H':
      return {{{0.06, 0.0}, {0.06, 1.0}}, {{0.54, 0.0}, {0.54, 1.0}}, {{0.06, 0.52}, {0.54, 0.52}}};
    case 'I':
      return {{{0.30, 0.0}, {0.30, 1.0}}};
    case 'J':
      a = {{0.50, 1.0}};
      arc(a, {0.27, 0.25}, {0.23, 0.25}, 0.0, -180.0);
      return {a};
    case 'K':
      return {{{0.06, 0.0}, {0.06, 1.0}}, {{0.54, 1.0}, {0.06, 0.40}}, {{0.22, 0.60}, {0.58, 0.0}}};
    case 'L':
      return {{{0.08, 1.0}, {0.08, 0.0}, {0.54, 0.0}}};
    case 'M':
      return {{{0.02, 0.0}, {0.02, 1.0}, {0.30, 0.35}, {0.58, 1.0}, {0.58, 0.0}}};
    case 'O':
      arc(a, {0.30, 0.50}, {0.29, 0.50}, 90.0, 450.0);
      return {a};
    case 'P':
      a = {{0.06, 0.0}, {0.06, 1.0}};
      arc(a, {0.30, 0.74}, {0.26, 0.26}, 90.0, -90.0);
      a.emplace_back(0.06, 0.48);
      return {a};
    case 'Q':
      arc(a, {0.30, 0.50}, {0.29, 0.50}, 90.0, 450.0);
      return {a, {{0.36, 0.24}, {0.58, -0.04}}};
    case 'S':
      arc(a, {0.30, 0.755}, {0.25, 0.245}, 40.0, 270.0);
      arc(a, {0.30, 0.255}, {0.27, 0.255}, 90.0, -150.0);
      return {a};
    case 'T':
      return {{{0.02, 1.0}, {0.58, 1.0}}, {{0.30, 1.0}, {0.30, 0.0}}};
    case 'U':
      a = {{0.06, 1.0}};
      arc(a, {0.30, 0.26}, {0.24, 0.26}, 180.0, 360.0);
      a.emplace_back(0.54, 1.0);
      return {a};
    case 'V':
      return {{{0.02, 1.0}, {0.30, 0.0}, {0.58, 1.0}}};
    case 'W':
      return {{{0.0, 1.0}, {0.15, 0.0}, {0.30, 0.65}, {0.45, 0.0}, {0.60, 1.0}}};
    case 'X':
      return {{{0.04, 0.0}, {0.56, 1.0}}, {{0.04, 1.0}, {0.56, 0.0}}};
    case 'Y':
      return {{{0.02, 1.0}, {0.30, 0.48}, {0.58, 1.0}}, {{0.30, 0.48}, {0.30, 0.0}}};
    case 'Z':
      return {{{0.04, 1.0}, {0.56, 1.0}, {0.04, 0.0}, {0.56, 0.0}}};
    default:
      return {{{0.0, 0.0}, {0.6, 0.0}, {0.6, 1.0}, {0.0, 1.0}, {0.0, 0.0}}};
  }
}

// The glyph of a character, in a box that is 0.6 wide (m: 0.9) and 1 high. An unknown one is a box.
std::vector<Line> glyph(char character) {
  Line a, b;
  switch (character) {
    case 'R':
      a = {{0.06, 0.0}, {0.06, 1.0}, {0.30, 1.0}};
      arc(a, {0.32, 0.74}, {0.24, 0.26}, 90.0, -90.0);
      a.emplace_back(0.06, 0.48);
      return {a, {{0.30, 0.48}, {0.58, 0.0}}};
    case '+':
      return {{{0.04, 0.5}, {0.56, 0.5}}, {{0.30, 0.24}, {0.30, 0.76}}};
    case '-':
      return {{{0.04, 0.5}, {0.56, 0.5}}};
    case '/':
      return {{{0.10, -0.06}, {0.50, 1.06}}};
    case ' ':
      return {};
    case 'N':
      return {{{0.04, 0.0}, {0.04, 1.0}, {0.56, 0.0}, {0.56, 1.0}}};
    case '0':
      arc(a, {0.30, 0.50}, {0.27, 0.50}, 90.0, 450.0);
      return {a};
    case '1':
      return {{{0.14, 0.76}, {0.38, 1.0}, {0.38, 0.0}}};
    case '2':
      arc(a, {0.30, 0.71}, {0.27, 0.29}, 165.0, -32.0);
      a.insert(a.end(), {{0.03, 0.0}, {0.58, 0.0}});
      return {a};
    case '3':
      arc(a, {0.28, 0.755}, {0.25, 0.245}, 150.0, -90.0);
      arc(b, {0.28, 0.255}, {0.29, 0.255}, 90.0, -150.0);
      return {a, b};
    case '4':
      return {{{0.44, 0.0}, {0.44, 1.0}, {0.0, 0.28}, {0.60, 0.28}}};
    case '5':
      a = {{0.54, 1.0}, {0.11, 1.0}, {0.07, 0.54}};
      arc(a, {0.28, 0.32}, {0.30, 0.32}, 135.0, -150.0);
      return {a};
    case '6':
      return six();
    case '7':
      return {{{0.03, 1.0}, {0.57, 1.0}, {0.20, 0.0}}};
    case '8':
      arc(a, {0.30, 0.755}, {0.24, 0.245}, -90.0, 270.0);
      arc(b, {0.30, 0.255}, {0.28, 0.255}, 90.0, 450.0);
      return {a, b};
    case '9': {
      std::vector<Line> turned = six();
      for (Line& line : turned) {
        for (glm::dvec2& p : line) p = glm::dvec2(0.6, 1.0) - p;
      }
      return turned;
    }
    case 'h':
      return arched(1.0, 1, 0.44);
    case 'i':
      return {{{0.30, 0.0}, {0.30, kLetter}}, {{0.30, 0.93}, {0.30, 0.94}}};
    case 'k':
      return {{{0.06, 0.0}, {0.06, 1.0}}, {{0.50, kLetter}, {0.08, 0.26}}, {{0.24, 0.42}, {0.54, 0.0}}};
    case 'm':
      return arched(kLetter, 2, 0.36);
    case 'n':
      return arched(kLetter, 1, 0.44);
    case 'p':
      arc(a, {0.29, 0.5 * kLetter}, {0.23, 0.5 * kLetter}, 180.0, -180.0);
      return {{{0.06, -0.28}, {0.06, kLetter}}, a};
    case 'x':
      return {{{0.08, 0.0}, {0.52, kLetter}}, {{0.08, kLetter}, {0.52, 0.0}}};
    default:
      break;
  }
  if (character < 'a' || character > 'z') return capital(character);
  std::vector<Line> small = glyph(static_cast<char>(character - 'a' + 'A'));
  for (Line& line : small)
    for (glm::dvec2& p : line) p.y *= kLetter;
  return small;
}

double width_of(char character) {
  if (character == ' ') return 0.3;
  return character == 'm' ? 0.9 : 0.6;
}

char label_of(int gear) {
  if (gear == haptics::kReverseGear) return 'R';
  if (gear == haptics::kNeutralGear) return 'N';
  if (gear == haptics::kNextGear) return '+';
  if (gear == haptics::kPreviousGear) return '-';
  return gear >= 1 && gear <= haptics::kMaxGear ? static_cast<char>('0' + gear) : '?';
}

glm::dvec2 left_of(glm::dvec2 direction) {
  return {-direction.y, direction.x};
}

// Adds a half disc at the end of a line.
void cap(std::vector<glm::dvec2>& corners, glm::dvec2 end, glm::dvec2 outward, double half) {
  const auto rim = [&](int i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / kCapSteps - 0.5);
    return end + half * (std::cos(angle) * outward + std::sin(angle) * left_of(outward));
  };
  for (int i = 0; i < kCapSteps; ++i) corners.insert(corners.end(), {end, rim(i), rim(i + 1)});
}

// Adds a line that has no sharp corners, with mitred joints.
void ribbon(std::vector<glm::dvec2>& corners, const Line& line, double half) {
  std::vector<glm::dvec2> side(line.size());  // vectors from the line to its left edge
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::dvec2 in = glm::normalize(i > 0 ? line[i] - line[i - 1] : line[1] - line[0]);
    const glm::dvec2 out = glm::normalize(i + 1 < line.size() ? line[i + 1] - line[i] : line[i] - line[i - 1]);
    side[i] = half / (1.0 + glm::dot(in, out)) * left_of(in + out);
  }
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec2 a = line[i] + side[i], b = line[i] - side[i];
    const glm::dvec2 c = line[i + 1] - side[i + 1], d = line[i + 1] + side[i + 1];
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  cap(corners, line.front(), glm::normalize(line.front() - line[1]), half);
  cap(corners, line.back(), glm::normalize(line.back() - line[line.size() - 2]), half);
}

double srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

void draw(const Stroke& stroke, int side, std::vector<glm::vec3>& picture) {
  glm::dvec2 low = stroke.line.front(), high = low;
  for (const glm::dvec2 p : stroke.line) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double pixel = 1.0 / side, reach = 0.5 * stroke.width + pixel;
  const auto clamped = [&](double value) { return std::clamp(static_cast<int>(value * side), 0, side - 1); };
  for (int row = clamped(1.0 - high.y - reach); row <= clamped(1.0 - low.y + reach); ++row) {
    for (int column = clamped(low.x - reach); column <= clamped(high.x + reach); ++column) {
      const glm::dvec2 p{(column + 0.5) * pixel, 1.0 - (row + 0.5) * pixel};
      glm::vec3& ground =
          picture[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) + static_cast<std::size_t>(column)];
      ground = glm::mix(ground, stroke.colour, static_cast<float>(stroke_coverage(stroke, p, pixel)));
    }
  }
}

}  // namespace

double stroke_coverage(const Stroke& stroke, glm::dvec2 p, double pixel) noexcept {
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < stroke.line.size(); ++i) {
    const glm::dvec2 along = stroke.line[i + 1] - stroke.line[i], off = p - stroke.line[i];
    const double t = std::clamp(glm::dot(off, along) / std::max(1e-12, glm::dot(along, along)), 0.0, 1.0);
    nearest = std::min(nearest, glm::length(off - t * along));
  }
  return std::clamp(0.5 + (0.5 * stroke.width - nearest) / pixel, 0.0, 1.0);
}

double text_length(std::string_view text) noexcept {
  double length = kGap * (static_cast<double>(text.size()) - 1.0);
  for (const char character : text) length += width_of(character);
  return length;
}

std::vector<Stroke> text_strokes(std::string_view text, glm::dvec2 centre, double height, double width,
                                 glm::vec3 colour) {
  std::vector<Stroke> strokes;
  double left = -0.5 * text_length(text);
  for (const char character : text) {
    for (Line& line : glyph(character)) {
      for (glm::dvec2& p : line) p = centre + height * (p + glm::dvec2(left, -0.5));
      strokes.push_back({std::move(line), width, colour});
    }
    left += width_of(character) + kGap;
  }
  return strokes;
}

std::vector<Stroke> gear_label(int gear, glm::dvec2 centre, double height, double width, glm::vec3 colour) {
  const char label = label_of(gear);
  return text_strokes({&label, 1}, centre, height, width, colour);
}

// Returns the position round the place at which the label lies farthest from all aisles, but not farther than `gap`;
// among equal ones, one near the place and near the gate's middle, so that the plate stays small.
glm::dvec2 label_place(const haptics::Gate& gate, const haptics::Slot& place, glm::dvec2 size, double gap) {
  constexpr int kDirections = 16, kDistances = 5;
  constexpr double kStep = 0.003;  // [m] between two distances
  double half_width = 0.0;
  for (int i = 0; i < gate.aisle_count; ++i)
    if ((place.aisles >> i & 1u) != 0)
      half_width = std::max(half_width, gate.aisle[static_cast<std::size_t>(i)].half_width);
  glm::dvec2 best = place.at;
  double best_room = -1e9, best_cost = 1e9;
  for (int i = 0; i < kDirections * kDistances; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % kDirections) / kDirections;
    const glm::dvec2 out{std::cos(angle), std::sin(angle)};
    const double reach = 0.5 * (std::abs(out.x) * size.x + std::abs(out.y) * size.y);  // of the label, along `out`
    const glm::dvec2 centre = place.at + (half_width + gap + reach + kStep * (i / kDirections)) * out;
    double room = gap;
    for (const haptics::Aisle& aisle : haptics::aisles(gate))
      for (const double x : {-0.5, 0.0, 0.5})
        for (const double y : {-0.5, 0.0, 0.5})
          room = std::min(room, haptics::distance_to(aisle, centre + glm::dvec2(x, y) * size) - aisle.half_width);
    const double cost = glm::distance(centre, place.at) + 0.3 * glm::length(centre);
    if (room < best_room - 1e-9 || (room < best_room + 1e-9 && cost >= best_cost)) continue;
    best = centre;
    best_room = room;
    best_cost = cost;
  }
  return best;
}

// Smallest distance [m] between two places.
double place_spacing(const haptics::Gate& gate) {
  double spacing = 1.0;
  for (const haptics::Slot& a : haptics::slots(gate))
    for (const haptics::Slot& b : haptics::slots(gate))
      if (&a != &b) spacing = std::min(spacing, glm::distance(a.at, b.at));
  return spacing;
}

// Shrinks the pattern until it fits into a round cap.
void fit_into_cap(std::vector<Stroke>& strokes) {
  constexpr double kReach = 0.48;
  double reach = kReach;
  for (const Stroke& stroke : strokes)
    for (const glm::dvec2 p : stroke.line)
      reach = std::max(reach, glm::distance(p, glm::dvec2(0.5)) + 0.5 * stroke.width);
  for (Stroke& stroke : strokes) {
    stroke.width *= kReach / reach;
    for (glm::dvec2& p : stroke.line) p = glm::dvec2(0.5) + kReach / reach * (p - 0.5);
  }
}

// A gate of aisles, to scale.
std::vector<Stroke> aisle_pattern(const haptics::Gate& gate, glm::vec3 colour, glm::vec3 reverse_colour) {
  constexpr double kSquare = 0.72, kLine = 0.026, kMaxSign = 0.11;
  glm::dvec2 low{1e9}, high{-1e9};
  for (const haptics::Aisle& aisle : haptics::aisles(gate)) {
    low = glm::min(low, glm::min(aisle.from, aisle.to));
    high = glm::max(high, glm::max(aisle.from, aisle.to));
  }
  const double scale = kSquare / std::max(high.x - low.x, high.y - low.y);
  const double longest = 0.6 * scale * place_spacing(gate);  // of a label
  const auto at = [&](glm::dvec2 p) { return glm::dvec2(0.5) + scale * (p - 0.5 * (low + high)); };
  std::vector<Stroke> strokes;
  for (const haptics::Aisle& aisle : haptics::aisles(gate))
    strokes.push_back({{at(aisle.from), at(aisle.to)}, kLine, colour});
  for (const haptics::Slot& place : haptics::slots(gate)) {
    const std::string label = haptics::gear_label(gate, place.gear);
    const double height = std::min(kMaxSign, longest / text_length(label));
    const glm::vec3 ink = place.gear == haptics::kReverseGear ? reverse_colour : colour;
    const glm::dvec2 size = glm::dvec2(text_length(label), 1.0) * (height / scale);
    const glm::dvec2 centre = at(label_place(gate, place, size, 0.004));
    for (Stroke& stroke : text_strokes(label, centre, height, 0.16 * height, ink)) strokes.push_back(std::move(stroke));
  }
  fit_into_cap(strokes);
  return strokes;
}

std::vector<Stroke> shift_pattern(const haptics::Gate& gate, glm::vec3 colour, glm::vec3 reverse_colour) {
  if (haptics::is_mechanism(gate)) return aisle_pattern(gate, colour, reverse_colour);
  constexpr double kSignHeight = 0.15, kLine = 0.030;
  constexpr glm::dvec2 kHalf{0.25, 0.19};  // half size of the pattern without the labels
  const double left = haptics::column_of(gate, 0).center,
               right = haptics::column_of(gate, gate.column_count - 1).center;
  double deepest = gate.half_aisle;
  for (const haptics::Slot& slot : haptics::slots(gate)) deepest = std::max(deepest, slot.end);
  const double narrow = right > left ? 2.0 * kHalf.x / (right - left) : 1.0;
  const glm::dvec2 scale{narrow, kHalf.y / deepest};
  const auto at = [&](double x, double y) { return glm::dvec2(0.5) + scale * glm::dvec2(x - 0.5 * (left + right), y); };

  std::vector<Stroke> strokes{{{at(left, 0.0), at(right, 0.0)}, kLine, colour}};
  for (const haptics::Slot& slot : haptics::slots(gate)) {
    const double x = haptics::column_of(gate, slot.column).center, side = static_cast<int>(slot.side);
    const glm::vec3 ink = slot.gear == haptics::kReverseGear ? reverse_colour : colour;
    const glm::dvec2 end = at(x, side * deepest);
    strokes.push_back({{at(x, 0.0), end}, kLine, colour});
    const glm::dvec2 sign = end + glm::dvec2(0.0, side * (0.5 * kSignHeight + 1.5 * kLine));
    for (Stroke& stroke : gear_label(slot.gear, sign, kSignHeight, 0.8 * kLine, ink))
      strokes.push_back(std::move(stroke));
  }
  return strokes;
}

std::vector<glm::dvec2> stroke_triangles(const Stroke& stroke) {
  std::vector<glm::dvec2> corners;
  Line smooth{stroke.line.front()};
  for (std::size_t i = 1; i < stroke.line.size(); ++i) {
    if (stroke.line[i] == smooth.back()) continue;
    const std::size_t n = smooth.size();
    if (n > 1 && glm::dot(glm::normalize(stroke.line[i] - smooth[n - 1]),
                          glm::normalize(smooth[n - 1] - smooth[n - 2])) < kSharp) {
      ribbon(corners, smooth, 0.5 * stroke.width);
      smooth = {smooth.back()};
    }
    smooth.push_back(stroke.line[i]);
  }
  if (smooth.size() > 1) ribbon(corners, smooth, 0.5 * stroke.width);
  return corners;
}

engine::Image draw_strokes(const std::vector<Stroke>& strokes, int side, glm::vec3 ground) {
  std::vector<glm::vec3> picture(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), ground);
  for (const Stroke& stroke : strokes) draw(stroke, side, picture);
  engine::Image image{side, side, {}};
  image.rgba.reserve(4 * picture.size());
  for (const glm::vec3& colour : picture) {
    for (int i = 0; i < 3; ++i) {
      const double value = srgb(std::clamp(static_cast<double>(colour[i]), 0.0, 1.0));
      image.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0 * value)));
    }
    image.rgba.push_back(255);
  }
  return image;
}

}  // namespace gearshift::cabin
