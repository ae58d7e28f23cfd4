#include "engine/render/light_textures.h"

#include "shaders/shared.h"

namespace gearshift::engine {

namespace {

constexpr int kReflectionSide = 64;  // [texels]
constexpr int kSkySide = 256;        // [texels] 0.35 degrees each, so that the horizon is a sharp line

GpuImage upload_cube(Gpu& gpu, const PrefilteredCube& cube) {
  std::vector<std::vector<std::byte>> levels;
  for (const auto& halves : cube.levels) {
    const auto bytes = std::as_bytes(std::span(halves));
    levels.emplace_back(bytes.begin(), bytes.end());
  }
  const auto side = static_cast<std::uint32_t>(cube.side);
  const ImageDesc desc{.width = side,
                       .height = side,
                       .layers = 6,
                       .levels = static_cast<std::uint32_t>(levels.size()),
                       .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                       .cube = true};
  return make_texture(gpu, desc, levels);
}

}  // namespace

LightMaps light_maps(const Radiance& open, const Radiance& indoors) {
  return {prefilter(open, kSkySide, 1, 1), prefilter(open, kReflectionSide, shader::kReflectionLevels),
          prefilter(indoors, kReflectionSide, shader::kReflectionLevels), project_irradiance(open),
          project_irradiance(indoors)};
}

void upload_light(Gpu& gpu, const LightMaps& maps, LightTextures& into) {
  into.sky = upload_cube(gpu, maps.sky);
  into.reflections = upload_cube(gpu, maps.reflections);
  into.indoors = upload_cube(gpu, maps.indoors);
  into.sky_view = make_view(gpu, into.sky, VK_IMAGE_VIEW_TYPE_CUBE, 0, 6);
  into.reflections_view = make_view(gpu, into.reflections, VK_IMAGE_VIEW_TYPE_CUBE, 0, 6);
  into.indoors_view = make_view(gpu, into.indoors, VK_IMAGE_VIEW_TYPE_CUBE, 0, 6);
  into.irradiance = maps.irradiance;
  into.irradiance_indoors = maps.irradiance_indoors;
}

void upload_brdf(Gpu& gpu, const BrdfTable& table, LightTextures& into) {
  const auto bytes = std::as_bytes(std::span(table.texels));
  const std::vector<std::vector<std::byte>> levels{{bytes.begin(), bytes.end()}};
  const auto side = static_cast<std::uint32_t>(table.side);
  into.brdf = make_texture(gpu, ImageDesc{.width = side, .height = side, .format = VK_FORMAT_R16G16_UNORM}, levels);
  into.brdf_view = make_view(gpu, into.brdf, VK_IMAGE_VIEW_TYPE_2D);
}

}  // namespace gearshift::engine
