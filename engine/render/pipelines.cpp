#include "engine/render/pipelines.h"

#include <array>
#include <bit>
#include <cstddef>

#include "engine/model/model.h"
#include "shaders/depth_frag.h"
#include "shaders/depth_layered_vert.h"
#include "shaders/depth_vert.h"
#include "shaders/mesh_frag.h"
#include "shaders/mesh_layered_vert.h"
#include "shaders/mesh_vert.h"
#include "shaders/shared.h"
#include "shaders/sky_frag.h"
#include "shaders/sky_layered_vert.h"
#include "shaders/sky_vert.h"

namespace gearshift::engine {

namespace {

// Reduces self-shadowing: moves depth away from the sun (to smaller values, because of reverse-Z) in proportion to the
// slope of the surface. The normal offset in mesh_vertex.glsl prevents the remaining self-shadowing.
constexpr float kShadowSlopeBias = -1.5f;

VertexInput vertex_input() {
  const auto at = [](std::uint32_t location, VkFormat format, std::size_t offset) {
    return VkVertexInputAttributeDescription{location, 0, format, static_cast<std::uint32_t>(offset)};
  };
  return {sizeof(Vertex),
          {at(0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)),
           at(1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)),
           at(2, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Vertex, tangent)),
           at(3, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv0)), at(4, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv1)),
           at(5, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, colour))}};
}

SetLayout pass_layout(const Gpu& gpu) {
  constexpr VkShaderStageFlags kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
  constexpr VkDescriptorType kImage = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  const std::array bindings{
      Binding{shader::kBindPass, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
      Binding{shader::kBindObjects, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
      Binding{shader::kBindReflections, kImage, kFragment},
      Binding{shader::kBindBrdf, kImage, kFragment},
      Binding{shader::kBindShadow, kImage, kFragment},
      Binding{shader::kBindMirror, kImage, kFragment},
      Binding{shader::kBindSky, kImage, kFragment},
      Binding{shader::kBindIndoors, kImage, kFragment}};
  return make_set_layout(gpu, bindings);
}

SetLayout material_layout(const Gpu& gpu) {
  std::array<Binding, shader::kMaps + 1> bindings;
  for (std::uint32_t map = 0; map < shader::kMaps; ++map)
    bindings[map] = {map, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT};
  bindings[shader::kMaps] = {shader::kBindMaterial, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT};
  return make_set_layout(gpu, bindings);
}

// Expands the spherical harmonics (engine/light/irradiance.cpp) to a polynomial. The function of coefficient c6, 3 z^2
// - 1, contributes to the constant term and to the coefficient of z^2.
std::array<glm::vec3, shader::kIrradianceTerms> polynomial_of(const Irradiance& light) {
  constexpr std::array kFactor{0.282095f, 0.488603f, 0.488603f, 0.488603f, 1.092548f,
                               1.092548f, 0.946176f, 1.092548f, 0.546274f};
  std::array<glm::vec3, shader::kIrradianceTerms> terms;
  for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = kFactor[i] * light.c[i];
  terms[0] -= 0.315392f * light.c[6];
  return terms;
}

PipelineLayout pipeline_layout(const Gpu& gpu, const SetLayout& pass, const SetLayout& material) {
  const std::array sets{pass.get(), material.get()};
  return make_pipeline_layout(gpu, sets, sizeof(shader::DrawData));
}

}  // namespace

RenderLayouts::RenderLayouts(const Gpu& gpu)
    : pass(pass_layout(gpu)), material(material_layout(gpu)), pipeline(pipeline_layout(gpu, pass, material)) {}

Pipelines::Pipelines(const Gpu& gpu, const RenderLayouts& layouts, VkSampleCountFlagBits samples, bool layered,
                     const Irradiance& open, const Irradiance& indoors)
    : gpu_(gpu),
      layouts_(layouts),
      samples_(samples),
      layered_(layered),
      open_(constants_of(open)),
      indoors_(constants_of(indoors)) {}

Pipelines::Constants Pipelines::constants_of(const Irradiance& light) {
  Constants constants{};
  const auto terms = polynomial_of(light);
  for (std::size_t i = 0; i < terms.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      constants[1 + 3 * i + c] = std::bit_cast<std::uint32_t>(terms[i][static_cast<int>(c)]);
  return constants;
}

Pipelines::Target Pipelines::target(PassKind pass) const {
  switch (pass) {
    case PassKind::shadow:
      return {VK_FORMAT_UNDEFINED, kShadowFormat, VK_SAMPLE_COUNT_1_BIT};
    case PassKind::depth:
      return {VK_FORMAT_UNDEFINED, kDepthFormat, samples_};
    case PassKind::mirror:
      return {kMirrorFormat, kDepthFormat, VK_SAMPLE_COUNT_1_BIT};
    default:
      return {kColourFormat, kDepthFormat, samples_};
  }
}

VkPipeline Pipelines::mesh(PassKind pass, std::uint32_t features) {
  Pipeline& pipeline = meshes_[{pass, features}];
  if (!pipeline) pipeline = make_mesh(pass, features);
  return pipeline.get();
}

VkPipeline Pipelines::sky(PassKind pass) {
  Pipeline& pipeline = skies_[pass];
  if (!pipeline) pipeline = make_sky(pass);
  return pipeline.get();
}

Pipeline Pipelines::make_mesh(PassKind pass, std::uint32_t features) const {
  const Target to = target(pass);
  const bool blended = (features & shader::kBlended) != 0;
  PipelineDesc desc;
  desc.layout = layouts_.pipeline.get();
  desc.input = vertex_input();
  desc.colour = to.colour;
  desc.depth = to.depth;
  desc.samples = to.samples;
  desc.blend = blended ? Blend::alpha : Blend::none;
  desc.depth_use = blended ? Depth::test : Depth::write;
  Constants constants = (features & shader::kIndoors) != 0 ? indoors_ : open_;
  constants[0] = features;
  desc.constants = constants;
  if (to.colour == VK_FORMAT_UNDEFINED) {
    const bool layers = layered_ && pass == PassKind::depth;
    desc.vertex = layers ? std::span<const std::uint32_t>(depth_layered_vert) : depth_vert;
    if ((features & shader::kMasked) != 0) desc.fragment = depth_frag;
    desc.depth_clamp = pass == PassKind::shadow;
    if (pass == PassKind::shadow) desc.depth_slope = kShadowSlopeBias;
  } else {
    desc.vertex = layered_ ? std::span<const std::uint32_t>(mesh_layered_vert) : mesh_vert;
    desc.fragment = mesh_frag;
  }
  return make_pipeline(gpu_, desc);
}

Pipeline Pipelines::make_sky(PassKind pass) const {
  const Target to = target(pass);
  const std::uint32_t features = pass == PassKind::mirror ? shader::kLinearOut : 0u;
  PipelineDesc desc;
  desc.vertex = layered_ ? std::span<const std::uint32_t>(sky_layered_vert) : sky_vert;
  desc.fragment = sky_frag;
  desc.layout = layouts_.pipeline.get();
  desc.colour = to.colour;
  desc.depth = to.depth;
  desc.samples = to.samples;
  desc.depth_use = Depth::test;
  desc.constants = {&features, 1};
  return make_pipeline(gpu_, desc);
}

}  // namespace gearshift::engine
