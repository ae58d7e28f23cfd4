#include "app/ui/panel/history_view.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/lessons/assessment/grade.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

constexpr double kMinShownTime = 0.005;  // [s] times shorter than this are not shown

// Describes clutch timing and rev match, the first things that grading checks.
std::string describe_clutch_timing(const lessons::ShiftRecord& shift) {
  if (shift.to == haptics::kNeutralGear) return "no gear engaged";
  const char* when = shift.clutch_lag < 0.0 ? "before" : "after";
  return fmt::format("clutch released {:.2f} s {} the gear engaged; revs off by {}", std::abs(shift.clutch_lag), when,
                     format_rpm(std::abs(shift.rev_error)));
}

std::string describe_resistance(const lessons::ShiftRecord& shift) {
  std::string words;
  if (shift.block_time > kMinShownTime)
    words = fmt::format("blocked by the synchroniser for {:.2f} s", shift.block_time);
  if (shift.grind_time > kMinShownTime)
    words += fmt::format("{}gears ground for {:.2f} s ({:.1f} J)", words.empty() ? "" : ", ", shift.grind_time,
                         shift.grind_energy);
  return words;
}

void draw_driving_errors(const lessons::LessonResult& result, std::int64_t shift) {
  ErrorKinds advised;
  for (const lessons::DrivingError& error : result.errors) {
    if (error.shift != shift) continue;
    const bool costs = error.points > 0.0 && lessons::is_graded(result);
    const std::string cost = costs ? fmt::format(" (-{:.1f})", error.points) : std::string();
    put_wrapped(lessons::error_sentence(error) + cost, severity_colour(error.severity));
    if (const std::string_view advice = take_advice(error, advised); !advice.empty()) put_wrapped(advice, ink::kAccent);
  }
}

void draw_shift(Controls& controls, const lessons::RunRow& run, const lessons::ShiftRecord& shift, PanelCommands& out) {
  const std::string name = fmt::format("look: {} {}", run.id, shift.number);
  put(format_gears(shift), shift.missed ? ink::kBad : ink::kText, engine::UiFont::title);
  ImGui::SameLine();
  put(fmt::format("{:.2f} s{}", shift.end - shift.begin, shift.missed ? ", missed" : ""), ink::kSoft,
      engine::UiFont::small);
  {
    const engine::WithFont small(engine::UiFont::small);
    align_right(button_width("Watch"));
    ImGui::BeginDisabled(run.recording.empty());
    if (controls.button(name.c_str(), "Watch")) out.push_back(OpenShift{run.recording, shift.begin});
    ImGui::EndDisabled();
  }
  put_wrapped(describe_clutch_timing(shift), ink::kSoft);
  const std::string resistance = describe_resistance(shift);
  if (!resistance.empty()) put_wrapped(resistance, ink::kSoft);
  draw_driving_errors(run.result, shift.number);
  ImGui::Spacing();
}

}  // namespace

void HistoryView::draw(Controls& controls, const lessons::CoachView& coach, PanelCommands& out) {
  if (coach.runs.empty()) {
    put_wrapped(coach.learner.empty() ? "Choose a learner to see their history." : "You haven't driven a lesson yet.",
                ink::kSoft);
    return;
  }
  ImGui::Spacing();
  put(fmt::format("Times are local ({}).", format_time_zone(std::time(nullptr))), ink::kSoft, engine::UiFont::small);
  const std::span<const lessons::RunRow> runs = coach.runs;
  const auto opened = std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run.id == opened_; });
  if (opened == runs.end()) return draw_runs(controls, coach, runs);
  const auto index = static_cast<std::size_t>(opened - runs.begin());
  draw_runs(controls, coach, runs.first(index + 1));
  draw_opened(controls, *opened, out);
  draw_runs(controls, coach, runs.subspan(index + 1));
}

// Draws the lines of those runs that are not scrolled out of view.
void HistoryView::draw_runs(Controls& controls, const lessons::CoachView& coach,
                            std::span<const lessons::RunRow> runs) {
  ImGuiListClipper visible;
  visible.Begin(static_cast<int>(runs.size()));
  while (visible.Step())
    for (int i = visible.DisplayStart; i < visible.DisplayEnd; ++i)
      draw_run(controls, coach, runs[static_cast<std::size_t>(i)]);
}

// Draws one line for a run: lesson, time and outcome. A click on it shows or hides the run's details.
void HistoryView::draw_run(Controls& controls, const lessons::CoachView& coach, const lessons::RunRow& run) {
  const float em = engine::ui_em(), begin = ImGui::GetCursorPosX(), top = ImGui::GetCursorPosY();
  const float width = ImGui::GetContentRegionAvail().x, height = 2.35f * em;
  ImGui::PushID(static_cast<int>(run.id));
  if (ImGui::Selectable("##run", run.id == opened_, 0, {0.0f, height})) opened_ = run.id == opened_ ? 0 : run.id;
  controls.mark(fmt::format("run: {}", run.id));
  ImGui::PopID();
  const float bottom = ImGui::GetCursorPosY();
  const std::string verdict = format_verdict(run.result);
  const engine::UiFont font = lessons::is_graded(run.result) ? engine::UiFont::title : engine::UiFont::small;
  ImGui::SetCursorPos({begin + 0.2f * em, top});
  controls.line(lesson_title(coach, run.result.lesson), width - 4.4f * em, ink::kText);
  ImGui::SetCursorPos({begin + 0.2f * em, top + 1.15f * em});
  put(format_local_time(run.begun_at), ink::kSoft, engine::UiFont::small);
  ImGui::SetCursorPos({begin + width - width_of(verdict, font) - 0.2f * em, top + 0.1f * em});
  put(verdict, verdict_colour(run.result), font);
  if (lessons::is_graded(run.result)) {
    const bool is_old = run.result.grading == lessons::Grading::old_rule;
    const char* outcome =
        run.result.passed ? (is_old ? "passed, old rule" : "passed") : (is_old ? "not passed, old rule" : "not passed");
    ImGui::SetCursorPos({begin + width - width_of(outcome, engine::UiFont::small) - 0.2f * em, top + 1.15f * em});
    put(outcome, verdict_colour(run.result), engine::UiFont::small);
  }
  ImGui::SetCursorPos({begin, bottom});
}

void HistoryView::draw_opened(Controls& controls, const lessons::RunRow& run, PanelCommands& out) {
  ImGui::Indent(0.7f * engine::ui_em());
  const char* mode = run.result.mode == lessons::LessonMode::follow_me ? "Follow me" : "Do it yourself";
  put_wrapped(fmt::format("{}, {:.0f} s", mode, run.result.duration), ink::kSoft);
  if (!run.result.why.empty()) put_wrapped(run.result.why, ink::kText);
  draw_driving_errors(run.result, -1);
  ImGui::Spacing();
  if (run.recording.empty() && !run.result.shifts.empty())
    put_wrapped(run.kept_at.empty() ? "No replay: this run was not recorded."
                                    : "No replay: the recording is on another seat: " + run.kept_at,
                ink::kSoft);
  for (const lessons::ShiftRecord& shift : run.result.shifts) draw_shift(controls, run, shift, out);
  comments_.draw(controls, run.id, run.comments, out);
  ImGui::Unindent(0.7f * engine::ui_em());
  ImGui::Spacing();
  ImGui::Separator();
}

}  // namespace gearshift::ui
