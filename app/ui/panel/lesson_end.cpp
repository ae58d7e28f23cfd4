#include "app/ui/panel/lesson_end.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/lessons/assessment/grade.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/panel_keys.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

// Minimum width for two columns [em], and the left column's fraction of the width [1].
constexpr float kTwoColumns = 32.0f, kLeftFraction = 0.48f;
constexpr float kVisibleErrors = 3.0f;  // number of error lines that must be visible

const char* format_outcome(const lessons::LessonResult& result) {
  if (lessons::is_graded(result)) return result.passed ? "Passed" : "Not passed";
  if (result.end == lessons::LessonEnd::left) return "Not finished";
  return result.end == lessons::LessonEnd::done ? "Completed" : "Not completed";
}

// Draws the grade, or "not graded" in the same width.
void draw_grade(const lessons::LessonResult& result) {
  const float em = engine::ui_em(), begin = ImGui::GetCursorPosX();
  ImGui::BeginGroup();
  if (lessons::is_graded(result)) {
    put(format_verdict(result), verdict_colour(result), engine::UiFont::digits);
    ImGui::SameLine(0.0f, 0.3f * em);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + engine::ui_font_size(engine::UiFont::digits) - 1.5f * em);
    put("of 10", ink::kSoft, engine::UiFont::small);
  } else {
    ImGui::Dummy({0.0f, 0.3f * em});
    put("not", ink::kSoft, engine::UiFont::prompt);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 0.35f * em);
    put("graded", ink::kSoft, engine::UiFont::prompt);
  }
  ImGui::EndGroup();
  const float wanted = begin + std::max(9.2f * em, ImGui::GetItemRectSize().x + em);
  ImGui::SameLine(wanted);
  if (ImGui::GetContentRegionAvail().x < 7.5f * em) ImGui::NewLine();
}

void draw_outcome(const lessons::CoachView& coach) {
  const lessons::LessonResult& result = *coach.result;
  ImGui::BeginGroup();
  put_wrapped(coach.title, ink::kSoft, engine::UiFont::small);
  put(format_outcome(result), lessons::is_graded(result) ? verdict_colour(result) : ink::kText, engine::UiFont::prompt);
  if (!result.why.empty()) put_wrapped(result.why, ink::kText, engine::UiFont::body);
  if (const std::string_view good = lessons::what_was_good(result); !good.empty())
    put_wrapped(fmt::format("Good: {}", good), ink::kGood, engine::UiFont::body);
  if (!coach.mend.empty()) put_wrapped(fmt::format("To mend: {}", coach.mend), ink::kWarn, engine::UiFont::body);
  if (!coach.mastery.empty()) put_wrapped(coach.mastery, ink::kAccent, engine::UiFont::body);
  ImGui::EndGroup();
}

// True for errors that cost points, and for errors that would cost points if the run were graded.
bool is_listed(const lessons::LessonResult& result, const lessons::DrivingError& error) {
  return error.points > 0.0 || (!lessons::is_graded(result) && error.severity != lessons::Severity::note);
}

void draw_driving_error(const lessons::LessonResult& result, const lessons::DrivingError& error,
                        std::string_view advice) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  put(fmt::format("{:.1f} s", error.time - result.begin), ink::kSoft, engine::UiFont::small);
  ImGui::TableNextColumn();
  put_wrapped(lessons::error_sentence(error), ink::kText, engine::UiFont::small);
  if (!advice.empty()) put_wrapped(advice, ink::kAccent);
  ImGui::TableNextColumn();
  if (error.points > 0.0 && lessons::is_graded(result))
    put(fmt::format("-{:.1f}", error.points), severity_colour(error.severity), engine::UiFont::small);
}

// Returns the reason why the run ended early, which costs all points; empty if the run was completed.
std::string format_end(const lessons::LessonResult& result) {
  std::string words;
  if (result.end == lessons::LessonEnd::out_of_time) words = "Time's up";
  if (result.end == lessons::LessonEnd::aborted)
    words = lessons::is_graded(result) && !result.why.empty() ? result.why : "Stopped early";
  if (words.empty()) return words;
  if (words.back() == '.') words.pop_back();
  return words + (lessons::is_graded(result) ? " (0 points)." : ".");
}

void draw_end(const lessons::LessonResult& result) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  put(fmt::format("{:.1f} s", result.duration), ink::kSoft, engine::UiFont::small);
  ImGui::TableNextColumn();
  put_wrapped(format_end(result), ink::kBad, engine::UiFont::small);
}

// Lists the errors in the order in which they happened. The reason for an early end comes first, because the end of a
// long list may not be visible.
void draw_driving_errors(const lessons::LessonResult& result) {
  const auto listed = [&](const lessons::DrivingError& error) { return is_listed(result, error); };
  const bool ended = !format_end(result).empty();
  if (!ended && std::none_of(result.errors.begin(), result.errors.end(), listed)) return;
  if (!ImGui::BeginTable("fault", 3, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed, 3.4f * engine::ui_em());
  ImGui::TableSetupColumn("says", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("points", ImGuiTableColumnFlags_WidthFixed, 2.2f * engine::ui_em());
  if (ended) draw_end(result);
  ErrorKinds advised;
  for (const lessons::DrivingError& error : result.errors) {
    if (listed(error)) draw_driving_error(result, error, take_advice(error, advised));
  }
  ImGui::EndTable();
}

bool has_figures(const lessons::CoachView& coach) {
  return coach.norm != nullptr && coach.result->score;
}

// Lists the figures of the run, each with its norm.
void draw_figures(const lessons::CoachView& coach) {
  if (!has_figures(coach)) return;
  if (!ImGui::BeginTable("figures", 3, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("figure", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, width_of("8888 rpm", engine::UiFont::small));
  ImGui::TableSetupColumn("norm", ImGuiTableColumnFlags_WidthFixed, width_of("up to 8888 m/s³", engine::UiFont::small));
  for (const lessons::FigureLine& line : lessons::figure_lines(*coach.result, coach.norm)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    put_wrapped(line.label, ink::kSoft, engine::UiFont::small);
    ImGui::TableNextColumn();
    put(line.value, line.is_worse ? ink::kWarn : ink::kText, engine::UiFont::small);
    ImGui::TableNextColumn();
    put(line.norm, ink::kSoft, engine::UiFont::small);
  }
  ImGui::EndTable();
}

float draw_judgement(const lessons::CoachView& coach) {
  draw_grade(*coach.result);
  draw_outcome(coach);
  if (has_figures(coach)) put_wrapped(lessons::kNormOrigin, ink::kSoft, engine::UiFont::small);
  return ImGui::GetCursorPosY();
}

}  // namespace

float draw_lesson_end(const lessons::CoachView& coach) {
  const float em = engine::ui_em(), all = ImGui::GetContentRegionAvail().x;
  if (all < kTwoColumns * em) {
    const float judged = draw_judgement(coach);
    draw_driving_errors(*coach.result);
    draw_figures(coach);
    const float line = engine::ui_font_size(engine::UiFont::small) + 2.0f * ImGui::GetStyle().CellPadding.y;
    return std::min(ImGui::GetCursorPosY(), judged + kVisibleErrors * line);
  }
  begin_child("judgement", {kLeftFraction * all, 0.0f});
  const float judged = draw_judgement(coach);
  ImGui::EndChild();
  ImGui::SameLine();
  begin_child("faults", {0.0f, 0.0f});
  draw_driving_errors(*coach.result);
  draw_figures(coach);
  ImGui::EndChild();
  return judged;
}

}  // namespace gearshift::ui
