// Measures speed and error of rendering: anti-aliasing, shadow map, mirror, projected points.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/cabin/stage/stage.h"
#include "app/lab/bench/picture/picture_rig.h"
#include "app/lab/bench/rows/bench.h"
#include "engine/image/flip.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::lab {
namespace {

constexpr int kWidth = 640, kHeight = 360;  // [px]

// Draws all pictures with one renderer, whose configuration changes.
struct PaperCabin {
  explicit PaperCabin(const BenchOptions& options)
      : stage(config(options), options.model_folder), renderer(gpu, engine::RenderConfig{}) {
    renderer.set_model(stage.model());
    cabin::StageInput input;
    input.lever.gear = input.car.gear = 1;
    input.lever.lever = input.lever.proxy = haptics::rest_position(gate, 1);
    stage.place(input);
  }
  cabin::StageConfig config(const BenchOptions& options) {
    cabin::StageConfig cabin;
    const haptics::GateLayout layout = haptics::read_gate_layout(options.gate_folder + "/paper.toml");
    cabin.gate = gate = haptics::compile_gate(layout, haptics::workspace_half_extent(cabin.yoke), cabin.yoke.radius);
    return cabin;
  }
  haptics::Gate gate;
  cabin::Stage stage;
  engine::Gpu gpu{{}};
  engine::Renderer renderer;
};

engine::RenderConfig sized(int scale, int samples) {
  engine::RenderConfig config;
  config.width = scale * kWidth;
  config.height = scale * kHeight;
  config.samples = samples;
  return config;
}

double linear(std::uint8_t value) {
  static const std::array<double, 256> of_value = [] {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double s = static_cast<double>(i) / 255.0;
      table[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    return table;
  }();
  return of_value[value];
}

std::uint8_t srgb(double value) {
  const double s = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(s, 0.0, 1.0)));
}

// Averages each block of `scale` x `scale` pixels in linear light.
engine::Image shrunk(const engine::Image& picture, int scale) {
  engine::Image out;
  out.width = picture.width / scale;
  out.height = picture.height / scale;
  out.rgba.assign(4 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), 255);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        double sum = 0.0;
        for (int dy = 0; dy < scale; ++dy)
          for (int dx = 0; dx < scale; ++dx) sum += linear(picture.pixel(x * scale + dx, y * scale + dy)[channel]);
        out.pixel(x, y)[channel] = srgb(sum / (scale * scale));
      }
    }
  }
  return out;
}

struct RenderMethod {
  engine::RenderConfig config;
  int reduction_factor = 1;  // factor by which the CPU shrinks the picture; the shrinking is part of the cost
};

struct TimedCapture {
  engine::Image picture;
  Timed ms, reduction;  // ms: frame including shrinking; reduction: shrinking only
  RelatedFigure frame() const { return {"frame", ms.median, "ms", ms.spread}; }
};

// Draws one frame with each method in turn, so that a busy machine slows all of them equally.
std::vector<TimedCapture> capture_in_turn(PaperCabin& cabin, const std::vector<RenderMethod>& methods,
                                          const engine::View& view, int frames) {
  std::vector<TimedCapture> captures(methods.size());
  std::vector<std::vector<double>> ms(methods.size()), reductions(methods.size());
  for (int round = 0; round < frames; ++round) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      cabin.renderer.resize(methods[i].config);
      const FrameCost cost = time_frames(cabin.gpu, cabin.renderer, cabin.stage.scene(), {&view, 1}, 1, 1);
      captures[i].picture = cabin.renderer.read_eye(0);
      const auto start = std::chrono::steady_clock::now();
      if (methods[i].reduction_factor > 1)
        captures[i].picture = shrunk(captures[i].picture, methods[i].reduction_factor);
      reductions[i].push_back(ms_since(start));
      ms[i].push_back(cost.host.median + reductions[i].back());
    }
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {
    captures[i].ms = timed(ms[i]);
    captures[i].reduction = timed(reductions[i]);
  }
  return captures;
}

