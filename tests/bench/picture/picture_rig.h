// What the pictures of the bench are made with: one device, one renderer, one still model.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "app/stage/stage.h"
#include "engine/gpu/gpu.h"
#include "engine/image/image.h"
#include "engine/render/renderer.h"
#include "engine/scene/view.h"
#include "tests/bench/bench.h"

namespace gearshift {

inline double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// A scene in which every node stands as the model says.
inline FrameScene standing(const Model& model) {
  FrameScene scene;
  for (const glm::mat4& world : rest_pose(model)) {
    scene.nodes.emplace_back();
    scene.nodes.back().world = world;
  }
  return scene;
}

inline View seen_from(const EyePose& eye, const RenderConfig& config, double vertical_fov = 1.0) {
  return view_from(eye, symmetric_fov(vertical_fov, static_cast<double>(config.width) / config.height), 0.05);
}

StageConfig paper_cabin(const BenchOptions& options);  // the paper's gate in the cabin
StageInput in_first(const Gate& gate);                 // the lever in first, the engine turning

// Draws `frames` frames after `warm_up` others, each waited for.
struct FrameCost {
  Timed host;     // [ms] on the host
  PassTimes gpu;  // of the median frame's neighbourhood: each pass's own median
};
FrameCost time_frames(Gpu& gpu, Renderer& renderer, const FrameScene& scene, std::span<const View> views, int frames,
                      int warm_up = 3);

}  // namespace gearshift
