// CPU contention: how much processor time the host and other programs used during a run. Shown on the bench page.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearshift::lab {

// Processor time since boot, summed over all processors. [s]
struct ProcessorTime {
  double all = 0.0;
  double host = 0.0;  // "steal": time in which the virtual machine's host ran something else
  double used = 0.0;  // by all programs
  double own = 0.0;   // by this program and its child processes
};

struct CpuContention {
  double by_host = 0.0, by_programs = 0.0;  // [1] fractions of the processor time
};

// Parses the first line of /proc/stat, which counts in ticks (`ticks` per second, see proc(5)). Empty if the line has a
// different format. Leaves `own` at 0.
std::optional<ProcessorTime> processor_time(std::string_view stat, double ticks);

std::optional<ProcessorTime> processor_time_now();

// Empty if either time is missing or no time has passed.
std::optional<CpuContention> cpu_contention(const std::optional<ProcessorTime>& begin,
                                            const std::optional<ProcessorTime>& end);

std::string format_contention(const CpuContention& contention);  // "3 % by the host, 0 % by other programs"

}  // namespace gearshift::lab