engine::Image picture_of(PaperCabin& cabin, const RenderMethod& method, const engine::View& view) {
  return capture_in_turn(cabin, {method}, view, 1).front().picture;
}

std::vector<BenchRow> anti_aliasing_rows(const BenchOptions& options, PaperCabin& cabin) {
  const engine::View view = symmetric_view(cabin.stage.driver_eye(), sized(1, 1));
  const int frames = options.quick ? 2 : 9;
  const int fine = options.quick ? 4 : 8;  // number of samples per pixel in each direction
  const engine::Image reference = picture_of(cabin, {sized(fine, 1), fine}, view);
  std::vector<BenchRow> rows;
  const auto add = [&](const char* name, int samples, const TimedCapture& capture) {
    const double flip_error = engine::flip(reference, capture.picture).mean;
    const engine::ImageDifference image_difference = engine::difference(capture.picture, reference);
    rows.push_back(
        {"quality",
         fmt::format("anti-aliasing against {} samples per pixel, {}x{}: {}", fine * fine, kWidth, kHeight, name),
         image_difference.psnr,
         "dB",
         {},
         true,
         "",
         true,
         {{"FLIP", flip_error, ""}, capture.frame()}});
    rows.back().trade = Trade{fmt::format("anti-aliasing, {}x{}", kWidth, kHeight),
                              name,
                              capture.frame(),
                              {fmt::format("FLIP against {} samples per pixel", fine * fine), flip_error, ""},
                              samples == engine::RenderConfig{}.samples};
  };
  const std::vector<TimedCapture> captures =
      capture_in_turn(cabin, {{sized(1, 1)}, {sized(2, 1), 2}, {sized(1, 4)}}, view, frames);
  add("1x", 1, captures[0]);
  add("2x2 supersampling", 0, captures[1]);
  rows.back().related.push_back({"time to downsample the picture", captures[1].reduction.median, "ms"});
  add("4x", 4, captures[2]);
  return rows;
}

struct Triangle {
  glm::dvec3 a, ab, ac;
};

std::vector<Triangle> triangles_of(const cabin::Stage& stage) {
  std::vector<Triangle> triangles;
  const engine::Model& model = stage.model();
  std::vector<const engine::Vertex*> vertices(model.meshes.size());
  for (std::size_t mesh = 0; mesh < model.meshes.size(); ++mesh)
    vertices[mesh] = model.vertices.data() + model.meshes[mesh].first_vertex;
  for (const engine::DeformedMesh& deformed : stage.scene().deformed)
    vertices[static_cast<std::size_t>(deformed.mesh)] = deformed.vertices.data();
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const engine::NodeState& state = stage.scene().nodes[n];
    if (model.nodes[n].mesh == engine::kNone || !state.visible || state.opacity < 1.0f) continue;
    const auto m = static_cast<std::size_t>(model.nodes[n].mesh);
    const engine::Mesh& mesh = model.meshes[m];
    for (const engine::Primitive& primitive : mesh.primitives) {
      if (primitive.material != engine::kNone &&
          model.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == engine::AlphaMode::blend)
        continue;
      for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
        std::array<glm::dvec3, 3> p;
        for (std::uint32_t k = 0; k < 3; ++k) {
          const engine::Vertex& v = vertices[m][model.indices[primitive.first_index + i + k] - mesh.first_vertex];
          p[k] = glm::dvec3(state.world * glm::vec4(v.position, 1.0f));
        }
        triangles.push_back({p[0], p[1] - p[0], p[2] - p[0]});
      }
    }
  }
  return triangles;
}

// Returns the distance along the ray, or infinity. Möller, Trumbore. Fast, Minimum Storage Ray/Triangle Intersection.
// 1997.
double hit(const Triangle& t, glm::dvec3 origin, glm::dvec3 direction) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const glm::dvec3 p = glm::cross(direction, t.ac);
  const double det = glm::dot(t.ab, p);
  if (std::abs(det) < 1e-14) return kMiss;
  const glm::dvec3 from = origin - t.a;
  const double u = glm::dot(from, p) / det;
  if (u < 0.0 || u > 1.0) return kMiss;
  const glm::dvec3 q = glm::cross(from, t.ab);
  const double v = glm::dot(direction, q) / det;
  if (v < 0.0 || u + v > 1.0) return kMiss;
  const double s = glm::dot(t.ac, q) / det;
  return s > 0.0 ? s : kMiss;
}

