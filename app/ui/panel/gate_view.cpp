#include "app/ui/panel/gate_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/ui/panel/palette.h"
#include "haptics/gate/aisle.h"

namespace gearshift::ui {
namespace {

constexpr double kRim = 0.011;           // [m] width of the plate beyond the outermost walls, for the gear labels
constexpr double kScaleLength = 0.020;   // [m] length that the scale shows
constexpr double kArrowFraction = 0.35;  // [1] arrow length at maximum force, divided by the view's shorter side

// Maps gate coordinates [m] to pixels; forward is up.
struct GateFrame {
  ImVec2 middle;      // [px] place where `center` is drawn
  glm::dvec2 center;  // [m]
  double px_per_m = 1.0;

  ImVec2 at(glm::dvec2 p) const {
    return {middle.x + static_cast<float>((p.x - center.x) * px_per_m),
            middle.y - static_cast<float>((p.y - center.y) * px_per_m)};
  }
  float length(double metres) const { return static_cast<float>(metres * px_per_m); }
};

struct Extent {
  glm::dvec2 min, max;
};

Extent extent_of(const haptics::Gate& gate, const haptics::GateDescription& description) {
  if (haptics::is_mechanism(gate)) {
    Extent box{description.aisles.front().min, description.aisles.front().max};
    for (const haptics::AisleInfo& aisle : description.aisles)
      box = {glm::min(box.min, aisle.min), glm::max(box.max, aisle.max)};
    return {box.min - kRim, box.max + kRim};
  }
  Extent box{{gate.select_min, -gate.half_aisle}, {gate.select_max, gate.half_aisle}};
  for (const haptics::Column& column : haptics::columns(gate)) {
    box.min.y = std::min(box.min.y, column.back);
    box.max.y = std::max(box.max.y, column.forward);
  }
  return {box.min - kRim, box.max + kRim};
}

GateFrame fit(const Extent& box, ImVec2 low, ImVec2 size) {
  const glm::dvec2 span = box.max - box.min;
  const double scale = std::min(static_cast<double>(size.x) / span.x, static_cast<double>(size.y) / span.y);
  return {{low.x + 0.5f * size.x, low.y + 0.5f * size.y}, 0.5 * (box.min + box.max), scale};
}

struct Canvas {
  ImDrawList& list;
  GateFrame frame;
  float em;
};

void draw_free_space(const Canvas& c, const haptics::GateDescription& gate) {
  for (const haptics::AisleInfo& aisle : gate.aisles) {
    if (!aisle.outline.empty()) {
      std::vector<ImVec2> outline;
      for (const glm::dvec2 p : aisle.outline) outline.push_back(c.frame.at(p));
      c.list.AddConvexPolyFilled(outline.data(), static_cast<int>(outline.size()), ink::kFree);
      continue;
    }
    c.list.AddRectFilled(c.frame.at({aisle.min.x, aisle.max.y}), c.frame.at({aisle.max.x, aisle.min.y}), ink::kFree);
  }
  for (const haptics::WallInfo& wall : gate.walls) {
    if (wall.role != haptics::WallRole::chamfer) continue;
    // A chamfer adds a triangle of free space at the corner of a slot.
    c.list.AddTriangleFilled(c.frame.at(wall.from), c.frame.at(wall.to), c.frame.at({wall.to.x, wall.from.y}),
                             ink::kFree);
  }
}

void draw_buffers(const Canvas& c, const haptics::Gate& gate) {
  for (const haptics::Buffer& b : haptics::buffers(gate)) {
    c.list.AddRectFilled(c.frame.at({std::min(b.wall, b.inner), gate.half_aisle}),
                         c.frame.at({std::max(b.wall, b.inner), -gate.half_aisle}), ink::kBuffer);
  }
}

void draw_walls(const Canvas& c, const haptics::GateDescription& gate) {
  for (const haptics::WallInfo& wall : gate.walls) {
    const bool closed = wall.role == haptics::WallRole::closed_side, stop = wall.role == haptics::WallRole::end_stop;
    c.list.AddLine(c.frame.at(wall.from), c.frame.at(wall.to), closed ? ink::kWarn : ink::kWall,
                   (closed || stop ? 0.16f : 0.10f) * c.em);
  }
}

void draw_dashed(const Canvas& c, glm::dvec2 from, glm::dvec2 to, ImU32 colour) {
  constexpr int kDashes = 4;
  const glm::dvec2 step = (to - from) / (2.0 * kDashes - 1.0);
  for (int i = 0; i < kDashes; ++i) {
    const glm::dvec2 begin = from + 2.0 * i * step;
    c.list.AddLine(c.frame.at(begin), c.frame.at(begin + step), colour, 0.18f * c.em);
  }
}

void draw_lockouts(const Canvas& c, const haptics::Gate& gate) {
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    if (lockout.lateral) {
      draw_dashed(c, {lockout.barrier, -gate.half_aisle}, {lockout.barrier, gate.half_aisle}, ink::kBad);
      continue;
    }
    const haptics::Slot& slot = haptics::slot_of(gate, lockout.slot);
    if (haptics::is_mechanism(gate)) {  // round the place, where the lever is stopped
      const double radius = (lockout.is_leaving ? haptics::kHeldRadius : haptics::kClosedRadius) * slot.end;
      c.list.AddCircle(c.frame.at(slot.at), c.frame.length(radius), ink::kBad, 0, 0.1f * c.em);
      continue;
    }
    const haptics::Column& column = haptics::column_of(gate, slot.column);
    const double y = static_cast<int>(slot.side) * (gate.half_aisle + gate.chamfer);
    draw_dashed(c, {column.center - column.half_width, y}, {column.center + column.half_width, y}, ink::kBad);
  }
}

void centred_text(const Canvas& c, ImFont* font, ImVec2 at, ImU32 colour, const char* text) {
  const ImVec2 size = font->CalcTextSizeA(engine::ui_font_size(font), 1e9f, 0.0f, text);
  c.list.AddText(font, engine::ui_font_size(font), {std::round(at.x - 0.5f * size.x), std::round(at.y - 0.5f * size.y)},
                 colour, text);
}

// The labels of places are on them, and a ring shows where they count.
void draw_places(const Canvas& c, const haptics::Gate& gate, const haptics::HapticSnapshot& now) {
  for (int i = 0; i < gate.slot_count; ++i) {
    const haptics::Slot& place = haptics::slot_of(gate, i);
    const ImVec2 at = c.frame.at(place.at);
    const bool on = now.slot == i && place.gear == now.gear;
    c.list.AddCircle(at, c.frame.length(place.end - place.engage_depth), engine::with_alpha(ink::kAccent, 0.45f));
    if (on) c.list.AddCircleFilled(at, 0.72f * c.em, ink::kAccentDeep);
    centred_text(c, engine::ui_font(engine::UiFont::title), at, on ? ink::kText : ink::kSoft,
                 haptics::gear_label(gate, place.gear));
  }
}

// Fills the slot, from the middle of the aisle to its end.
void draw_wanted(const Canvas& c, const haptics::Gate& gate, int gear) {
  for (const haptics::Slot& slot : haptics::slots(gate)) {
    if (slot.gear != gear || gear == haptics::kNeutralGear) continue;
    if (haptics::is_mechanism(gate)) {
      c.list.AddCircleFilled(c.frame.at(slot.at), c.frame.length(slot.end - slot.engage_depth),
                             engine::with_alpha(ink::kIdeal, 0.28f));
      continue;
    }
    const haptics::Column& column = haptics::column_of(gate, slot.column);
    const double side = static_cast<int>(slot.side);
    const ImVec2 a = c.frame.at({column.center - column.half_width, 0.0}),
                 b = c.frame.at({column.center + column.half_width, side * slot.end});
    const ImVec2 low(a.x, std::min(a.y, b.y)), high(b.x, std::max(a.y, b.y));
    c.list.AddRectFilled(low, high, engine::with_alpha(ink::kIdeal, 0.28f));
    c.list.AddRect(low, high, ink::kIdeal, 0.0f, 0, 0.12f * c.em);
  }
}

void draw_gears(const Canvas& c, const haptics::Gate& gate, const haptics::HapticSnapshot& now) {
  if (haptics::is_mechanism(gate)) return draw_places(c, gate, now);
  for (const haptics::Slot& slot : haptics::slots(gate)) {
    const double x = haptics::column_of(gate, slot.column).center, side = static_cast<int>(slot.side);
    const ImVec2 at = c.frame.at({x, side * (slot.end + 0.5 * kRim)});
    const bool on = slot.gear == now.gear;
    if (on) c.list.AddCircleFilled(at, 0.72f * c.em, ink::kAccentDeep);
    centred_text(c, engine::ui_font(engine::UiFont::title), at, on ? ink::kText : ink::kSoft,
                 haptics::gear_label(gate, slot.gear));
    const double half = haptics::column_of(gate, slot.column).half_width;
    c.list.AddLine(c.frame.at({x - half, side * slot.engage_depth}), c.frame.at({x + half, side * slot.engage_depth}),
                   engine::with_alpha(ink::kAccent, 0.45f));
  }
}

void draw_trail(const Canvas& c, const Trail& trail) {
  const TrailPoint* before = nullptr;
  for (const TrailPoint& point : trail.points()) {
    const auto fresh = static_cast<float>(1.0 - trail.age(point));
    if (before != nullptr)
      c.list.AddLine(c.frame.at(before->lever), c.frame.at(point.lever),
                     engine::with_alpha(ink::kAccent, 0.75f * fresh), 0.13f * c.em);
    before = &point;
  }
}

void draw_driven_path(const Canvas& c, std::span<const glm::dvec2> path) {
  for (std::size_t i = 1; i < path.size(); ++i)
    c.list.AddLine(c.frame.at(path[i - 1]), c.frame.at(path[i]), ink::kDriven, 0.16f * c.em);
}

// Draws the path dashed; the dash pattern continues around corners.
void draw_ideal_path(const Canvas& c, std::span<const glm::dvec2> path) {
  const double dash = 0.5 * static_cast<double>(c.em) / c.frame.px_per_m, period = 1.7 * dash;
  double along = 0.0;  // [m] path length since the last dash began
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = glm::distance(path[i - 1], path[i]);
    const auto place = [&](double at) { return c.frame.at(path[i - 1] + (path[i] - path[i - 1]) * (at / length)); };
    for (double at = -along; at < length; at += period) {
      const double from = std::max(at, 0.0), to = std::min(at + dash, length);
      if (to > from) c.list.AddLine(place(from), place(to), ink::kIdeal, 0.22f * c.em);
    }
    along = std::fmod(along + length, period);
  }
}

