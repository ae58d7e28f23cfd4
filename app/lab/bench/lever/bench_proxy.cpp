// Compares methods of finding the proxy while the lever moves straight from gear to gear through all walls: cost, and
// distance from a reference proxy that moves in steps of 20 um.
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "app/lab/bench/lever/touring.h"
#include "app/lab/bench/rows/bench.h"
#include "app/lab/bench/rows/ticks.h"
#include "haptics/contact/proxy.h"

namespace gearshift::lab {
namespace {

using Path = std::vector<glm::dvec2>;

constexpr double kPeriod = 0.001;    // [s]
constexpr double kThrow = 1.0;       // [m/s]
constexpr double kFineStep = 20e-6;  // [m]
constexpr double kFarError = 1e-3;   // [m] a proxy with a larger error is in a different part of the gate

Path thrown_lever(const haptics::Gate& gate, int throws) {
  std::mt19937_64 random(3);
  const std::vector<int> gears = haptics::tour_order(gate);
  Path path{haptics::rest_position(gate, haptics::kNeutralGear)};
  for (int i = 0; i < throws; ++i) {
    const glm::dvec2 from = path.back(), to = haptics::rest_position(gate, gears[random() % gears.size()]);
    const int steps = static_cast<int>(glm::distance(from, to) / (kThrow * kPeriod)) + 1;
    for (int n = 1; n <= steps; ++n) path.push_back(from + (to - from) * (static_cast<double>(n) / steps));
  }
  return path;
}

// Moves the proxy after the lever in steps of at most `step` [m].
Path walked(const haptics::Gate& gate, const Path& lever, double step) {
  const haptics::Passage passage = haptics::open_passage(gate);
  haptics::Proxy proxy = haptics::place_proxy(gate, lever.front());
  Path proxies;
  glm::dvec2 from = lever.front();
  for (const glm::dvec2 to : lever) {
    const int steps = static_cast<int>(std::ceil(glm::distance(from, to) / step - 1e-9));
    for (int n = 1; n <= steps; ++n)
      proxy = haptics::move_proxy(gate, passage, proxy, from + (to - from) * (static_cast<double>(n) / steps),
                                  haptics::kHandOverSpeed * kPeriod / steps);
    proxies.push_back(proxy.position);
    from = to;
  }
  return proxies;
}

// Finds the proxy without its previous position: the point of free space nearest to the lever.
Path nearest(const haptics::Gate& gate, const Path& lever) {
  Path proxies;
  for (const glm::dvec2 at : lever) proxies.push_back(haptics::place_proxy(gate, at).position);
  return proxies;
}

struct ProxyMethod {
  std::string name;
  std::function<Path()> find;
  bool chosen = false;
  std::vector<double> ns = {};
  Path found = {};
};

BenchRow row_of(ProxyMethod& method, const Path& truth) {
  double sum = 0.0, far_off = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double off = glm::distance(method.found[i], truth[i]);
    sum += off;
    far_off += off > kFarError ? 1.0 : 0.0;
  }
  const auto samples = static_cast<double>(truth.size());
  const Timed ns = timed(method.ns);
  const RelatedFigure cost{"cost", ns.median, "ns", ns.spread};
  BenchRow row{"proxy",
               method.name + ": mean distance from a reference walk (20 um steps)",
               1e3 * sum / samples,
               "mm",
               {},
               false,
               "a lever thrown from gear to gear at 1 m/s, paper's gate, 1 kHz",
               true,
               {cost, {"more than 1 mm from the reference", 100.0 * far_off / samples, "%"}}};
  row.trade =
      Trade{"a lever thrown through the walls", method.name, cost, {"mean distance", row.value, "mm"}, method.chosen};
  return row;
}

}  // namespace

std::vector<BenchRow> bench_proxy(const BenchOptions& options) {
  const haptics::Gate gate = bench_gate(options.gate_folder, "paper");
  const Path lever = thrown_lever(gate, options.quick ? 20 : 200), truth = walked(gate, lever, kFineStep);
  std::vector<ProxyMethod> methods{{"nearest point of free space", [&] { return nearest(gate, lever); }},
                                   {"proxy walk, one step per cycle", [&] { return walked(gate, lever, 1.0); }, true},
                                   {"proxy walk, steps of 0.2 mm", [&] { return walked(gate, lever, 0.2e-3); }},
                                   {"proxy walk, steps of 0.05 mm", [&] { return walked(gate, lever, 0.05e-3); }}};
  for (int round = 0; round < 11; ++round) {  // methods run alternately, so that a busy machine slows all equally
    for (ProxyMethod& method : methods) {
      const std::uint64_t before = ticks();
      method.found = method.find();
      method.ns.push_back(static_cast<double>(ticks() - before) / ticks_per_ns() / static_cast<double>(lever.size()));
    }
  }
  std::vector<BenchRow> rows;
  for (ProxyMethod& method : methods) rows.push_back(row_of(method, truth));
  return rows;
}

}  // namespace gearshift::lab
