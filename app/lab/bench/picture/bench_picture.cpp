// Measures the render time of the cabin per pass, the render time of many untextured triangles, and the time to the
// first frame.
#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <glm/trigonometric.hpp>

#include "app/cabin/stage/stage.h"
#include "app/lab/bench/picture/picture_rig.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

using Clock = std::chrono::steady_clock;

// Goal: the longest render time of pbrbasic, a different renderer. On a comparable machine it draws 221,000 untextured
// GGX triangles in 74 to 104 ms.
constexpr double kPbrBasic = 104.0;  // [ms]
constexpr int kSpheres = 20;
constexpr int kRings = 75, kSegments = 75;  // 20 spheres x 75 x 74 x 2 = 222,000 triangles

// View from the driver's seat, slightly downwards. Road, steering wheel, dashboard and interior mirror are visible.
engine::EyePose mirror_view(const cabin::Stage& stage) {
  const glm::dvec3 eye = stage.driver_eye().position;
  return engine::look_at(eye, eye + glm::dvec3(0.05, -0.10, -1.0));
}

// Total duration of one start, and durations of its parts. [ms]
struct Start {
  double all = 0.0, models = 0.0, device = 0.0, lights = 0.0, upload = 0.0, frame = 0.0;
  std::string gpu;
};

Start start_once(const BenchOptions& options) {
  const auto start = Clock::now();
  const cabin::StageConfig config = paper_cabin(options);
  cabin::Stage stage(config, options.model_folder);
  const double models = ms_since(start);
  engine::Gpu gpu({});
  const double device = ms_since(start);
  const engine::RenderConfig render;
  engine::Renderer renderer(gpu, render);
  const double lights = ms_since(start);
  renderer.set_model(stage.model());
  stage.place(in_first_gear(config.gate));
  const double upload = ms_since(start);
  const engine::View view = symmetric_view(stage.driver_eye(), render);
  gpu.wait(renderer.draw(stage.scene(), {&view, 1}));
  const double all = ms_since(start);
  return {all, models, device - models, lights - device, upload - lights, all - upload, gpu.traits().name};
}

// The row's related figures are the durations of the last start's parts.
BenchRow first_frame(const BenchOptions& options) {
  std::vector<double> starts;
  Start last;
  for (int i = 0; i < (options.quick ? 1 : 7); ++i) {
    last = start_once(options);
    starts.push_back(last.all);
  }
  const Timed all = timed(starts);
  return answers_design(Design::first_frame,
                        with_spread(all.spread, {"picture",
                                                 "start to first frame, cabin loaded, no pipeline cache",
                                                 all.median,
                                                 "ms",
                                                 1000.0,
                                                 false,
                                                 last.gpu,
                                                 true,
                                                 {{"models", last.models, "ms"},
                                                  {"device", last.device, "ms"},
                                                  {"lights and pipelines", last.lights, "ms"},
                                                  {"upload", last.upload, "ms"},
                                                  {"frame", last.frame, "ms"}}}));
}

std::vector<RelatedFigure> passes(const FrameCost& cost) {
  return {{"shadow", cost.gpu.shadow, "ms"},
          {"depth", cost.gpu.depth, "ms"},
          {"mirror", cost.gpu.mirror, "ms"},
          {"main", cost.gpu.main, "ms"},
          {"GPU in total", cost.gpu.all, "ms"}};
}

struct CabinCase {
  std::string name;
  engine::RenderConfig render;
  std::optional<double> goal;
  engine::EyePose eye;
  double field = 1.0;  // [rad] vertical
};

BenchRow cabin_row(const BenchOptions& options, engine::Gpu& gpu, engine::Renderer& renderer, const cabin::Stage& stage,
                   const CabinCase& cabin_case) {
  renderer.resize(cabin_case.render);
  const engine::Fov centre =
      engine::symmetric_fov(cabin_case.field, static_cast<double>(cabin_case.render.width) / cabin_case.render.height);
  const engine::StereoEyes eyes = engine::stereo_eyes(cabin_case.eye, centre, 0.063, 2.0);
  std::vector<engine::View> views{symmetric_view(cabin_case.eye, cabin_case.render, cabin_case.field)};
  if (cabin_case.render.eyes == 2)
    views = {engine::view_from(eyes.pose[0], eyes.fov[0], 0.05), engine::view_from(eyes.pose[1], eyes.fov[1], 0.05)};
  const FrameCost cost =
      time_frames(gpu, renderer, stage.scene(), views, options.quick ? 2 : 25, options.quick ? 1 : 3);
  BenchRow row{"picture", cabin_case.name, cost.host.median, "ms", cabin_case.goal, false, "", true, passes(cost)};
  if (cabin_case.goal) row.design = Design::cabin;
  row.related.push_back({"draw calls", static_cast<double>(renderer.draws()), ""});
  return with_spread(cost.host.spread, std::move(row));
}

