#include "app/ui/panel/plot_area.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "app/ui/panel/palette.h"

namespace gearshift::ui {
namespace {

// Returns a grid spacing that divides the range into at most `max` intervals.
double grid_step(PlotRange range, double max) {
  return nice_above((range.high - range.low) / max, 1e-6);
}

}  // namespace

double nice_above(double value, double min) {
  double decade = min;
  while (decade * 10.0 < value) decade *= 10.0;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    if (decade * factor >= value) return decade * factor;
  }
  return value;  // only reached if value is not finite
}

PlotArea::PlotArea(ImVec2 size, PlotRange x, PlotRange y, const char* x_unit, bool numbers_outside)
    : list_(ImGui::GetWindowDrawList()),
      low_(ImGui::GetCursorScreenPos()),
      x_(x),
      y_(y),
      x_unit_(x_unit),
      numbers_outside_(numbers_outside) {
  const float below = x_unit == nullptr ? 0.0f : engine::ui_font_size(engine::UiFont::small) + 2.0f;
  ImGui::Dummy(size);
  high_ = {low_.x + size.x, low_.y + size.y - below};
  list_->AddRectFilled(low_, high_, ink::kWell, 3.0f);
  draw_grid();
  list_->PushClipRect(low_, high_, true);
}

// Draws the numbers last, so that no curve hides them.
PlotArea::~PlotArea() {
  list_->PopClipRect();
  draw_y_numbers();
  if (x_unit_ != nullptr) draw_x_numbers();
}

ImVec2 PlotArea::at(double x, double y) const {
  const double across = (x - x_.low) / (x_.high - x_.low), up = (y - y_.low) / (y_.high - y_.low);
  return {low_.x + static_cast<float>(across) * (high_.x - low_.x),
          high_.y - static_cast<float>(up) * (high_.y - low_.y)};
}

template <class Visit>
void PlotArea::each_line(PlotRange range, float pixels_per_line, float pixels, Visit visit) {
  const double step = grid_step(range, std::max(2.0, static_cast<double>(pixels / pixels_per_line)));
  const auto first = static_cast<int>(std::ceil(range.low / step - 1e-6));
  const auto last = static_cast<int>(std::floor(range.high / step + 1e-6));
  for (int i = first; i <= last; ++i) visit(step * i);
}

template <class Visit>
void PlotArea::each_y(Visit visit) const {
  each_line(y_, 1.5f * engine::ui_em(), high_.y - low_.y, visit);
}

template <class Visit>
void PlotArea::each_x(Visit visit) const {
  each_line(x_, 4.0f * engine::ui_em(), high_.x - low_.x, visit);
}

void PlotArea::draw_grid() {
  const auto shade = [](double value) { return engine::with_alpha(ink::kLine, value == 0.0 ? 1.0f : 0.5f); };
  each_y([&](double y) { list_->AddLine({low_.x, at(0.0, y).y}, {high_.x, at(0.0, y).y}, shade(y)); });
  each_x([&](double x) { list_->AddLine({at(x, 0.0).x, low_.y}, {at(x, 0.0).x, high_.y}, shade(x)); });
}

// Draws the lowest and the highest number first, then the numbers in between that do not overlap those already drawn.
void PlotArea::draw_y_numbers() {
  std::optional<double> lowest, highest;
  each_y([&](double y) {
    if (!lowest) lowest = y;
    highest = y;
  });
  if (!lowest) return;
  const float min = engine::ui_font_size(engine::UiFont::small) + 1.0f, above = y_number_top(*highest);
  float below = y_number_top(*lowest);
  draw_y_number(*lowest);
  if (below - above < min) return;
  draw_y_number(*highest);
  each_y([&](double y) {
    const float top = y_number_top(y);
    if (below - top < min || top - above < min) return;
    below = top;
    draw_y_number(y);
  });
}

float PlotArea::y_number_top(double y) const {
  const float height = engine::ui_font_size(engine::UiFont::small);
  return std::clamp(at(0.0, y).y - 0.5f * height, low_.y, std::max(low_.y, high_.y - height));
}

void PlotArea::draw_y_number(double y) {
  ImFont* font = engine::ui_font(engine::UiFont::small);
  const std::string text = fmt::format("{:g}", y);
  const ImVec2 size = font->CalcTextSizeA(engine::ui_font_size(font), 1e9f, 0.0f, text.c_str());
  const float inside = low_.x + 0.2f * engine::ui_em(), outside = low_.x - 0.3f * engine::ui_em() - size.x;
  const ImVec2 place(numbers_outside_ ? outside : inside, y_number_top(y));
  if (!numbers_outside_)
    list_->AddRectFilled(place, {place.x + size.x, place.y + size.y}, engine::with_alpha(ink::kWell, 0.7f), 2.0f);
  list_->AddText(font, engine::ui_font_size(font), place, ink::kSoft, text.c_str());
}

void PlotArea::draw_x_numbers() {
  ImFont* font = engine::ui_font(engine::UiFont::small);
  each_x([&](double x) {
    const std::string text = x == 0.0 ? fmt::format("0 {}", x_unit_) : fmt::format("{:g}", x);
    const float width = font->CalcTextSizeA(engine::ui_font_size(font), 1e9f, 0.0f, text.c_str()).x;
    const float place = std::clamp(at(x, 0.0).x - 0.5f * width, low_.x, high_.x - width);
    list_->AddText(font, engine::ui_font_size(font), {place, high_.y + 1.0f}, ink::kSoft, text.c_str());
  });
}

// Draws two points per column, minimum and maximum, in their likely order in time: the minimum first if the column's
// last value is not below its first value.
void PlotArea::strip(const Strip& strip, double factor, ImU32 colour) {
  static thread_local std::vector<ImVec2> line;
  const float width = (high_.x - low_.x) / static_cast<float>(strip.columns());
  const float thick = std::max(1.0f, 0.1f * engine::ui_em());
  const auto flush = [&] {
    if (line.size() > 1) list_->AddPolyline(line.data(), static_cast<int>(line.size()), colour, 0, thick);
    line.clear();
  };
  for (int i = 0; i < strip.columns(); ++i) {
    const StripColumn& column = strip.column(i);
    if (column.count == 0) continue;
    const float x = low_.x + (static_cast<float>(i) + 0.5f) * width;
    const bool rising = column.last >= column.first;
    const float begin = at(0.0, factor * (rising ? column.min : column.max)).y;
    const float end = at(0.0, factor * (rising ? column.max : column.min)).y;
    line.push_back({x, begin});
    if (std::abs(end - begin) > 0.5f) line.push_back({x, end});
  }
  flush();
}

}  // namespace gearshift::ui
