// Ways to find the proxy of a lever that is thrown straight from gear to gear, through every wall between: what each
// costs, and how far it is from the same walk in steps of 20 um.
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "haptics/contact/proxy.h"
#include "tests/bench/bench.h"
#include "tests/bench/ticks.h"
#include "tests/bench/touring.h"

namespace gearshift {
namespace {

using Path = std::vector<glm::dvec2>;

constexpr double kPeriod = 0.001;    // [s]
constexpr double kThrow = 1.0;       // [m/s]
constexpr double kFineStep = 20e-6;  // [m]
constexpr double kLost = 1e-3;       // [m] so far from the truth, the lever is in another place of the gate

Path thrown_lever(const Gate& gate, int throws) {
  std::mt19937_64 random(3);
  const std::vector<int> gears = tour_order(gate);
  Path path{rest_position(gate, kNeutralGear)};
  for (int i = 0; i < throws; ++i) {
    const glm::dvec2 from = path.back(), to = rest_position(gate, gears[random() % gears.size()]);
    const int steps = static_cast<int>(glm::distance(from, to) / (kThrow * kPeriod)) + 1;
    for (int n = 1; n <= steps; ++n) path.push_back(from + (to - from) * (static_cast<double>(n) / steps));
  }
  return path;
}

// The lever of each sample reached in steps of at most `step`.
Path walked(const Gate& gate, const Path& lever, double step) {
  const Passage passage = open_passage(gate);
  Proxy proxy = place_proxy(gate, lever.front());
  Path proxies;
  glm::dvec2 from = lever.front();
  for (const glm::dvec2 to : lever) {
    const int steps = static_cast<int>(std::ceil(glm::distance(from, to) / step - 1e-9));
    for (int n = 1; n <= steps; ++n)
      proxy = move_proxy(gate, passage, proxy, from + (to - from) * (static_cast<double>(n) / steps),
                         kHandOverSpeed * kPeriod / steps);
    proxies.push_back(proxy.position);
    from = to;
  }
  return proxies;
}

// No memory: the point of free space that is nearest.
Path nearest(const Gate& gate, const Path& lever) {
  Path proxies;
  for (const glm::dvec2 at : lever) proxies.push_back(place_proxy(gate, at).position);
  return proxies;
}

struct Way {
  std::string name;
  std::function<Path()> find;
  bool chosen = false;
  std::vector<double> ns = {};
  Path found = {};
};

BenchRow row_of(Way& way, const Path& truth) {
  double sum = 0.0, lost = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double off = glm::distance(way.found[i], truth[i]);
    sum += off;
    lost += off > kLost ? 1.0 : 0.0;
  }
  const auto samples = static_cast<double>(truth.size());
  const Timed ns = timed(way.ns);
  const Beside cost{"cost", ns.median, "ns", ns.spread};
  BenchRow row{"proxy",
               way.name + ": mean distance from a walk in steps of 20 um",
               1e3 * sum / samples,
               "mm",
               {},
               false,
               "paper's gate, thrown from gear to gear at 1 m/s, 1 kHz",
               true,
               {cost, {"farther than 1 mm", 100.0 * lost / samples, "%"}}};
  row.trade = Trade{"a lever thrown through the walls", way.name, cost, {"mean distance", row.value, "mm"}, way.chosen};
  return row;
}

}  // namespace

std::vector<BenchRow> bench_proxy(const BenchOptions& options) {
  const Gate gate = bench_gate(options.gate_folder, "paper");
  const Path lever = thrown_lever(gate, options.quick ? 20 : 200), truth = walked(gate, lever, kFineStep);
  std::vector<Way> ways{{"nearest point of free space", [&] { return nearest(gate, lever); }},
                        {"walk, once a cycle", [&] { return walked(gate, lever, 1.0); }, true},
                        {"walk, steps of 0.2 mm", [&] { return walked(gate, lever, 0.2e-3); }},
                        {"walk, steps of 0.05 mm", [&] { return walked(gate, lever, 0.05e-3); }}};
  for (int round = 0; round < 11; ++round) {  // they alternate, so that a busy machine slows them alike
    for (Way& way : ways) {
      const std::uint64_t before = ticks();
      way.found = way.find();
      way.ns.push_back(static_cast<double>(ticks() - before) / ticks_per_ns() / static_cast<double>(lever.size()));
    }
  }
  std::vector<BenchRow> rows;
  for (Way& way : ways) rows.push_back(row_of(way, truth));
  return rows;
}

}  // namespace gearshift
