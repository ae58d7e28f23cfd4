#include "app/lab/bench/cpu_contention.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>

namespace gearshift::lab {
namespace {

double seconds_of(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

std::optional<ProcessorTime> processor_time(std::string_view stat, double ticks) {
  std::istringstream line{std::string(stat.substr(0, stat.find('\n')))};
  std::string name;
  double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, wait = 0.0, irq = 0.0, soft_irq = 0.0, steal = 0.0;
  if (!(line >> name >> user >> nice >> system >> idle >> wait >> irq >> soft_irq >> steal) || name != "cpu") {
    return std::nullopt;
  }
  const double used = user + nice + system + irq + soft_irq;
  return ProcessorTime{.all = (used + idle + wait + steal) / ticks, .host = steal / ticks, .used = used / ticks};
}

std::optional<ProcessorTime> processor_time_now() {
  std::ifstream file("/proc/stat");
  std::string line;
  std::getline(file, line);
  std::optional<ProcessorTime> now = processor_time(line, static_cast<double>(sysconf(_SC_CLK_TCK)));
  if (now) now->own = seconds_of(RUSAGE_SELF) + seconds_of(RUSAGE_CHILDREN);
  return now;
}

std::optional<CpuContention> cpu_contention(const std::optional<ProcessorTime>& begin,
                                            const std::optional<ProcessorTime>& end) {
  if (!begin || !end || end->all <= begin->all) return std::nullopt;
  const double all = end->all - begin->all;
  const double by_programs = end->used - begin->used - (end->own - begin->own);
  return CpuContention{.by_host = std::clamp((end->host - begin->host) / all, 0.0, 1.0),
                       .by_programs = std::clamp(by_programs / all, 0.0, 1.0)};
}

std::string format_contention(const CpuContention& contention) {
  return fmt::format("{:.0f} % by the host, {:.0f} % by other programs", 100.0 * contention.by_host,
                     100.0 * contention.by_programs);
}

}  // namespace gearshift::lab
