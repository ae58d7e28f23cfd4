#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

#include "engine/gpu/commands.h"
#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/gpu_image.h"
#include "engine/gpu/pipeline.h"
#include "engine/ui/ui.h"
#include "engine/ui/ui_state.h"
#include "shaders/ui_frag.h"
#include "shaders/ui_vert.h"

namespace gearshift::engine {

struct UiBuffers {
  GpuBuffer vertices, indices;
};

namespace {

constexpr VkDeviceSize kInitialBufferBytes = VkDeviceSize{64} * 1024;  // [bytes] initial size of each buffer
constexpr std::uint32_t kPushBytes = 2 * sizeof(float);

// The previous frame in this slot has completed, so the old buffer can be replaced.
void grow_buffer(Gpu& gpu, GpuBuffer& buffer, VkDeviceSize needed, VkBufferUsageFlags usage) {
  if (buffer && buffer.size() >= needed) return;
  const VkDeviceSize size = std::max({kInitialBufferBytes, needed, buffer.size() * 3 / 2});
  buffer = GpuBuffer();
  buffer = GpuBuffer(gpu, size, usage, MemoryKind::upload);
}

void upload(Gpu& gpu, UiBuffers& buffers, const ImDrawData& data) {
  const auto vertices = static_cast<VkDeviceSize>(data.TotalVtxCount) * sizeof(ImDrawVert);
  const auto indices = static_cast<VkDeviceSize>(data.TotalIdxCount) * sizeof(ImDrawIdx);
  grow_buffer(gpu, buffers.vertices, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  grow_buffer(gpu, buffers.indices, indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  std::byte* to_vertices = buffers.vertices.mapped();
  std::byte* to_indices = buffers.indices.mapped();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    std::memcpy(to_vertices, list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
    std::memcpy(to_indices, list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
    to_vertices += list.VtxBuffer.size_in_bytes();
    to_indices += list.IdxBuffer.size_in_bytes();
  }
}

// Returns a command's clip rectangle in whole pixels, limited to the picture; empty if the rectangle lies outside the
// picture.
VkRect2D scissor_of(const ImVec4& clip, VkExtent2D extent) {
  const auto pixel = [](float value, std::uint32_t max) {
    return static_cast<std::int32_t>(std::lround(std::clamp(value, 0.0f, static_cast<float>(max))));
  };
  const std::int32_t left = pixel(clip.x, extent.width), top = pixel(clip.y, extent.height);
  const std::int32_t right = std::max(left, pixel(clip.z, extent.width));
  const std::int32_t bottom = std::max(top, pixel(clip.w, extent.height));
  return {{left, top}, {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)}};
}

VertexInput vertex_input() {
  return {sizeof(ImDrawVert),
          {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
           {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
           {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}}};
}

GpuImage upload_font(Gpu& gpu) {
  unsigned char* coverage = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&coverage, &width, &height);
  ImageDesc desc;
  desc.width = static_cast<std::uint32_t>(width);
  desc.height = static_cast<std::uint32_t>(height);
  desc.format = VK_FORMAT_R8_UNORM;
  desc.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  const auto* bytes = reinterpret_cast<const std::byte*>(coverage);
  const std::vector<std::byte> texels(bytes,
                                      bytes + static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return make_texture(gpu, desc, std::span(&texels, 1));
}

}  // namespace

struct UiOverlay::State {
  Gpu& gpu;
  UiContext& context;
  SetLayout set_layout;
  PipelineLayout layout;
  Pipeline pipeline;
  SetPool pool;
  VkDescriptorSet set = VK_NULL_HANDLE;
  Sampler sampler;
  GpuImage font;
  ImageView font_view;
  std::uint64_t font_version = 0;
  std::array<UiBuffers, kFramesInFlight> buffers;

  State(Gpu& a_gpu, UiContext& a_context);
  void rebuild_font(std::uint64_t version);
  void bind(VkCommandBuffer commands, const ImDrawData& data, const UiBuffers& frame) const;
};

UiOverlay::State::State(Gpu& a_gpu, UiContext& a_context) : gpu(a_gpu), context(a_context) {
  const Binding texture{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT, 1};
  set_layout = make_set_layout(gpu, std::span(&texture, 1));
  const VkDescriptorSetLayout set_handle = set_layout.get();
  layout = make_pipeline_layout(gpu, std::span(&set_handle, 1), kPushBytes);
  PipelineDesc desc;
  desc.vertex = ui_vert;
  desc.fragment = ui_frag;
  desc.layout = layout.get();
  desc.input = vertex_input();
  desc.colour = kOverlayFormat;
  desc.blend = Blend::alpha;
  pipeline = make_pipeline(gpu, desc);
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
  pool = SetPool(gpu, 1, std::span(&size, 1));
  set = pool.make(set_layout.get());
  SamplerDesc smooth;
  smooth.u = smooth.v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  smooth.mips = false;
  sampler = make_sampler(gpu, smooth);
}

// Waits for the GPU, because frames in flight still read the old texture. The wait is acceptable, because the font
// changes rarely.
void UiOverlay::State::rebuild_font(std::uint64_t version) {
  if (font_version == version) return;
  gpu.wait_idle();
  GpuImage fresh = upload_font(gpu);
  font_view = make_view(gpu, fresh, VK_IMAGE_VIEW_TYPE_2D);
  font = std::move(fresh);
  bind_texture(gpu, set, 0, font_view.get(), sampler.get());
  font_version = version;
}

void UiOverlay::State::bind(VkCommandBuffer commands, const ImDrawData& data, const UiBuffers& frame) const {
  const VkViewport viewport{0.0f, 0.0f, data.DisplaySize.x, data.DisplaySize.y, 0.0f, 1.0f};
  const VkDeviceSize start = 0;
  const VkBuffer vertices = frame.vertices.get();
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 0, 1, &set, 0, nullptr);
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &start);
  vkCmdBindIndexBuffer(commands, frame.indices.get(), 0,
                       sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdPushConstants(commands, layout.get(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, kPushBytes,
                     &data.DisplaySize);
}

namespace {

void draw_list(VkCommandBuffer commands, VkExtent2D extent, const ImDrawList& list, std::uint32_t first_index,
               std::int32_t first_vertex) {
  for (const ImDrawCmd& command : list.CmdBuffer) {
    if (command.UserCallback != nullptr || command.GetTexID() != font_texture())
      throw std::logic_error("UiOverlay supports only the font's texture and no callbacks");
    const VkRect2D scissor = scissor_of(command.ClipRect, extent);
    if (scissor.extent.width == 0 || scissor.extent.height == 0) continue;
    vkCmdSetScissor(commands, 0, 1, &scissor);
    vkCmdDrawIndexed(commands, command.ElemCount, 1, first_index + command.IdxOffset,
                     first_vertex + static_cast<std::int32_t>(command.VtxOffset), 0);
  }
}

}  // namespace

UiOverlay::UiOverlay(Gpu& gpu, UiContext& context) : state_(std::make_unique<State>(gpu, context)) {}

UiOverlay::~UiOverlay() {
  state_->gpu.wait_idle();
}

void UiOverlay::draw(VkCommandBuffer commands, VkExtent2D extent, int slot) {
  State& state = *state_;
  const UiContext::State& context = *state.context.state_;
  ImGui::SetCurrentContext(context.context);
  const ImDrawData* data = ImGui::GetDrawData();
  if (data == nullptr || data->TotalIdxCount == 0) return;
  state.rebuild_font(context.font_version);
  UiBuffers& frame = state.buffers.at(static_cast<std::size_t>(slot));
  upload(state.gpu, frame, *data);
  state.bind(commands, *data, frame);
  std::uint32_t first_index = 0;
  std::int32_t first_vertex = 0;
  for (int i = 0; i < data->CmdListsCount; ++i) {
    const ImDrawList& list = *data->CmdLists[i];
    draw_list(commands, extent, list, first_index, first_vertex);
    first_index += static_cast<std::uint32_t>(list.IdxBuffer.Size);
    first_vertex += list.VtxBuffer.Size;
  }
}

}  // namespace gearshift::engine
