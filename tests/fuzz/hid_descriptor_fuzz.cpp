// Fuzzes a device's report descriptor and checks the laws in hid_laws.h: parse_report_descriptor() must reject the
// descriptor or return valid fields. Reports found by find_lever_report() and find_pid() must be encoded and decoded
// within the reports' bytes.
#include <cstdio>
#include <cstdlib>

#include "tests/haptics/hid/hid_laws.h"

using namespace gearshift::test;

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string broken = HidLaws({data, size}).broken_by({data, size});
  if (broken.empty()) return 0;
  std::fprintf(stderr, "%s\n", broken.c_str());
  std::abort();
}
