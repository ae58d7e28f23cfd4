// The sections of the page, as HTML. Text typed by users or read from files is escaped.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/lessons/report/report_page.h"

namespace gearshift::lessons {

std::string head_section(const LearnerHistory& history, std::span<const Lesson> lessons);
std::string progress_section(const LearnerHistory& history, std::span<const Lesson> lessons);
std::string weakness_section(const LearnerHistory& history);
std::string shifts_section(const ShownShifts& shifts, std::span<const Lesson> lessons);
std::string runs_section(const LearnerHistory& history, std::span<const Lesson> lessons);

std::string section(std::string_view id, std::string_view title, const std::string& html);
std::string paragraph(std::string_view text);  // escapes the text
std::string run_link(std::int64_t run);        // "Run 12", linked to its row

}  // namespace gearshift::lessons
