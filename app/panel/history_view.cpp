#include "app/panel/history_view.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/panel/fault_lines.h"
#include "app/panel/lesson_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr double kToSee = 0.005;  // [s] shorter is nothing

// Pedal and revs: what a grade looks at first.
std::string meeting_words(const ShiftRecord& shift) {
  if (shift.to == kNeutralGear) return "no gear came in";
  const char* when = shift.clutch_lag < 0.0 ? "before" : "after";
  return fmt::format("clutch up {:.2f} s {} the gear, {} apart", std::abs(shift.clutch_lag), when,
                     rpm_words(std::abs(shift.rev_error)));
}

std::string resistance_words(const ShiftRecord& shift) {
  std::string words;
  if (shift.block_time > kToSee) words = fmt::format("blocked for {:.2f} s", shift.block_time);
  if (shift.grind_time > kToSee)
    words +=
        fmt::format("{}ground for {:.2f} s, {:.1f} J", words.empty() ? "" : ", ", shift.grind_time, shift.grind_energy);
  return words;
}

void draw_fault(const LessonResult& result, std::size_t index) {
  const DriveFault& fault = result.faults[index];
  const double points = points_of_fault(result, index);
  const std::string cost = points > 0.0 && shows_grade(result) ? fmt::format(" (-{:.1f})", points) : std::string();
  put_wrapped(fault_sentence(fault) + cost, severity_colour(fault.severity));
}

void draw_faults(const LessonResult& result, std::int64_t shift) {
  std::vector<std::size_t> told;
  for (std::size_t i = 0; i < result.faults.size(); ++i) {
    if (result.faults[i].shift != shift) continue;
    draw_fault(result, i);
    if (needs_advice(result, i, told)) put_advice(result.faults[i].kind);
    told.push_back(i);
  }
}

void draw_shift(Controls& controls, const RunRow& run, const ShiftRecord& shift, ReplayRequests& out) {
  const std::string name = fmt::format("look: {} {}", run.id, shift.number);
  put(gears_words(shift), shift.missed ? ink::kBad : ink::kText, UiFont::title);
  ImGui::SameLine();
  put(fmt::format("{:.2f} s{}", shift.end - shift.begin, shift.missed ? ", missed" : ""), ink::kSoft, UiFont::small);
  {
    const WithFont small(UiFont::small);
    at_right(button_width("look"));
    ImGui::BeginDisabled(run.recording.empty());
    if (controls.button(name.c_str(), "look")) out.open = {run.recording, shift.begin};
    ImGui::EndDisabled();
  }
  put_wrapped(meeting_words(shift), ink::kSoft);
  const std::string resistance = resistance_words(shift);
  if (!resistance.empty()) put_wrapped(resistance, ink::kSoft);
  draw_faults(run.result, shift.number);
  ImGui::Spacing();
}

}  // namespace

void HistoryView::draw(Controls& controls, const CoachView& coach, PanelRequests& out) {
  if (coach.runs.empty()) {
    put_wrapped(coach.learner.empty() ? "Whoever has a name has a history." : "No lesson has been driven yet.",
                ink::kSoft);
    return;
  }
  ImGui::Spacing();
  put(fmt::format("Times are local: {}.", time_zone_words(std::time(nullptr))), ink::kSoft, UiFont::small);
  for (std::size_t i = 0; i < coach.runs.size(); ++i) {
    const RunRow& run = coach.runs[i];
    draw_run(controls, coach, run);
    if (run.id != opened_) continue;
    static const std::vector<CommentRow> none;
    draw_opened(controls, run, i < coach.comments.size() ? coach.comments[i] : none, out);
  }
}

// A line: when, what, how it ended. A press opens it, or closes it again.
void HistoryView::draw_run(Controls& controls, const CoachView& coach, const RunRow& run) {
  const float em = ui_em(), begin = ImGui::GetCursorPosX(), top = ImGui::GetCursorPosY();
  const float width = ImGui::GetContentRegionAvail().x, height = 2.35f * em;
  ImGui::PushID(static_cast<int>(run.id));
  if (ImGui::Selectable("##run", run.id == opened_, 0, {0.0f, height})) opened_ = run.id == opened_ ? 0 : run.id;
  controls.mark(fmt::format("run: {}", run.id));
  ImGui::PopID();
  const float bottom = ImGui::GetCursorPosY();
  const std::string verdict = verdict_words(run.result);
  const UiFont font = shows_grade(run.result) ? UiFont::title : UiFont::small;
  ImGui::SetCursorPos({begin + 0.2f * em, top});
  controls.line(lesson_title(coach, run.result.lesson), width - 4.4f * em, ink::kText);
  ImGui::SetCursorPos({begin + 0.2f * em, top + 1.15f * em});
  put(local_time_words(run.begun_at), ink::kSoft, UiFont::small);
  ImGui::SetCursorPos({begin + width - width_of(verdict, font) - 0.2f * em, top + 0.1f * em});
  put(verdict, verdict_colour(run.result), font);
  if (shows_grade(run.result)) {
    const char* outcome = run.result.passed ? "passed" : "not passed";
    ImGui::SetCursorPos({begin + width - width_of(outcome, UiFont::small) - 0.2f * em, top + 1.15f * em});
    put(outcome, verdict_colour(run.result), UiFont::small);
  }
  ImGui::SetCursorPos({begin, bottom});
}

void HistoryView::draw_opened(Controls& controls, const RunRow& run, const std::vector<CommentRow>& comments,
                              PanelRequests& out) {
  ImGui::Indent(0.7f * ui_em());
  const char* mode = run.result.mode == LessonMode::follow_me ? "follow me" : "do it yourself";
  put_wrapped(fmt::format("{}, {:.0f} s", mode, run.result.duration), ink::kSoft);
  if (!run.result.why.empty()) put_wrapped(run.result.why, ink::kText);
  draw_faults(run.result, -1);
  ImGui::Spacing();
  if (run.recording.empty() && !run.result.shifts.empty())
    put_wrapped("No look at its shifts: this run was not recorded.", ink::kSoft);
  for (const ShiftRecord& shift : run.result.shifts) draw_shift(controls, run, shift, out.look);
  comments_.draw(controls, run.id, comments, out.lesson);
  ImGui::Unindent(0.7f * ui_em());
  ImGui::Spacing();
  ImGui::Separator();
}

}  // namespace gearshift