void draw_arrow(const Canvas& c, ImVec2 from, glm::dvec2 force, double px_per_n, ImU32 colour) {
  const glm::dvec2 arrow = force * px_per_n * glm::dvec2(1.0, -1.0);
  const double length = glm::length(arrow);
  if (!(length > 0.25 * static_cast<double>(c.em))) return;
  const glm::dvec2 along = arrow / length, across{-along.y, along.x};
  const double head = std::min(0.6 * length, 0.55 * static_cast<double>(c.em));
  const auto place = [&](double forth, double aside) {
    const glm::dvec2 p = along * forth + across * aside;
    return ImVec2(from.x + static_cast<float>(p.x), from.y + static_cast<float>(p.y));
  };
  c.list.AddLine(from, place(length - head, 0.0), colour, 0.2f * c.em);
  c.list.AddTriangleFilled(place(length, 0.0), place(length - head, 0.6 * head), place(length - head, -0.6 * head),
                           colour);
}

// Draws the proxy as a disc and the lever point as a ring. The line between disc and ring is the penetration.
void draw_lever(const Canvas& c, const haptics::HapticSnapshot& now, double px_per_n) {
  const ImVec2 lever = c.frame.at(now.lever), proxy = c.frame.at(now.proxy);
  const bool ghost = (now.flags & haptics::kFlagGhost) != 0;
  c.list.AddLine(proxy, lever, ink::kBad, 0.16f * c.em);
  c.list.AddCircleFilled(proxy, 0.42f * c.em, ink::kProxy);
  c.list.AddCircle(lever, 0.56f * c.em, ghost ? ink::kBad : ink::kLever, 0, 0.13f * c.em);
  draw_arrow(c, lever, now.f_h, px_per_n, ink::kHand);
  draw_arrow(c, lever, now.commanded, px_per_n, ink::kActuator);
}

