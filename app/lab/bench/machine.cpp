#include "app/lab/bench/machine.h"

#include <sys/utsname.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <thread>

#include <fmt/format.h>

#include "haptics/files/fnv_1a.h"

namespace gearshift::lab {
namespace {

std::string compiler_version() {
#if defined(__clang__)
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

std::string cpu_model(std::string_view cpuinfo) {
  const std::size_t key = cpuinfo.find("model name");
  const std::size_t colon = key == std::string_view::npos ? key : cpuinfo.find(": ", key);
  if (colon == std::string_view::npos) return "unknown";
  const std::string_view rest = cpuinfo.substr(colon + 2);
  return std::string(rest.substr(0, rest.find('\n')));
}

Machine this_machine(const std::string& gpu) {
  std::ifstream file("/proc/cpuinfo");
  const std::string cpuinfo{std::istreambuf_iterator<char>(file), {}};
  utsname names{};
  uname(&names);
  return {.cpu = cpu_model(cpuinfo),
          .cores = static_cast<int>(std::thread::hardware_concurrency()),
          .gpu = gpu,
          .host = names.nodename,
          .system = fmt::format("{} {}", names.sysname, names.release),
          .compiler = compiler_version(),
          .build = GEARSHIFT_BUILD_TYPE};
}

std::string machine_key(const Machine& m) {
  return fmt::format("{:016x}", haptics::fnv_1a(fmt::format("{}\n{}\n{}\n{}\n{}\n{}", m.cpu, m.cores, m.gpu, m.host,
                                                            m.build, m.compiler)));
}

}  // namespace gearshift::lab
