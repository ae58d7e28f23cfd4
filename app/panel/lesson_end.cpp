#include "app/panel/lesson_end.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/panel/fault_lines.h"
#include "app/panel/lesson_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr float kTwoColumns = 32.0f, kLeftShare = 0.48f;  // [em] from that width on; [1] of it
constexpr float kFewFaults = 3.0f;                        // lines that must be seen

const char* outcome_words(const LessonResult& result) {
  if (shows_grade(result)) return result.passed ? "Passed" : "Not passed";
  if (result.end == LessonEnd::left) return "Not finished";
  return result.end == LessonEnd::done ? "Done" : "Not done";
}

// The grade, or that there is none; as wide as the grade is in any case.
void draw_grade(const LessonResult& result) {
  const float em = ui_em(), begin = ImGui::GetCursorPosX();
  ImGui::BeginGroup();
  if (shows_grade(result)) {
    put(verdict_words(result), verdict_colour(result), UiFont::digits);
    ImGui::SameLine(0.0f, 0.3f * em);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui_font(UiFont::digits)->FontSize - 1.5f * em);
    put("of 10", ink::kSoft, UiFont::small);
  } else {
    ImGui::Dummy({0.0f, 0.3f * em});
    put("not", ink::kSoft, UiFont::prompt);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 0.35f * em);
    put("graded", ink::kSoft, UiFont::prompt);
  }
  ImGui::EndGroup();
  const float wanted = begin + std::max(9.2f * em, ImGui::GetItemRectSize().x + em);
  ImGui::SameLine(wanted);
  if (ImGui::GetContentRegionAvail().x < 7.5f * em) ImGui::NewLine();
}

void draw_outcome(const CoachView& coach) {
  const LessonResult& result = coach.result;
  ImGui::BeginGroup();
  put_wrapped(coach.title, ink::kSoft, UiFont::small);
  put(outcome_words(result), shows_grade(result) ? verdict_colour(result) : ink::kText, UiFont::prompt);
  if (!result.why.empty()) put_wrapped(result.why, ink::kText, UiFont::body);
  ImGui::EndGroup();
}

// What cost points; where nothing did because there is no grade, what would have.
bool is_told(const LessonResult& result, std::size_t fault) {
  return points_of_fault(result, fault) > 0.0 ||
         (!shows_grade(result) && result.faults[fault].severity != Severity::note);
}

void draw_fault(const LessonResult& result, std::size_t index, bool advises) {
  const DriveFault& fault = result.faults[index];
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  put(fmt::format("{:.1f} s", fault.time - result.begin), ink::kSoft, UiFont::small);
  ImGui::TableNextColumn();
  put_wrapped(fault_sentence(fault), ink::kText, UiFont::small);
  if (advises) put_advice(fault.kind);
  ImGui::TableNextColumn();
  const double points = points_of_fault(result, index);
  if (points > 0.0 && shows_grade(result))
    put(fmt::format("-{:.1f}", points), severity_colour(fault.severity), UiFont::small);
}

// What made it end before its time, and that this makes 0; nothing where it was driven to its end.
std::string end_words(const LessonResult& result) {
  std::string words;
  if (result.end == LessonEnd::out_of_time) words = "Time is up";
  if (result.end == LessonEnd::aborted) words = shows_grade(result) && !result.why.empty() ? result.why : "Broken off";
  if (words.empty()) return words;
  if (words.back() == '.') words.pop_back();
  return words + (shows_grade(result) ? ": 0" : ".");
}

void draw_end(const LessonResult& result) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  put(fmt::format("{:.1f} s", result.duration), ink::kSoft, UiFont::small);
  ImGui::TableNextColumn();
  put_wrapped(end_words(result), ink::kBad, UiFont::small);
}

// In the order of the drive: what ended it comes last but is told first, for the list may be long.
void draw_faults(const LessonResult& result) {
  std::vector<std::size_t> told;
  for (std::size_t i = 0; i < result.faults.size(); ++i)
    if (is_told(result, i)) told.push_back(i);
  const bool ended = !end_words(result).empty();
  if ((told.empty() && !ended) || !ImGui::BeginTable("fault", 3, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed, 3.4f * ui_em());
  ImGui::TableSetupColumn("says", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("points", ImGuiTableColumnFlags_WidthFixed, 2.2f * ui_em());
  if (ended) draw_end(result);
  std::vector<std::size_t> above;
  for (const std::size_t fault : told) {
    draw_fault(result, fault, needs_advice(result, fault, above));
    above.push_back(fault);
  }
  ImGui::EndTable();
}

float draw_judgement(const CoachView& coach) {
  draw_grade(coach.result);
  draw_outcome(coach);
  return ImGui::GetCursorPosY();
}

}  // namespace

float draw_lesson_end(const CoachView& coach) {
  const float em = ui_em(), all = ImGui::GetContentRegionAvail().x;
  if (all < kTwoColumns * em) {
    const float judged = draw_judgement(coach);
    draw_faults(coach.result);
    const float line = ui_font(UiFont::small)->FontSize + 2.0f * ImGui::GetStyle().CellPadding.y;
    return std::min(ImGui::GetCursorPosY(), judged + kFewFaults * line);
  }
  ImGui::BeginChild("judgement", {kLeftShare * all, 0.0f}, false, ImGuiWindowFlags_NavFlattened);
  const float judged = draw_judgement(coach);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("faults", {0.0f, 0.0f}, false, ImGuiWindowFlags_NavFlattened);
  draw_faults(coach.result);
  ImGui::EndChild();
  return judged;
}

}  // namespace gearshift
