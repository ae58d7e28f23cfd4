#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

const std::vector<NamedFamily>& bench_families() {
  static const std::vector<NamedFamily> families{{"cycle", bench_cycle, {Design::cycle}},
                                                 {"headless", bench_headless, {Design::headless}},
                                                 {"plant", bench_plant, {Design::plant}},
                                                 {"feel", bench_feel, {Design::delivered}},
                                                 {"proxy", bench_proxy},
                                                 {"contact", bench_contact, {Design::wall}},
                                                 {"energy", bench_energy, {Design::energy}},
                                                 {"delivered", bench_delivered, {Design::delivered}},
                                                 {"boundary", bench_boundary, {Design::boundary}},
                                                 {"methods", bench_methods},
                                                 {"search", bench_search},
                                                 {"hard", bench_hard},
                                                 {"faults", bench_faults},
                                                 {"intent", bench_intent, {Design::intent}},
                                                 {"driveline", bench_driveline, {Design::driveline}},
                                                 {"learning", bench_learning},
                                                 {"score", bench_score, {Design::score}},
                                                 {"picture", bench_picture, {Design::first_frame, Design::cabin}},
                                                 {"quality", bench_quality, {Design::projected}},
                                                 {"light", bench_light},
                                                 {"jitter", bench_jitter, {Design::jitter}},
                                                 {"beside", bench_beside, {Design::jitter}}};
  return families;
}

}  // namespace gearshift::lab
