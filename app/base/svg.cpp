#include "app/base/svg.h"

#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "app/base/html.h"

namespace gearshift::base {
namespace {

std::string stroke(const Pen& pen) {
  return fmt::format(
      "stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-dasharray=\"{}\" stroke-linecap=\"round\" "
      "stroke-linejoin=\"round\"",
      pen.colour, pen.width, pen.dash);
}

std::string box(const Rect& r) {
  return fmt::format("x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\"", r.x, r.y, r.width, r.height);
}

std::string point_list(const std::vector<glm::dvec2>& points) {
  std::string list;
  for (const glm::dvec2 p : points) fmt::format_to(std::back_inserter(list), "{:.3f},{:.3f} ", p.x, p.y);
  return list;
}

}  // namespace

Svg::Svg(const Rect& page, double pixels) {
  body_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" "
      "viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\" font-family=\"DejaVu Sans, Arial, sans-serif\">\n",
      page.width * pixels, page.height * pixels, page.x, page.y, page.width, page.height);
  rect(page, "#ffffff");
}

void Svg::stripes(std::string_view name, std::string_view ground, std::string_view stripe) {
  body_ += fmt::format(
      "<defs><pattern id=\"{}\" width=\"1.4\" height=\"1.4\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect width=\"1.4\" height=\"1.4\" fill=\"{}\"/>"
      "<rect width=\"0.5\" height=\"1.4\" fill=\"{}\"/></pattern></defs>\n",
      name, ground, stripe);
}

void Svg::text(glm::dvec2 at, const Type& type, std::string_view label) {
  body_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" fill=\"{}\" text-anchor=\"{}\" "
      "font-weight=\"{}\">{}</text>\n",
      at.x, at.y, type.size, type.colour, type.anchor, type.bold ? "bold" : "normal", html_text(label));
}

void Svg::line(glm::dvec2 from, glm::dvec2 to, const Pen& pen) {
  body_ += fmt::format("<line x1=\"{:.3f}\" y1=\"{:.3f}\" x2=\"{:.3f}\" y2=\"{:.3f}\" {}/>\n", from.x, from.y, to.x,
                       to.y, stroke(pen));
}

void Svg::rect(const Rect& r, std::string_view fill, double corner) {
  body_ += fmt::format("<rect {} rx=\"{:.2f}\" fill=\"{}\"/>\n", box(r), corner, fill);
}

void Svg::frame(const Rect& r, std::string_view fill, const Pen& pen) {
  body_ += fmt::format("<rect {} fill=\"{}\" {}/>\n", box(r), fill, stroke(pen));
}

void Svg::dot(glm::dvec2 center, double radius, std::string_view fill, std::string_view tip) {
  body_ +=
      fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.2f}\" fill=\"{}\"", center.x, center.y, radius, fill);
  body_ += tip.empty() ? "/>\n" : fmt::format("><title>{}</title></circle>\n", html_text(tip));
}

void Svg::ring(glm::dvec2 center, double radius, const Pen& pen) {
  body_ += fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.2f}\" fill=\"none\" {}/>\n", center.x, center.y,
                       radius, stroke(pen));
}

void Svg::polygon(const std::vector<glm::dvec2>& points, std::string_view fill) {
  body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", point_list(points), fill);
}

void Svg::polyline(const std::vector<glm::dvec2>& points, const Pen& pen) {
  body_ += fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", point_list(points), stroke(pen));
}

// The size is also given as a style, because a page's style for pictures would apply to this inner one, too.
void Svg::begin_clip(const Rect& r) {
  body_ +=
      fmt::format("<svg {0} style=\"width:{3:.3f}px;height:{4:.3f}px\" viewBox=\"{1:.3f} {2:.3f} {3:.3f} {4:.3f}\">\n",
                  box(r), r.x, r.y, r.width, r.height);
}

void Svg::end_clip() {
  body_ += "</svg>\n";
}

std::string Svg::finish() && {
  return std::move(body_) + "</svg>\n";
}

}  // namespace gearshift::base
