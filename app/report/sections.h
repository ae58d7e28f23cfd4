// The sections of the page. Each returns HTML; what was typed by people or read from files is text in it, never markup.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/report/report_page.h"

namespace gearshift {

std::string head_section(const LearnerHistory& history, std::span<const Lesson> lessons);
std::string progress_section(const LearnerHistory& history, std::span<const Lesson> lessons);
std::string weakness_section(const LearnerHistory& history);
std::string shifts_section(const ShownShifts& shifts, std::span<const Lesson> lessons);
std::string runs_section(const LearnerHistory& history, std::span<const Lesson> lessons);

std::string section(std::string_view id, std::string_view title, const std::string& html);
std::string paragraph(std::string_view text);  // escaped here
std::string run_link(std::int64_t run);        // "Run 12", to its row

}  // namespace gearshift
