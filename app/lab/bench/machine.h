// The machine and build that a run was measured with. Runs of different machines or builds are never compared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gearshift::lab {

struct Machine {
  std::string cpu;     // model
  int cores = 0;       // logical
  std::string gpu;     // GPU and driver; empty if there is none
  std::string host;    // name
  std::string system;  // kernel
  std::string compiler, build;
};

Machine this_machine(const std::string& gpu);

// "model name" of the first processor in the text of /proc/cpuinfo; "unknown" if it has none.
std::string cpu_model(std::string_view cpuinfo);

// A hash (16 hexadecimal digits) of everything that makes runs incomparable: processor, cores, GPU, host, build type,
// compiler. Stable between runs; does not reveal the host name.
std::string machine_key(const Machine& machine);

}  // namespace gearshift::lab
