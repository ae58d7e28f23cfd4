// Helpers for benchmarks that render pictures: views, scenes and frame times.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "app/cabin/stage/stage.h"
#include "app/lab/bench/rows/bench.h"
#include "engine/gpu/gpu.h"
#include "engine/image/image.h"
#include "engine/render/renderer.h"
#include "engine/scene/view.h"

namespace gearshift::lab {

inline double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// A scene in which every node has its original transform from the model.
inline engine::FrameScene rest_scene(const engine::Model& model) {
  engine::FrameScene scene;
  for (const glm::mat4& world : engine::rest_pose(model)) {
    scene.nodes.emplace_back();
    scene.nodes.back().world = world;
  }
  return scene;
}

inline engine::View symmetric_view(const engine::EyePose& eye, const engine::RenderConfig& config,
                                   double vertical_fov = 1.0) {
  return engine::view_from(eye, engine::symmetric_fov(vertical_fov, static_cast<double>(config.width) / config.height),
                           0.05);
}

cabin::StageConfig paper_cabin(const BenchOptions& options);  // a cabin with the paper's gate
cabin::StageInput in_first_gear(const haptics::Gate& gate);   // the lever is in first gear, and the engine runs

// Durations of frames, measured by time_frames().
struct FrameCost {
  Timed host;             // [ms] CPU time from the draw call until the GPU has finished
  engine::PassTimes gpu;  // median of each render pass over all frames
};
FrameCost time_frames(engine::Gpu& gpu, engine::Renderer& renderer, const engine::FrameScene& scene,
                      std::span<const engine::View> views, int frames, int warm_up = 3);

}  // namespace gearshift::lab