// Draws the scales for lengths and force arrows below the gate.
void draw_scales(const Canvas& c, ImVec2 low, ImVec2 size, double px_per_n) {
  ImFont* font = engine::ui_font(engine::UiFont::small);
  const float y = low.y + size.y - 0.5f * engine::ui_font_size(font) - 0.2f * c.em;
  const float length = c.frame.length(kScaleLength);
  float x = low.x + 0.5f * c.em;
  const auto text = [&](const char* words) {
    c.list.AddText(font, engine::ui_font_size(font), {x, y - 0.5f * engine::ui_font_size(font)}, ink::kSoft, words);
    x += font->CalcTextSizeA(engine::ui_font_size(font), 1e9f, 0.0f, words).x + c.em;
  };
  c.list.AddLine({x, y}, {x + length, y}, ink::kSoft, 0.1f * c.em);
  for (const float end : {x, x + length}) c.list.AddLine({end, y - 0.25f * c.em}, {end, y + 0.25f * c.em}, ink::kSoft);
  x += length + 0.4f * c.em;
  text("20 mm");
  const auto ten = static_cast<float>(10.0 * px_per_n);
  draw_arrow(c, {x, y}, {10.0, 0.0}, px_per_n, ink::kSoft);
  x += ten + 0.4f * c.em;
  text("10 N");
}

}  // namespace

