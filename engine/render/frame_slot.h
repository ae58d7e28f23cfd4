// What a frame in flight writes for the GPU: nobody touches it until that frame is done.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/gpu/gpu_buffer.h"
#include "engine/render/draw_list.h"
#include "shaders/shared.h"

namespace gearshift {

class FrameSlot {
 public:
  FrameSlot() = default;
  FrameSlot(Gpu& gpu, const std::array<VkDescriptorSet, kPassKinds>& sets);

  VkDescriptorSet set(PassKind pass) const noexcept { return sets_[static_cast<std::size_t>(pass)]; }
  VkBuffer deformed() const noexcept { return vertices_.get(); }

  void write_pass(PassKind pass, const shader::PassData& data);
  void write_objects(Gpu& gpu, const FrameScene& scene);
  // Throws std::invalid_argument where a mesh is unknown or has another number of vertices.
  std::vector<DeformedPlace> write_deformed(Gpu& gpu, const GpuModel& model, std::span<const DeformedMesh> meshes);

 private:
  std::array<VkDescriptorSet, kPassKinds> sets_{};
  GpuBuffer passes_, objects_, vertices_;
};

}  // namespace gearshift
