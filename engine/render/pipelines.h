// Pipelines, one for each combination of pass and features, created on first use.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "engine/gpu/overlay.h"
#include "engine/gpu/pipeline.h"
#include "engine/light/environment.h"
#include "shaders/shared.h"

namespace gearshift::engine {

enum class PassKind : std::uint8_t { shadow, mirror, main, depth };  // depth: prepass of the main pass
inline constexpr std::array kPasses{PassKind::shadow, PassKind::mirror, PassKind::main, PassKind::depth};
inline constexpr std::size_t kPassKinds = kPasses.size();

inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;            // reverse-Z needs floating point
inline constexpr VkFormat kShadowFormat = VK_FORMAT_D16_UNORM;            // every device can render to it and sample it
inline constexpr VkFormat kMirrorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;  // radiance

// Descriptor set and pipeline layouts that match shaders/shared.h.
struct RenderLayouts {
  explicit RenderLayouts(const Gpu& gpu);
  SetLayout pass, material;
  PipelineLayout pipeline;
};

class Pipelines {
 public:
  Pipelines(const Gpu& gpu, const RenderLayouts& layouts, VkSampleCountFlagBits samples, bool layered,
            const Irradiance& open, const Irradiance& indoors);
  VkPipeline mesh(PassKind pass, std::uint32_t features);  // features: from features_in()
  VkPipeline sky(PassKind pass);

 private:
  struct Target {
    VkFormat colour, depth;
    VkSampleCountFlagBits samples;
  };
  Target target(PassKind pass) const;
  Pipeline make_mesh(PassKind pass, std::uint32_t features) const;
  Pipeline make_sky(PassKind pass) const;
  const Gpu& gpu_;
  const RenderLayouts& layouts_;
  VkSampleCountFlagBits samples_;
  bool layered_;
  // Specialization constants of a shader; the first constant is the bit mask of its features.
  using Constants = std::array<std::uint32_t, 1 + 3 * shader::kIrradianceTerms>;
  static Constants constants_of(const Irradiance& light);
  Constants open_, indoors_;
  std::map<std::pair<PassKind, std::uint32_t>, Pipeline> meshes_;
  std::map<PassKind, Pipeline> skies_;
};

}  // namespace gearshift::engine
