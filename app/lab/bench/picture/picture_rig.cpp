#include "app/lab/bench/picture/picture_rig.h"

#include "haptics/gate/gate_compiler.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::lab {

cabin::StageConfig paper_cabin(const BenchOptions& options) {
  cabin::StageConfig config;
  const haptics::GateLayout layout = haptics::read_gate_layout(options.gate_folder + "/paper.toml");
  config.gate = haptics::compile_gate(layout, haptics::workspace_half_extent(config.yoke), config.yoke.radius);
  return config;
}

cabin::StageInput in_first_gear(const haptics::Gate& gate) {
  cabin::StageInput input;
  input.lever.gear = input.car.gear = 1;
  input.lever.lever = input.lever.proxy = haptics::rest_position(gate, 1);
  input.car.engine_speed = 200.0;
  return input;
}

FrameCost time_frames(engine::Gpu& gpu, engine::Renderer& renderer, const engine::FrameScene& scene,
                      std::span<const engine::View> views, int frames, int warm_up) {
  std::vector<double> host, shadow, depth, mirror, main, overlay, all;
  for (int i = 0; i < frames + warm_up; ++i) {
    const auto start = std::chrono::steady_clock::now();
    gpu.wait(renderer.draw(scene, views));
    if (i < warm_up) continue;
    host.push_back(ms_since(start));
    const engine::PassTimes& times = renderer.times();
    shadow.push_back(times.shadow);
    depth.push_back(times.depth);
    mirror.push_back(times.mirror);
    main.push_back(times.main);
    overlay.push_back(times.overlay);
    all.push_back(times.all);
  }
  return {timed(host),
          {.shadow = quantile(shadow, 0.5),
           .depth = quantile(depth, 0.5),
           .mirror = quantile(mirror, 0.5),
           .main = quantile(main, 0.5),
           .overlay = quantile(overlay, 0.5),
           .all = quantile(all, 0.5)}};
}

}  // namespace gearshift::lab
