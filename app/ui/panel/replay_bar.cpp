#include "app/ui/panel/replay_bar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/ui/panel/bottom_window.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/plot_area.h"
#include "app/ui/panel/text_lines.h"
#include "haptics/files/parameter.h"

namespace gearshift::ui {
namespace {

constexpr float kMaxBarWidth = 80.0f, kOpeningWidth = 36.0f;                    // [em]
constexpr float kPedalHeight = 2.1f, kSpeedHeight = 2.5f, kForceHeight = 2.1f;  // [em] enough for two axis numbers
constexpr std::array<double, 5> kPaces{0.1, 0.25, 0.5, 1.0, 2.0};
constexpr double kMinSpan = 1e-3;  // [s]

bool begin_bar(const ControlRect& room, float width) {
  const auto max = std::max(engine::ui_em(), static_cast<float>(room.max.y - room.min.y));
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, max});
  return begin_at_bottom("Replay", room, ImGuiWindowFlags_AlwaysAutoResize);
}

// Ends the bar's window and returns its upper edge [px].
double end_bar(const ControlRect& room) {
  const double top = static_cast<double>(ImGui::GetWindowPos().y);
  ImGui::End();
  return std::clamp(top, room.min.y, room.max.y);
}

// Width [px] reserved for the numbers to the left of the curves. The slider and the shift marks are indented by this
// width, so that they share the curves' time axis.
float gutter() {
  return width_of("8888", engine::UiFont::small) + 0.6f * engine::ui_em();
}

// The drive's run in the history, found by its file name; null: the history does not have it.
const lessons::RunRow* find_run(const lessons::CoachView& coach, std::string_view file) {
  const auto is_recorded_in = [&](const lessons::RunRow& run) {
    const std::string_view path = run.recording;
    return path.substr(path.rfind('/') + 1) == file;  // npos + 1 is 0: a path without a folder
  };
  const auto run = std::find_if(coach.runs.begin(), coach.runs.end(), is_recorded_in);
  return run == coach.runs.end() ? nullptr : &*run;
}

// Returns the bar's title. It begins with lesson, learner and time of the run, or with the file name if the history
// does not have the run. Car and gate follow.
std::string heading(const lessons::Player& replay, const lessons::CoachView& coach) {
  const std::string file = replay.file().filename().string();
  std::string words = "Replay: ";
  if (const lessons::RunRow* run = find_run(coach, file)) {
    words += lesson_title(coach, run->result.lesson);
    if (!coach.learner.empty()) words += ", " + coach.learner;
    words += ", " + format_local_time(run->begun_at);
  } else {
    words += file;
  }
  const lessons::RecordedDrive& drive = replay.drive();
  if (drive.has_car()) words += " · " + readable_name(drive.car_name());
  return words + " · " + readable_name(std::filesystem::path(drive.header().gate_file).stem().string());
}

// "Opening drive-20260131.trace ..."
void draw_opening(Controls& controls, std::string_view file, PanelCommands& out) {
  const float close = button_width("Close") + ImGui::GetStyle().ItemSpacing.x;
  const std::string words = fmt::format("Opening {} \u2026", file);
  ImGui::AlignTextToFramePadding();
  put(without_middle(words, ImGui::GetContentRegionAvail().x - close), ink::kText);
  align_right(button_width("Close"));
  if (controls.button("replay_close", "Close")) out.push_back(CloseReplay{});
}

// Maps the time of the whole drive to pixels, from left to right.
struct Overview {
  ImVec2 low, size;    // [px]
  double begin, span;  // [s]
  float at(double time) const { return low.x + size.x * static_cast<float>((time - begin) / span); }
};

// Left edge and width of a shift's button [px]. The button is as wide as the shift's duration, or as its label if that
// is wider and fits before the next button. The last button may extend to the left for its label.
struct Mark {
  float from, width;
  bool named;
};

