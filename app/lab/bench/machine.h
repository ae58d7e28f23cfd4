// The machine and build with which a run was measured. Only runs with equal machine and build are compared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gearshift::lab {

struct Machine {
  std::string cpu;     // model
  int cores = 0;       // logical
  std::string gpu;     // GPU and driver; empty if there is no GPU
  std::string host;    // name
  std::string system;  // kernel
  std::string compiler, build;
};

Machine this_machine(const std::string& gpu);

// Returns the field "model name" of the first processor in the text of /proc/cpuinfo, or "unknown" if that field is
// missing.
std::string cpu_model(std::string_view cpuinfo);

// Hash (16 hexadecimal digits) of everything that makes runs incomparable: processor, cores, GPU, host, build type,
// compiler. The hash is stable between runs and does not reveal the host name.
std::string machine_key(const Machine& machine);

}  // namespace gearshift::lab
