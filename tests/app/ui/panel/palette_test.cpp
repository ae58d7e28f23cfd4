// The colour table against two standards: texts have the contrast of WCAG 2.1 (success criterion 1.4.3), and colours with
// different meanings in one display stay apart with each kind of colour blindness.
//
// This work is based on:
// W3C. Web Content Accessibility Guidelines 2.1, definitions of relative luminance and contrast ratio. 2018
// Gustavo Machado, Manuel Oliveira, Leandro Fernandes. A Physiologically-based Model for Simulation of Color Vision
// Deficiency. 2009 (the matrices for severity 1)
// CIE 15: Colorimetry (L*a*b* for illuminant D65, colour difference of 1976)
#include "app/ui/panel/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

namespace palette = gearshift::ui::ink;

namespace {

using Rgb = std::array<double, 3>;

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

Rgb linear_of(ImU32 colour) {
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(colour);
  return {linear(static_cast<double>(c.x)), linear(static_cast<double>(c.y)), linear(static_cast<double>(c.z))};
}

double contrast(ImU32 text, ImU32 ground) {
  const auto luminance = [](ImU32 colour) {
    const Rgb c = linear_of(colour);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  const double a = luminance(text), b = luminance(ground);
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

using Vision = std::array<Rgb, 3>;
constexpr Vision kUsual = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Vision kProtanopia = {
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
constexpr Vision kDeuteranopia = {
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
constexpr Vision kTritanopia = {
    {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};

Rgb lab(ImU32 colour, const Vision& vision) {
  const Rgb c = linear_of(colour);
  Rgb s{};
  for (std::size_t i = 0; i < 3; ++i)
    s[i] = std::clamp(vision[i][0] * c[0] + vision[i][1] * c[1] + vision[i][2] * c[2], 0.0, 1.0);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f((0.4124 * s[0] + 0.3576 * s[1] + 0.1805 * s[2]) / 0.95047),
               y = f(0.2126 * s[0] + 0.7152 * s[1] + 0.0722 * s[2]),
               z = f((0.0193 * s[0] + 0.1192 * s[1] + 0.9505 * s[2]) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

// The smallest difference of the two colours that any of the four kinds of vision sees; 2.3 is just noticeable.
double least_difference(ImU32 a, ImU32 b) {
  double least = HUGE_VAL;
  for (const Vision& vision : {kUsual, kProtanopia, kDeuteranopia, kTritanopia}) {
    const Rgb p = lab(a, vision), q = lab(b, vision);
    least = std::min(least, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
  }
  return least;
}

}  // namespace

TEST_CASE("the formulas give known values: black on white 21, WCAG's grey 4.54, red and green apart only for some") {
  CHECK(contrast(IM_COL32(0, 0, 0, 255), IM_COL32(255, 255, 255, 255)) == doctest::Approx(21.0));
  CHECK(contrast(IM_COL32(118, 118, 118, 255), IM_COL32(255, 255, 255, 255)) == doctest::Approx(4.54).epsilon(0.002));
  const ImU32 old_blue = IM_COL32(104, 178, 240, 255), old_violet = IM_COL32(176, 148, 230, 255);
  CHECK(least_difference(old_blue, old_violet) < 5.0);  // a pair that the panel had
}

TEST_CASE("every text has a contrast of at least 4.5 to what it is written on") {
  for (const ImU32 ground : {palette::kPanel, palette::kWell, palette::kRaised})
    for (const ImU32 text :
         {palette::kText, palette::kSoft, palette::kAccent, palette::kGood, palette::kWarn, palette::kBad,
          palette::kHand, palette::kActuator, palette::kJoystick, palette::kEngine, palette::kShaft, palette::kIdeal}) {
      CAPTURE(ground);
      CAPTURE(text);
      CHECK(contrast(text, ground) >= 4.5);
    }
  for (const ImU32 button :
       {palette::kPrimary, palette::kAccentDeep, palette::kBadDeep, palette::kRaised, palette::kRaisedHover})
    CHECK(contrast(palette::kText, button) >= 4.5);
}

TEST_CASE("colours with different meanings in one display differ for everybody") {
  const std::vector<ImU32> kDisplays[] = {
      {palette::kGood, palette::kWarn, palette::kBad, palette::kText},  // lamps, verdicts, messages
      {palette::kHand, palette::kActuator, palette::kJoystick},         // forces
      {palette::kLever, palette::kProxy},                               // the gate's marks
      {palette::kEngine, palette::kShaft},                              // speeds of a shift
      {palette::kIdeal, palette::kDriven, palette::kAccent},            // paths in the gate
      {palette::kAccent, palette::kBad, palette::kGood},                // pedals
      {palette::kRaised, palette::kAccentDeep, palette::kBadDeep},      // switches
      {palette::kAccent, palette::kBiteMark}};                          // bite zone
  for (const std::vector<ImU32>& colours : kDisplays)
    for (std::size_t i = 0; i < colours.size(); ++i)
      for (std::size_t j = i + 1; j < colours.size(); ++j) {
        CAPTURE(colours[i]);
        CAPTURE(colours[j]);
        CHECK(least_difference(colours[i], colours[j]) >= 18.0);
      }
}
