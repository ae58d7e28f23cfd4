// Shared by the bench's pictures: a device, a renderer and a static model.
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

// A scene in which every node has the model's own transform.
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

cabin::StageConfig paper_cabin(const BenchOptions& options);  // the paper's gate in the cabin
cabin::StageInput in_first_gear(const haptics::Gate& gate);   // lever in first gear, engine running

// Draws `frames` frames after `warm_up` frames, waiting for each.
struct FrameCost {
  Timed host;             // [ms] of host time
  engine::PassTimes gpu;  // median time of each pass, over the frames near the median
};
FrameCost time_frames(engine::Gpu& gpu, engine::Renderer& renderer, const engine::FrameScene& scene,
                      std::span<const engine::View> views, int frames, int warm_up = 3);

}  // namespace gearshift::lab
