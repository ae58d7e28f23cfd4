// Measures how much processor time the host and other programs used during a run. Shown on the bench page.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearshift::lab {

// Processor time since boot [s], summed over all processors.
struct ProcessorTime {
  double all = 0.0;
  double host = 0.0;  // "steal": the host of this virtual machine ran something else
  double used = 0.0;  // used by all programs
  double own = 0.0;   // used by this program and its child processes
};

struct CpuContention {
  double by_host = 0.0, by_programs = 0.0;  // [1] fractions of the total processor time
};

// Parses the first line of /proc/stat, which counts in ticks (see proc(5)). `ticks`: ticks per second. Returns empty if
// the line has a different format. Does not set `own`.
std::optional<ProcessorTime> processor_time(std::string_view stat, double ticks);

std::optional<ProcessorTime> processor_time_now();

// Returns empty if `begin` or `end` is missing, or if no time passed between the two.
std::optional<CpuContention> cpu_contention(const std::optional<ProcessorTime>& begin,
                                            const std::optional<ProcessorTime>& end);

std::string format_contention(const CpuContention& contention);  // "3 % by the host, 0 % by other programs"

}  // namespace gearshift::lab
