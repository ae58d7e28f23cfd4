// What of the processors the host and other programs took while figures were taken: the page says so beside them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearshift {

// Since some moment in the past, of all processors together [s].
struct ProcessorTime {
  double all = 0.0;
  double host = 0.0;  // not given to this machine: "steal", on a machine that is rented
  double used = 0.0;  // by every program
  double own = 0.0;   // by this one and the programs that it ran
};

struct TakenElsewhere {
  double by_host = 0.0, by_programs = 0.0;  // [1] of the processors' time, 0 to 1
};

// The first line of /proc/stat's text, whose unit is 1 / ticks [s] (proc(5)); nothing where it is another. own is left 0.
std::optional<ProcessorTime> processor_time(std::string_view stat, double ticks);

std::optional<ProcessorTime> processor_time_now();

// Nothing where one is missing, or no time went by.
std::optional<TakenElsewhere> taken_elsewhere(const std::optional<ProcessorTime>& begin,
                                              const std::optional<ProcessorTime>& end);

std::string taken_words(const TakenElsewhere& taken);  // "3 % by the host, 0 % by other programs"

}  // namespace gearshift