void draw_gate_view(ImVec2 size, const haptics::Gate& gate, const haptics::GateDescription& description,
                    const haptics::HapticSnapshot& now, const Trail& trail, double max_force, const ShownPaths& paths) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy(size);
  const bool with_forces = max_force > 0.0;
  const float em = engine::ui_em(), foot = with_forces ? engine::ui_font_size(engine::UiFont::small) + 0.3f * em : 0.0f;
  const Extent box = extent_of(gate, description);
  const Canvas c{*ImGui::GetWindowDrawList(), fit(box, low, {size.x, size.y - foot}), em};
  const double px_per_n =
      with_forces ? kArrowFraction * static_cast<double>(std::min(size.x, size.y - foot)) / std::max(max_force, 1.0)
                  : 0.0;
  c.list.PushClipRect(low, {low.x + size.x, low.y + size.y}, true);
  c.list.AddRectFilled(c.frame.at({box.min.x, box.max.y}), c.frame.at({box.max.x, box.min.y}), ink::kPlate, 0.6f * em);
  draw_free_space(c, description);
  draw_buffers(c, gate);
  draw_lockouts(c, gate);
  draw_wanted(c, gate, paths.wanted_gear);
  draw_walls(c, description);
  draw_gears(c, gate, now);
  draw_trail(c, trail);
  draw_driven_path(c, paths.driven);
  draw_ideal_path(c, paths.ideal);
  draw_lever(c, now, px_per_n);
  if (with_forces) draw_scales(c, low, size, px_per_n);
  c.list.PopClipRect();
}

std::optional<int> gear_at(const haptics::Gate& gate, const haptics::GateDescription& description, ImVec2 at) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const Extent box = extent_of(gate, description);
  const GateFrame frame = fit(box, low, {high.x - low.x, high.y - low.y});
  const glm::dvec2 p = frame.center + glm::dvec2(at.x - frame.middle.x, frame.middle.y - at.y) / frame.px_per_m;
  if (p.x < box.min.x || p.x > box.max.x || p.y < box.min.y || p.y > box.max.y) return std::nullopt;
  if (haptics::is_mechanism(gate)) {
    for (const haptics::Slot& place : haptics::slots(gate))
      if (glm::distance(p, place.at) < kRim) return place.gear;
    return std::nullopt;
  }
  const int column = haptics::nearest_column(gate, p.x);
  for (const haptics::Slot& slot : haptics::slots(gate)) {
    const double depth = static_cast<int>(slot.side) * p.y;
    if (slot.column == column && depth > gate.half_aisle) return slot.gear;
  }
  return haptics::kNeutralGear;
}

}  // namespace gearshift::ui
