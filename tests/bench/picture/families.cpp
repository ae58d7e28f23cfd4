#include "tests/bench/bench.h"

namespace gearshift {

const std::vector<NamedFamily>& bench_families() {
  static const std::vector<NamedFamily> families{
      {"cycle", bench_cycle},         {"headless", bench_headless}, {"plant", bench_plant},
      {"feel", bench_feel},           {"contact", bench_contact},   {"energy", bench_energy},
      {"delivered", bench_delivered}, {"boundary", bench_boundary}, {"methods", bench_methods},
      {"hard", bench_hard},           {"faults", bench_faults},     {"intent", bench_intent},
      {"driveline", bench_driveline}, {"learning", bench_learning}, {"picture", bench_picture},
      {"quality", bench_quality},     {"light", bench_light},       {"jitter", bench_jitter},
      {"beside", bench_beside}};
  return families;
}

}  // namespace gearshift
