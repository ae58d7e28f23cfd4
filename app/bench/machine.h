// On which machine and by which kind of build figures were taken: figures of two are never compared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gearshift {

struct Machine {
  std::string cpu;     // model
  int cores = 0;       // logical
  std::string gpu;     // device and driver; empty where there is none
  std::string host;    // name
  std::string system;  // kernel
  std::string compiler, build;
};

Machine this_machine(const std::string& gpu);

// "model name" of the first processor in /proc/cpuinfo's text; "unknown" where it has none.
std::string cpu_model(std::string_view cpuinfo);

// 16 hexadecimal digits of what makes figures incomparable: processor, cores, GPU, host, build type, compiler. The
// same in every run of the program; the host's name cannot be read from it.
std::string machine_key(const Machine& machine);

}  // namespace gearshift