struct LitPixel {
  int x = 0, y = 0;
  bool lit = false;
};

// Picks `count` random pixels. Tests whether the sun reaches the points visible there, with rays that are tested
// against every triangle.
std::vector<LitPixel> cast(const cabin::Stage& stage, const engine::View& view, int count) {
  const std::vector<Triangle> triangles = triangles_of(stage);
  const glm::dvec3 sun = glm::normalize(glm::dvec3(stage.scene().sun.towards));
  const glm::dmat4 world_from_clip = glm::inverse(glm::dmat4(view.clip_from_view) * glm::dmat4(view.view_from_world));
  const glm::dvec3 eye(view.eye);
  std::mt19937 chance(7);
  std::uniform_int_distribution<int> column(0, kWidth - 1), row(0, kHeight - 1);
  std::vector<LitPixel> pixels;
  while (static_cast<int>(pixels.size()) < count) {
    LitPixel pixel{column(chance), row(chance), true};
    const glm::dvec4 near = world_from_clip * glm::dvec4(2.0 * (pixel.x + 0.5) / kWidth - 1.0,
                                                         2.0 * (pixel.y + 0.5) / kHeight - 1.0, 1.0, 1.0);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(near) / near.w - eye);
    double nearest = 30.0;  // [m] points beyond this distance are outside the cabin
    const Triangle* nearest_triangle = nullptr;
    for (const Triangle& t : triangles) {
      if (const double s = hit(t, eye, direction); s < nearest && s > 0.05) nearest = s, nearest_triangle = &t;
    }
    if (!nearest_triangle) continue;
    glm::dvec3 normal = glm::normalize(glm::cross(nearest_triangle->ab, nearest_triangle->ac));
    if (glm::dot(normal, direction) > 0.0) normal = -normal;
    if (glm::dot(normal, sun) < 0.15) continue;  // skips surfaces that face away from the sun or are only grazed by it
    const glm::dvec3 point = eye + nearest * direction + 1e-4 * normal;
    for (const Triangle& t : triangles) {
      if (hit(t, point, sun) == std::numeric_limits<double>::infinity()) continue;
      pixel.lit = false;
      break;
    }
    pixels.push_back(pixel);
  }
  return pixels;
}

double luminance(const engine::Image& picture, const LitPixel& at) {
  const std::uint8_t* rgb = picture.pixel(at.x, at.y);
  return 0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]);
}

std::vector<BenchRow> shadow_rows(const BenchOptions& options, PaperCabin& cabin) {
  const engine::View view = symmetric_view(cabin.stage.driver_eye(), sized(1, 1));
  const std::vector<LitPixel> truth = cast(cabin.stage, view, options.quick ? 60 : 2000);
  engine::RenderConfig config = sized(1, 1);
  config.mirror_height = 0;
  config.shadow_side = 0;
  const engine::Image unshadowed = picture_of(cabin, {config}, view);
  engine::FrameScene dark = cabin.stage.scene();
  dark.sun.irradiance = glm::vec3(0.0f);
  cabin.gpu.wait(cabin.renderer.draw(dark, {&view, 1}));
  const engine::Image sunless = cabin.renderer.read_eye(0);
  std::vector<RenderMethod> methods;
  for (const int side : {512, 1024, 2048, 4096}) {
    config.shadow_side = side;
    methods.push_back({config});
  }
  const std::vector<TimedCapture> all = capture_in_turn(cabin, methods, view, options.quick ? 2 : 9);
  std::vector<BenchRow> rows;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const int side = methods[i].config.shadow_side;
    const TimedCapture& capture = all[i];
    int wrong = 0, judged = 0;
    for (const LitPixel& pixel : truth) {
      const double full = luminance(unshadowed, pixel), none = luminance(sunless, pixel);
      if (full - none < 0.004) continue;  // the sun has no visible effect on this pixel
      const bool lit = luminance(capture.picture, pixel) > 0.5 * (full + none);
      wrong += lit != pixel.lit ? 1 : 0;
      ++judged;
    }
    const double wrong_percent = judged > 0 ? 100.0 * wrong / judged : 0.0;
    rows.push_back({"quality",
                    fmt::format("shadow map {0}x{0}: pixels that differ from ray tracing", side),
                    wrong_percent,
                    "%",
                    {},
                    false,
                    "",
                    true,
                    {{"compared", static_cast<double>(judged), "pixels"}, capture.frame()}});
    rows.back().trade = Trade{"shadow map",
                              fmt::format("{0}x{0}", side),
                              capture.frame(),
                              {"pixels that differ from ray tracing", wrong_percent, "%"},
                              side == engine::RenderConfig{}.shadow_side};
  }
  return rows;
}