Mark mark_of(const Overview& view, std::span<const lessons::RecordedShift> shifts, std::size_t index, float name) {
  const float min = 0.5f * engine::ui_em(), gap = 2.0f, high = view.low.x + view.size.x;
  const lessons::ShiftRecord& shift = shifts[index].record;
  const float from = std::min(view.at(shift.begin), high - min), took = std::max(min, view.at(shift.end) - from);
  const bool is_last = index + 1 == shifts.size();
  const float room = (is_last ? high : view.at(shifts[index + 1].record.begin) - gap) - from;
  if (std::max(took, room) >= name) return {from, std::max(took, name), true};
  const float before = index == 0 ? view.low.x : view.at(shifts[index - 1].record.begin) + name + gap;
  if (is_last && high - name >= before) return {high - name, name, true};
  return {from, took, false};
}

void draw_shift_mark(Controls& controls, const Overview& view, const lessons::RecordedDrive& drive, std::size_t index,
                     bool on, PanelCommands& out) {
  const engine::WithFont small(engine::UiFont::small);
  const lessons::ShiftRecord& shift = drive.shifts()[index].record;
  const std::string words = format_gears(shift), name = fmt::format("replay_shift: {}", index);
  const Mark mark = mark_of(view, drive.shifts(), index, width_of(words) + 0.5f * engine::ui_em());
  ImGui::SetCursorScreenPos({mark.from, view.low.y});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, 0.0f});
  if (controls.button(name.c_str(), mark.named ? words.c_str() : "", {mark.width, view.size.y},
                      on ? ink::kAccentDeep : ink::kRaisedHover))
    out.push_back(ShowShift{index});
  ImGui::PopStyleVar();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s, %.2f s", words.c_str(), shift.end - shift.begin);
}

void draw_shift_marks(Controls& controls, const lessons::Player& replay, PanelCommands& out) {
  const lessons::RecordedDrive& drive = replay.drive();
  const float em = engine::ui_em();
  const ImVec2 low = ImGui::GetCursorScreenPos(), size(ImGui::GetContentRegionAvail().x, 1.25f * em);
  const Overview view{low, size, drive.begin(), std::max(kMinSpan, drive.end() - drive.begin())};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {low.x + size.x, low.y + size.y}, ink::kWell, 3.0f);
  list.AddRectFilled({view.at(replay.from()), low.y}, {view.at(replay.to()), low.y + size.y},
                     engine::with_alpha(ink::kAccent, 0.16f), 3.0f);
  for (std::size_t i = 0; i < drive.shifts().size(); ++i)
    draw_shift_mark(controls, view, drive, i, replay.shift() == i, out);
  const float now = view.at(replay.time());
  list.AddLine({now, low.y}, {now, low.y + size.y}, ink::kText, 0.12f * em);
  ImGui::SetCursorScreenPos(low);
  ImGui::Dummy(size);
}

// Draws a legend entry with room for its widest value, so that the entries to its right do not move.
void entry(Controls& controls, ImU32 colour, const std::string& text, const char* widest, bool first = false) {
  const float em = engine::ui_em(), width = width_of(widest, engine::UiFont::small) + 1.4f * em;
  if (!first) same_line_if_fits(width);
  const float begin = ImGui::GetCursorPosX();
  controls.legend(colour, text);
  ImGui::SameLine(begin + width, 0.0f);
  ImGui::Dummy({0.0f, engine::ui_font_size(engine::UiFont::small)});
}

double max_of(const Strip& one, const Strip& other) {
  return std::max({0.0, one.extent().max, other.extent().max});
}

// Draws the slider's handle exactly below the line that marks the current time in the curves.
void draw_handle(double from, double to, double now) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const double fraction = std::clamp((now - from) / std::max(kMinSpan, to - from), 0.0, 1.0);
  const float x = low.x + (high.x - low.x) * static_cast<float>(fraction), half = 0.3f * engine::ui_em();
  const ImU32 colour = ImGui::IsItemActive() ? ink::kText : ink::kAccent;
  ImGui::GetWindowDrawList()->AddRectFilled({x - half, low.y + 2.0f}, {x + half, high.y - 2.0f}, colour, 0.4f * half);
}

