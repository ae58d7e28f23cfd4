// The sections of the page, as HTML. Text typed by users or read from files is escaped.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/lessons/report/report_page.h"
#include "app/lessons/report/standing.h"

namespace gearshift::lessons {

std::string head_section(const LearnerHistory& history, std::span<const Lesson> lessons);
std::string standing_section(const LearnerHistory& history, std::span<const Lesson> lessons);
// Rows of a table.standings: task, standing, reason, advice. A sentence on the learning curve ends the reason if there
// is a curve and `with_curve` is set.
std::string standing_rows(const LearnerHistory& history, std::span<const TaskStanding> tasks,
                          std::span<const Lesson> lessons, bool with_curve);
std::string progress_section(const LearnerHistory& history, std::span<const Lesson> lessons);
std::string weakness_section(const LearnerHistory& history);
std::string shifts_section(const ShownShifts& shifts, std::span<const Lesson> lessons);
std::string runs_section(const LearnerHistory& history, std::span<const Lesson> lessons);

std::string page_begin(std::string_view title);  // head with the style sheet; escapes the title
std::string page_end();                          // the program's version, and what times and grades mean
std::string section(std::string_view id, std::string_view title, const std::string& html);
std::string paragraph(std::string_view text);  // escapes the text
std::string run_link(std::int64_t run);        // "Run 12", linked to its row

}  // namespace gearshift::lessons