std::vector<BenchRow> mirror_rows(const BenchOptions& options, PaperCabin& cabin) {
  const engine::EyePose eye = engine::look_at(cabin.stage.driver_eye().position, glm::dvec3(0.325, 0.805, -0.495));
  const engine::View view = symmetric_view(eye, sized(1, 1), 0.35);
  engine::RenderConfig config = sized(1, 1);
  config.mirror_height = 384;
  const engine::Image reference = picture_of(cabin, {config}, view);
  std::vector<RenderMethod> methods;
  for (const int height : {48, 96, 192}) {
    config.mirror_height = height;
    methods.push_back({config});
  }
  const std::vector<TimedCapture> all = capture_in_turn(cabin, methods, view, options.quick ? 2 : 9);
  std::vector<BenchRow> rows;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const int height = methods[i].config.mirror_height;
    const TimedCapture& capture = all[i];
    const double flip_error = engine::flip(reference, capture.picture).mean;
    rows.push_back({"quality",
                    fmt::format("mirror of {} lines, seen from close up: FLIP against 384 lines", height),
                    flip_error,
                    "",
                    {},
                    false,
                    "",
                    true,
                    {capture.frame()}});
    rows.back().trade = Trade{"mirror, seen from close up",
                              fmt::format("{} lines", height),
                              capture.frame(),
                              {"FLIP against 384 lines", flip_error, ""},
                              height == engine::RenderConfig{}.mirror_height};
  }
  return rows;
}

constexpr int kMarks = 9;
constexpr float kMarkRadius = 0.03f;  // [m]

// A model of bright discs that face the eyes, at several depths.
engine::Model marker_model() {
  engine::Model model;
  model.materials.emplace_back();
  model.materials[0].base_colour = {0.0f, 0.0f, 0.0f, 1.0f};
  model.materials[0].emissive = glm::vec3(1.0f);
  model.materials[0].roughness = 1.0f;
  model.vertices.emplace_back();
  constexpr int kCorners = 64;
  for (int i = 0; i < kCorners; ++i) {
    const float angle = 6.28318531f * static_cast<float>(i) / kCorners;
    model.vertices.emplace_back();
    model.vertices.back().position = kMarkRadius * glm::vec3(std::cos(angle), std::sin(angle), 0.0f);
    const auto next = static_cast<std::uint32_t>(1 + (i + 1) % kCorners);
    model.indices.insert(model.indices.end(), {0u, static_cast<std::uint32_t>(1 + i), next});
  }
  engine::Primitive disc;
  disc.index_count = static_cast<std::uint32_t>(model.indices.size());
  disc.material = 0;
  disc.low = {-kMarkRadius, -kMarkRadius, 0.0f};
  disc.high = {kMarkRadius, kMarkRadius, 0.0f};
  model.meshes.push_back({"Mark", {disc}, 0, static_cast<std::uint32_t>(model.vertices.size())});
  for (int i = 0; i < kMarks; ++i) {
    const int column = i % 3 - 1, row = i / 3 - 1;
    engine::Node node;
    node.mesh = 0;
    node.translation = {0.37f * static_cast<float>(column) + 0.013f, 0.21f * static_cast<float>(row) + 0.007f,
                        -1.0f - 0.17f * static_cast<float>(i)};
    model.nodes.push_back(node);
  }
  return model;
}