void draw_time(Controls& controls, const lessons::Player& replay, PanelCommands& out) {
  const double begin = replay.drive().begin();
  double time = replay.time() - begin;
  const double from = replay.from() - begin, to = replay.to() - begin;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  ImGui::PushStyleVar(ImGuiStyleVar_GrabMinSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_SliderGrab, engine::with_alpha(ink::kAccent, 0.0f));
  ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, engine::with_alpha(ink::kAccent, 0.0f));
  if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &time, &from, &to, "", ImGuiSliderFlags_AlwaysClamp))
    out.push_back(SeekReplay{begin + time});
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
  controls.mark("replay_time");
  draw_handle(from, to, replay.time() - begin);
}

void draw_paces(Controls& controls, const lessons::Player& replay, PanelCommands& out) {
  for (const double pace : kPaces) {
    const std::string label = fmt::format("{:g}\u00d7", pace);
    if (pace != kPaces.front()) ImGui::SameLine(0.0f, 2.0f);
    const bool on = std::abs(replay.pace() - pace) < 1e-9;
    if (controls.button(fmt::format("replay_pace: {:g}", pace).c_str(), label.c_str(), {0.0f, 0.0f},
                        on ? ink::kAccentDeep : ink::kRaised))
      out.push_back(SetPace{pace});
  }
}

float paces_width() {
  float width = 0.0f;
  for (const double pace : kPaces) width += button_width(fmt::format("{:g}\u00d7", pace)) + 2.0f;
  return width;
}

void draw_buttons(Controls& controls, const lessons::Player& replay, PanelCommands& out) {
  const float play = std::max(button_width("Play"), button_width("Pause"));
  if (controls.button("replay_play", replay.is_playing() ? "Pause" : "Play", {play, 0.0f}, ink::kPrimary))
    out.push_back(PlayReplay{!replay.is_playing()});
  const std::string time = fmt::format("{:.2f} s", replay.time() - replay.drive().begin());
  const float widest = width_of("888.88 s");
  same_line_if_fits(widest);
  const float begin = ImGui::GetCursorPosX();
  ImGui::AlignTextToFramePadding();
  put(time, ink::kText);
  ImGui::SameLine(begin + widest);
  if (ImGui::GetContentRegionAvail().x < paces_width()) ImGui::NewLine();
  draw_paces(controls, replay, out);
  same_line_if_fits(button_width("Whole drive"));
  if (controls.button("replay_whole", "Whole drive", {0.0f, 0.0f}, replay.shift() ? ink::kRaised : ink::kAccentDeep))
    out.push_back(ShowWholeDrive{});
  align_right(button_width("Close"));
  if (controls.button("replay_close", "Close")) out.push_back(CloseReplay{});
}

// Writes the unit in the upper right corner of a plot.
void write_unit(ImDrawList& list, ImVec2 corner, const char* unit) {
  ImFont* font = engine::ui_font(engine::UiFont::small);
  const float width = width_of(unit, engine::UiFont::small) + 0.3f * engine::ui_em();
  list.AddText(font, engine::ui_font_size(font), {corner.x - width, corner.y}, ink::kSoft, unit);
}

}  // namespace

ReplayBar::Curves::Curves(double span)
    : clutch(span, 1), throttle(span, 1), engine(span, 1), shaft(span, 1), force(span, 1) {}

void ReplayBar::Curves::push(const vehicle::DriveSample& sample) {
  const double time = sample.time();
  clutch.push(time, sample.car.pedals.clutch);
  throttle.push(time, sample.car.pedals.throttle);
  engine.push(time, sample.car.engine_speed);
  shaft.push(time, std::abs(sample.car.shaft_speed));
  force.push(time, glm::length(sample.lever.f_h));
}

void ReplayBar::follow(const lessons::Player& replay) {
  const vehicle::DriveSample* samples = replay.drive().samples().data();
  if (curves_ && samples == samples_ && replay.from() == from_ && replay.to() == to_) return;
  samples_ = samples;
  from_ = replay.from();
  to_ = replay.to();
  curves_.emplace(std::max(kMinSpan, to_ - from_));
  for (const vehicle::DriveSample& sample : replay.drive().between(from_, to_)) curves_->push(sample);
}

