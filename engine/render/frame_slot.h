// Buffers that the CPU fills for one frame in flight. They must not be changed until the GPU has completed that frame.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/gpu/gpu_buffer.h"
#include "engine/render/draw_list.h"
#include "shaders/shared.h"

namespace gearshift::engine {

class FrameSlot {
 public:
  FrameSlot() = default;
  FrameSlot(Gpu& gpu, const std::array<VkDescriptorSet, kPassKinds>& sets);

  VkDescriptorSet set(PassKind pass) const noexcept { return sets_[static_cast<std::size_t>(pass)]; }
  VkBuffer deformed() const noexcept { return vertices_.get(); }

  void write_pass(PassKind pass, const shader::PassData& data);
  void write_objects(Gpu& gpu, const FrameScene& scene);
  // Writes the vertices of deformed meshes. Throws std::invalid_argument for an unknown mesh or a wrong number of
  // vertices.
  std::vector<DeformedRange> write_deformed(Gpu& gpu, const GpuModel& model, std::span<const DeformedMesh> meshes);

 private:
  std::array<VkDescriptorSet, kPassKinds> sets_{};
  GpuBuffer passes_, objects_, vertices_;
};

}  // namespace gearshift::engine