// Centroid of the light that one disc adds to the picture. `with` and `without` are pictures with and without the disc.
glm::dvec2 centre_of(const engine::Image& with, const engine::Image& without) {
  glm::dvec2 sum(0.0);
  double weight = 0.0;
  for (int y = 0; y < with.height; ++y) {
    for (int x = 0; x < with.width; ++x) {
      const double w = linear(with.pixel(x, y)[1]) - linear(without.pixel(x, y)[1]);
      if (w <= 0.0) continue;
      sum += w * glm::dvec2(x + 0.5, y + 0.5);
      weight += w;
    }
  }
  return sum / weight;
}

// Compares rendered points with the closed form: a point at x and at the depth z is f ((x - e) / z + e / s) to the
// right of the picture's centre, with the focal length f, the eye's offset e and the screen's distance s.
BenchRow projected_points() {
  engine::Gpu gpu({});
  engine::RenderConfig config = sized(1, 4);
  config.eyes = 2;
  config.shadow_side = 0;
  engine::Renderer renderer(gpu, config);
  const engine::Model model = marker_model();
  renderer.set_model(model);
  constexpr double kIpd = 0.063, kScreen = 2.0, kVertical = 1.0;
  const engine::StereoEyes eyes = engine::stereo_eyes(
      engine::EyePose{}, engine::symmetric_fov(kVertical, static_cast<double>(kWidth) / kHeight), kIpd, kScreen);
  const std::array<engine::View, 2> views{engine::view_from(eyes.pose[0], eyes.fov[0], 0.05),
                                          engine::view_from(eyes.pose[1], eyes.fov[1], 0.05)};
  const double focal = 0.5 * kHeight / std::tan(0.5 * kVertical);  // [px]
  engine::FrameScene scene = rest_scene(model);
  double worst = 0.0, sum = 0.0;
  for (int mark = 0; mark < kMarks; ++mark) {
    std::array<std::array<engine::Image, 2>, 2> pictures;  // first index: without, with mark; second: left, right eye
    for (int on = 0; on < 2; ++on) {
      for (int i = 0; i < kMarks; ++i)
        scene.nodes[static_cast<std::size_t>(i)].emissive = on && i == mark ? 1.0f : 0.0f;
      gpu.wait(renderer.draw(scene, views));
      for (int eye = 0; eye < 2; ++eye)
        pictures[static_cast<std::size_t>(on)][static_cast<std::size_t>(eye)] = renderer.read_eye(eye);
    }
    const glm::dvec3 at(model.nodes[static_cast<std::size_t>(mark)].translation);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const double side = (eye == 0 ? -0.5 : 0.5) * kIpd;
      const glm::dvec2 truth(0.5 * kWidth + focal * ((at.x - side) / -at.z + side / kScreen),
                             0.5 * kHeight - focal * at.y / -at.z);
      const double error = glm::distance(centre_of(pictures[1][eye], pictures[0][eye]), truth);
      worst = std::max(worst, error);
      sum += error;
    }
  }
  return answers_design(
      Design::projected,
      {"quality",
       fmt::format("projection of {} marks, both eyes, off axis: worst distance from the closed form", kMarks),
       worst,
       "px",
       0.1,
       false,
       "",
       true,
       {{"mean", sum / (2 * kMarks), "px"}}});
}

}  // namespace

std::vector<BenchRow> bench_quality(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  const auto add = [&](std::vector<BenchRow> more) { rows.insert(rows.end(), more.begin(), more.end()); };
  {
    PaperCabin cabin(options);
    add(anti_aliasing_rows(options, cabin));
    add(shadow_rows(options, cabin));
    add(mirror_rows(options, cabin));
  }
  rows.push_back(projected_points());
  return rows;
}

}  // namespace gearshift::lab