double ReplayBar::draw(Controls& controls, const PanelInput& input, const ControlRect& room, PanelCommands& out) {
  const lessons::Player* replay = input.replay;
  const bool opens = !input.opening.empty();
  const float width = bottom_width(room, opens ? kOpeningWidth : kMaxBarWidth);
  if (replay == nullptr || opens) curves_.reset();
  if ((replay == nullptr && !opens) || width < kMinBottomWidth * engine::ui_em()) return room.max.y;
  if (opens) {
    if (begin_bar(room, width)) draw_opening(controls, input.opening, out);
    return end_bar(room);
  }
  follow(*replay);
  if (begin_bar(room, width)) {
    const float indent = gutter();
    put_wrapped(heading(*replay, input.coach), ink::kText, engine::UiFont::body);
    ImGui::Indent(indent);
    draw_shift_marks(controls, *replay, out);
    ImGui::Unindent(indent);
    if (replay->drive().has_diverged())
      put_wrapped(
          "From some point on, this drive no longer replays as recorded. Shifts after the first difference are not "
          "shown.",
          ink::kWarn);
    draw_legend(controls, *replay);
    ImGui::Indent(indent);
    draw_curves(*replay);
    draw_time(controls, *replay, out);
    ImGui::Unindent(indent);
    draw_buttons(controls, *replay, out);
  }
  return end_bar(room);
}

void ReplayBar::draw_legend(Controls& controls, const lessons::Player& replay) {
  const vehicle::DriveSample& now = replay.now();
  entry(controls, ink::kAccent, fmt::format("clutch {:.0f} %", 100.0 * now.car.pedals.clutch), "clutch 100 %", true);
  entry(controls, ink::kGood, fmt::format("throttle {:.0f} %", 100.0 * now.car.pedals.throttle), "throttle 100 %");
  entry(controls, ink::kEngine, "engine " + format_rpm(now.car.engine_speed), "engine 8888 rpm");
  entry(controls, ink::kShaft, "shaft " + format_rpm(std::abs(now.car.shaft_speed)), "shaft 8888 rpm");
  entry(controls, ink::kHand, fmt::format("hand {:.1f} N", glm::length(now.lever.f_h)), "hand 88.8 N");
  if (!replay.shift()) return;
  entry(controls, ink::kDriven, "path", "path");
  entry(controls, ink::kIdeal, "shortest", "shortest");
}

// Draws pedals, speeds and force one below the other, on the slider's time axis.
void ReplayBar::draw_curves(const lessons::Player& replay) {
  const float em = engine::ui_em(), width = ImGui::GetContentRegionAvail().x;
  const double begin = replay.drive().begin();
  const PlotRange time{replay.from() - begin, std::max(replay.from() + kMinSpan, replay.to()) - begin};
  const auto lane = [&](const char* unit, float height, double max, double factor, Strip* one, ImU32 colour,
                        Strip* other, ImU32 other_colour) {
    PlotArea plot({width, height * em}, time, {0.0, max}, nullptr, true);
    for (const lessons::RecordedShift& shift : replay.drive().shifts())
      plot.list().AddRectFilled(plot.at(shift.record.begin - begin, max), plot.at(shift.record.end - begin, 0.0),
                                engine::with_alpha(ink::kAccent, 0.1f));
    for (const auto& [strip, shade] : {std::pair(other, other_colour), std::pair(one, colour)}) {
      if (strip == nullptr) continue;
      strip->set_columns(std::max(1, plot.columns()));
      plot.strip(*strip, factor, shade);
    }
    write_unit(plot.list(), plot.at(time.high, max), unit);
    const double now = replay.time() - begin;
    plot.list().AddLine(plot.at(now, 0.0), plot.at(now, max), ink::kText, 0.1f * em);
  };
  Curves& c = *curves_;
  const double rpm = 1000.0 * std::max(1.0, std::ceil(max_of(c.engine, c.shaft) / haptics::kTurnPerMinute / 1000.0));
  lane("%", kPedalHeight, 105.0, 100.0, &c.clutch, ink::kAccent, &c.throttle, ink::kGood);
  lane("rpm", kSpeedHeight, rpm, 1.0 / haptics::kTurnPerMinute, &c.engine, ink::kEngine, &c.shaft, ink::kShaft);
  lane("N", kForceHeight, nice_above(std::max(1.0, 1.05 * max_of(c.force, c.force)), 10.0), 1.0, &c.force, ink::kHand,
       nullptr, 0);
}

}  // namespace gearshift::ui
