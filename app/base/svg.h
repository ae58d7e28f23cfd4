// A small SVG writer with the shapes that this program's drawings need. Lengths are in units of the view box.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift::base {

struct Rect {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct Pen {
  const char* colour = "#000000";
  double width = 0.3;
  const char* dash = "none";  // lengths of dash and gap, e.g. "2 1"
};

struct Type {  // text style
  double size = 3.0;
  const char* colour = "#000000";
  const char* anchor = "start";  // start, middle, end
  bool bold = false;
};

class Svg {
 public:
  // `page`: the view box. `pixels`: number of pixels per unit of the view box.
  Svg(const Rect& page, double pixels);

  // Defines a fill of diagonal stripes; use it with fill = "url(#name)".
  void stripes(std::string_view name, std::string_view ground, std::string_view stripe);

  void text(glm::dvec2 at, const Type& type, std::string_view label);  // escapes the label
  void line(glm::dvec2 from, glm::dvec2 to, const Pen& pen);
  void rect(const Rect& r, std::string_view fill, double corner = 0.0);
  void frame(const Rect& r, std::string_view fill, const Pen& pen);
  void dot(glm::dvec2 center, double radius, std::string_view fill, std::string_view tip = {});  // tip: tooltip
  void ring(glm::dvec2 center, double radius, const Pen& pen);
  void polygon(const std::vector<glm::dvec2>& points, std::string_view fill);
  // Shapes drawn until end_clip() are cut off outside the rectangle.
  void begin_clip(const Rect& r);
  void end_clip();
  void polyline(const std::vector<glm::dvec2>& points, const Pen& pen);

  std::string finish() &&;

 private:
  std::string body_;
};

}  // namespace gearshift::base