std::vector<BenchRow> cabin_rows(const BenchOptions& options) {
  const cabin::StageConfig config = paper_cabin(options);
  cabin::Stage stage(config, options.model_folder);
  stage.place(in_first_gear(config.gate));
  engine::Gpu gpu({});
  engine::RenderConfig plain, smooth, stereo;
  engine::Renderer renderer(gpu, plain);
  renderer.set_model(stage.model());
  smooth.samples = 4;
  stereo.eyes = 2;
  stereo.width = 640;
  const engine::EyePose mirror_eye = mirror_view(stage);
  std::vector<BenchRow> rows;
  for (const CabinCase& cabin_case :
       {CabinCase{"cabin 1280x720, 1x, shadow and mirror", plain, 60.0, mirror_eye},
        CabinCase{"cabin 1280x720, 1x, as the driver sees it", plain, 60.0, stage.driver_eye(),
                  glm::radians(cabin::camera_field("driver"))},
        CabinCase{"cabin 1280x720, 4x", smooth, {}, mirror_eye},
        CabinCase{"cabin 2 x 640x720, 1x, both eyes in one pass if supported", stereo, {}, mirror_eye}})
    rows.push_back(cabin_row(options, gpu, renderer, stage, cabin_case));
  rows[0].related.push_back({"triangles", static_cast<double>(stage.model().triangle_count()), ""});
  return rows;
}

void add_sphere(engine::Model& model, glm::vec3 centre, float radius) {
  const auto first = static_cast<std::uint32_t>(model.vertices.size());
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int segment = 0; segment <= kSegments; ++segment) {
      const float v = 3.14159265f * static_cast<float>(ring) / kRings;
      const float u = 6.28318531f * static_cast<float>(segment) / kSegments;
      engine::Vertex vertex;
      vertex.normal = {std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u)};
      vertex.position = centre + radius * vertex.normal;
      model.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t segment = 0; segment < kSegments; ++segment) {
      const std::uint32_t a = first + ring * (kSegments + 1) + segment, b = a + kSegments + 1;
      if (ring > 0) model.indices.insert(model.indices.end(), {a, a + 1, b + 1});
      if (ring + 1 < kRings) model.indices.insert(model.indices.end(), {a, b + 1, b});
    }
  }
}

engine::Model many_spheres() {
  engine::Model model;
  for (int i = 0; i < kSpheres; ++i) {
    const int column = i % 5, row = i / 5;
    add_sphere(model, {1.1f * (static_cast<float>(column) - 2.0f), 1.1f * (static_cast<float>(row) - 1.5f), 0.0f},
               0.5f);
  }
  engine::Primitive all;
  all.index_count = static_cast<std::uint32_t>(model.indices.size());
  all.material = 0;
  all.low = glm::vec3(-3.0f);
  all.high = glm::vec3(3.0f);
  model.materials.emplace_back();
  model.materials[0].roughness = 0.4f;
  model.meshes.push_back({"Spheres", {all}, 0, static_cast<std::uint32_t>(model.vertices.size())});
  model.nodes.emplace_back();
  model.nodes[0].mesh = 0;
  return model;
}

BenchRow many_triangles(const BenchOptions& options) {
  engine::Gpu gpu({});
  engine::RenderConfig config;
  config.shadow_side = 0;
  engine::Renderer renderer(gpu, config);
  const engine::Model model = many_spheres();
  renderer.set_model(model);
  const engine::View view = symmetric_view(engine::look_at({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}), config);
  const FrameCost cost =
      time_frames(gpu, renderer, rest_scene(model), {&view, 1}, options.quick ? 2 : 25, options.quick ? 1 : 3);
  BenchRow row{"picture",
               fmt::format("{} untextured GGX triangles, 1280x720, 1x", model.triangle_count()),
               cost.host.median,
               "ms",
               kPbrBasic,
               false,
               "goal: the longest time measured with the pbrbasic sample",
               true,
               {{"GPU", cost.gpu.all, "ms"}}};
  return answers_design(Design::cabin, with_spread(cost.host.spread, std::move(row)));
}

}  // namespace

std::vector<BenchRow> bench_picture(const BenchOptions& options) {
  std::vector<BenchRow> rows{first_frame(options)};
  for (BenchRow& row : cabin_rows(options)) rows.push_back(std::move(row));
  rows.push_back(many_triangles(options));
  return rows;
}

}  // namespace gearshift::lab
