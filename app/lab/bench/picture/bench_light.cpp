// Measures time and error of the light tables that the renderer computes (bakes) at the start.
#include <cmath>
#include <random>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>

#include "app/lab/bench/picture/hammersley_brdf.h"
#include "app/lab/bench/picture/picture_rig.h"
#include "app/lab/bench/rows/bench.h"
#include "engine/light/environment.h"

namespace gearshift::lab {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kReferenceSamples = 16384;
constexpr int kTruthSamples = 1024;  // per prefiltered texel
constexpr double kPi = 3.14159265358979323846;

struct Error {
  double square = 0.0, worst = 0.0;
  int count = 0;
  void add(double e) {
    square += e * e;
    worst = std::max(worst, std::abs(e));
    ++count;
  }
  double rms() const { return std::sqrt(square / count); }
};

constexpr int kGrid = 20;  // grid cells per axis; errors are computed at the inner grid points

const std::vector<glm::dvec2>& brdf_truth() {
  static const std::vector<glm::dvec2> truth = [] {
    std::vector<glm::dvec2> sums;
    for (int i = 1; i < kGrid; ++i)
      for (int j = 1; j < kGrid; ++j)
        sums.push_back(hammersley_sum(i / double{kGrid}, j / double{kGrid}, kReferenceSamples));
    return sums;
  }();
  return truth;
}

template <class Method>
Error brdf_error(const Method& method) {
  Error error;
  auto truth = brdf_truth().begin();
  for (int i = 1; i < kGrid; ++i) {
    for (int j = 1; j < kGrid; ++j) {
      const glm::dvec2 off = method(i / double{kGrid}, j / double{kGrid}) - *truth++;
      error.add(off.x);
      error.add(off.y);
    }
  }
  return error;
}

// Settings under test, the times for baking with them, and the last result.
template <class Settings, class BakedResult>
struct Baked {
  Settings settings;
  BakedResult result = {};
  std::vector<double> times = {};  // [ms] duration of each bake
};

// Bakes with each of the settings in turn, so that a busy machine slows all of them equally.
template <class Settings, class BakedResult, class Make>
void bake_in_turn(const BenchOptions& options, std::vector<Baked<Settings, BakedResult>>& methods, const Make& make) {
  for (int round = 0; round < (options.quick ? 1 : 9); ++round) {
    for (Baked<Settings, BakedResult>& method : methods) {
      const auto start = Clock::now();
      method.result = make(method.settings);
      method.times.push_back(ms_since(start));
    }
  }
}

struct BrdfSettings {
  int side, samples;
  // True if the renderer uses these settings by default.
  bool is_default() const { return side == engine::kBrdfSide && samples == engine::kBrdfSamples; }
};

// Goal for the default settings: 0.0010, the RMS error of a table that an independent program computed from 1024
// samples (the table's largest error is 0.0055).
BenchRow brdf_row(Baked<BrdfSettings, engine::BrdfTable>& baked) {
  const auto [side, samples] = baked.settings;
  const Timed ms = timed(baked.times);
  const engine::BrdfTable& table = baked.result;
  const Error error = brdf_error([&](double n_dot_v, double roughness) {
    return glm::dvec2(table.sample(static_cast<float>(n_dot_v), static_cast<float>(roughness)));
  });
  BenchRow row{"light",
               fmt::format("environment BRDF, {0}x{0} table, {1} samples: RMS error", side, samples),
               error.rms(),
               "",
               baked.settings.is_default() ? std::optional<double>(0.0010) : std::nullopt,
               false,
               "",
               true,
               {{"worst", error.worst, ""}, {"bake", ms.median, "ms", ms.spread}}};
  row.trade = Trade{"environment BRDF",
                    fmt::format("{0}x{0} table, {1} samples", side, samples),
                    {"bake", ms.median, "ms", ms.spread},
                    {"RMS error", error.rms(), ""},
                    baked.settings.is_default()};
  return row;
}

// An analytic fit without a table. Brian Karis. Physically Based Shading on Mobile. 2014.
glm::dvec2 mobile_fit(double n_dot_v, double roughness) {
  const glm::dvec4 r = roughness * glm::dvec4(-1.0, -0.0275, -0.572, 0.022) + glm::dvec4(1.0, 0.0425, 1.04, -0.04);
  const double a = std::min(r.x * r.x, std::exp2(-9.28 * n_dot_v)) * r.x + r.y;
  return {-1.04 * a + r.z, 1.04 * a + r.w};
}

// The row has no goal and is not compared with the tables. The fit needs no baking, but costs time per pixel.
BenchRow brdf_fit_row() {
  const Error error = brdf_error(mobile_fit);
  return {"light",
          "environment BRDF, analytic fit (Karis 2014): RMS error",
          error.rms(),
          "",
          {},
          false,
          "needs no table but costs time per pixel; shown for information, not compared with the tables",
          true,
          {{"worst", error.worst, ""}}};
}

// Irradiance / pi by midpoint quadrature over the hemisphere around the normal n. Uses no basis functions.
glm::dvec3 irradiance_by_quadrature(const engine::Radiance& radiance, glm::vec3 n, int rings) {
  const glm::vec3 side = glm::normalize(glm::cross(n, std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
  const glm::vec3 other = glm::cross(n, side);
  glm::dvec3 sum(0.0);
  for (int i = 0; i < rings; ++i) {
    const double sin2 = (i + 0.5) / rings;  // uniform steps of sin^2 of the polar angle include the cosine weight
    for (int j = 0; j < 4 * rings; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / (4 * rings);
      const auto r = static_cast<float>(std::sqrt(sin2)), up = static_cast<float>(std::sqrt(1.0 - sin2));
      sum += glm::dvec3(radiance(r * static_cast<float>(std::cos(phi)) * side +
                                 r * static_cast<float>(std::sin(phi)) * other + up * n));
    }
  }
  return sum / (4.0 * rings * rings);
}

engine::Radiance bench_sky() {
  return engine::day_sky(glm::normalize(glm::vec3(0.35f, 0.80f, -0.48f)));
}

BenchRow irradiance_row(Baked<int, engine::Irradiance>& baked) {
  const engine::Radiance sky = bench_sky();
  const int samples = baked.settings;
  const Timed ms = timed(baked.times);
  const engine::Irradiance& fast = baked.result;
  std::mt19937 chance(1);
  std::normal_distribution<float> normal;
  Error relative;
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 n = glm::normalize(glm::vec3(normal(chance), normal(chance), normal(chance)));
    const glm::dvec3 truth = irradiance_by_quadrature(sky, n, 48);
    relative.add(glm::length(glm::dvec3(fast(n)) - truth) / glm::length(truth));
  }
  const RelatedFigure cost{"projection", ms.median, "ms", ms.spread};
  BenchRow row{
      "light",
      fmt::format("irradiance from spherical harmonics of degree 2, {0}x{0} samples per face: RMS error", samples),
      100.0 * relative.rms(),
      "%",
      {},
      false,
      "degree 3 gives the same result, because a cosine lobe has no third band",
      true,
      {{"worst", 100.0 * relative.worst, "%"}, cost}};
  row.trade = Trade{"irradiance from spherical harmonics",
                    fmt::format("{0}x{0} samples per face", samples),
                    cost,
                    {"RMS error", row.value, "%"},
                    samples == engine::kIrradianceSamples};
  return row;
}

// RMS error of all rough mip levels, relative to the reference `truth`, which is computed from many more samples. Skips
// level 0: it is a mirror, for which one sample is exact.
double prefilter_error(const engine::PrefilteredCube& cube, const engine::PrefilteredCube& truth) {
  double off = 0.0, all = 0.0;
  for (std::size_t level = 1; level < cube.levels.size(); ++level) {
    for (std::size_t i = 0; i < cube.levels[level].size(); ++i) {
      const double expected = glm::unpackHalf1x16(truth.levels[level][i]);
      const double actual = glm::unpackHalf1x16(cube.levels[level][i]);
      if (i % 4 == 3) continue;  // alpha
      off += (actual - expected) * (actual - expected);
      all += expected * expected;
    }
  }
  return std::sqrt(off / all);
}

BenchRow prefilter_row(Baked<int, engine::PrefilteredCube>& baked, const engine::PrefilteredCube& truth) {
  const int samples = baked.settings;
  const Timed ms = timed(baked.times);
  const engine::PrefilteredCube& cube = baked.result;
  const double error = 100.0 * prefilter_error(cube, truth);
  BenchRow row{"light",
               fmt::format("prefiltered reflections, 64^2 x 6 x {} levels, {} samples", cube.levels.size(), samples),
               ms.median,
               "ms",
               {},
               false,
               "",
               true,
               {{"RMS error", error, "%"}}};
  row.trade = Trade{"prefiltered reflections",
                    fmt::format("{} samples", samples),
                    {"bake", ms.median, "ms", ms.spread},
                    {fmt::format("RMS error against {} samples", kTruthSamples), error, "%"},
                    samples == engine::kPrefilterSamples};
  return with_spread(ms.spread, std::move(row));
}

void add_brdf(std::vector<BenchRow>& rows, const BenchOptions& options) {
  std::vector<Baked<BrdfSettings, engine::BrdfTable>> methods;
  for (const int samples : {16, 64, 128, 256, 1024}) methods.push_back({{64, samples}});
  for (const int samples : {64, 128, 256}) methods.push_back({{32, samples}});
  bake_in_turn(options, methods,
               [](const BrdfSettings& method) { return engine::bake_brdf(method.side, method.samples); });
  for (auto& method : methods) rows.push_back(brdf_row(method));
}

void add_irradiance(std::vector<BenchRow>& rows, const BenchOptions& options) {
  std::vector<Baked<int, engine::Irradiance>> methods{{8}, {32}, {64}};
  bake_in_turn(options, methods, [sky = bench_sky()](int samples) { return engine::project_irradiance(sky, samples); });
  for (auto& method : methods) rows.push_back(irradiance_row(method));
}

void add_reflections(std::vector<BenchRow>& rows, const BenchOptions& options) {
  constexpr int kSide = 64, kLevels = 6;
  const engine::PrefilteredCube truth = engine::prefilter(bench_sky(), kSide, kLevels, kTruthSamples);
  std::vector<Baked<int, engine::PrefilteredCube>> methods{{16}, {64}, {256}};
  bake_in_turn(options, methods,
               [sky = bench_sky()](int samples) { return engine::prefilter(sky, kSide, kLevels, samples); });
  for (auto& method : methods) rows.push_back(prefilter_row(method, truth));
}

}  // namespace

std::vector<BenchRow> bench_light(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  add_brdf(rows, options);
  rows.push_back(brdf_fit_row());
  add_irradiance(rows, options);
  add_reflections(rows, options);
  return rows;
}

}  // namespace gearshift::lab
