// Images that track their own state: transition() moves them from one use to the next, and expect() throws if an image
// is in the wrong state.
//
// Synchronization validation does not check the attachments of dynamic rendering, but this tracking does.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/gpu.h"
#include "engine/image/image.h"

namespace gearshift::engine {

// How an image is used. The use determines layout, stages and accesses.
enum class ImageUse : std::uint8_t {
  none,           // content undefined
  colour_target,  // render target, blend target or resolve destination
  depth_target,
  depth_resolved,  // destination of a depth resolve
  sampled,         // sampled by a fragment shader
  copy_from,       // source of a copy, blit or resolve
  copy_to,
  present
};

struct ImageDesc {
  std::uint32_t width = 1, height = 1;
  std::uint32_t layers = 1;
  std::uint32_t levels = 1;
  VkFormat format = VK_FORMAT_R8G8B8A8_SRGB;
  VkImageUsageFlags usage = 0;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool cube = false;                             // six layers
  VkFormat second_format = VK_FORMAT_UNDEFINED;  // additional view format (e.g. UNORM views of an sRGB image)
};

class GpuImage {
 public:
  GpuImage() = default;
  GpuImage(Gpu& gpu, const ImageDesc& desc);
  GpuImage(VkImage foreign, const ImageDesc& desc);  // image of a swapchain or an XR runtime: not owned
  GpuImage(GpuImage&& other) noexcept;
  GpuImage& operator=(GpuImage&& other) noexcept;
  ~GpuImage();

  VkImage get() const noexcept { return image_; }
  const ImageDesc& desc() const noexcept { return desc_; }
  VkExtent2D extent() const noexcept { return {desc_.width, desc_.height}; }
  VkImageAspectFlags aspect() const noexcept;  // colour or depth, derived from the format

  // Current use of a mip level; the same for all layers.
  ImageUse use(std::uint32_t level = 0) const noexcept { return states_[level].use; }

 private:
  friend void transition(VkCommandBuffer, GpuImage&, ImageUse, std::uint32_t, std::uint32_t);
  friend void discard_content(GpuImage&) noexcept;
  Gpu* gpu_ = nullptr;
  VkImage image_ = VK_NULL_HANDLE;
  ImageDesc desc_;
  Allocation allocation_;
  struct LevelState {
    ImageUse use = ImageUse::none;
    ImageUse discarded_use = ImageUse::none;  // use before discard_content(); barriers still wait for this use
  };
  std::vector<LevelState> states_;
};

inline constexpr std::uint32_t kAllLevels = ~0u;

// Records the barrier that prepares the image for the given use, whatever its previous use: earlier writes become
// visible and earlier reads are waited for. If the use does not change, records a barrier between two writes and no
// barrier between two reads.
void transition(VkCommandBuffer commands, GpuImage& image, ImageUse use, std::uint32_t first_level = 0,
                std::uint32_t level_count = kAllLevels);

// Returns the barrier that transition() would record, but for all levels and layers of the aspect and with a null
// image. Returns empty if no barrier is needed. If `from` is `none`, the content is dropped, but the barrier still
// waits for `discarded_use`. Throws std::logic_error if `to` is `none`.
std::optional<VkImageMemoryBarrier2> barrier_between(ImageUse from, ImageUse to, VkImageAspectFlags aspect,
                                                     ImageUse discarded_use = ImageUse::none);

// Throws std::logic_error, which names both uses, if the current use of the level is not `use`. Call it before each use
// of an image.
void expect(const GpuImage& image, ImageUse use, std::uint32_t level = 0);

// Marks the content as no longer needed, e.g. in a swapchain image after present or a target about to be cleared.
void discard_content(GpuImage& image) noexcept;

VkImageLayout layout_of(ImageUse use) noexcept;

ImageView make_view(const Gpu& gpu, const GpuImage& image, VkImageViewType type, std::uint32_t first_layer = 0,
                    // VK_FORMAT_UNDEFINED: the image's own format
                    std::uint32_t layer_count = 1, VkFormat format = VK_FORMAT_UNDEFINED);

struct SamplerDesc {
  bool linear = true;
  VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_REPEAT, v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  bool mips = true;
  bool anisotropic = false;  // maximum 8, or the device's limit if lower; off on a software driver
  bool compare = false;      // compares depth: greater or equal passes (reverse-Z)
};
Sampler make_sampler(const Gpu& gpu, const SamplerDesc& desc);

// Uploads the pixels, generates mip levels by blitting if `mips` is true, and leaves the image in ImageUse::sampled.
// Waits for the upload.
GpuImage make_texture(Gpu& gpu, const Image& pixels, bool srgb, bool mips);
// Uploads raw texels, for lookup tables and environments: levels[i] holds level i of all layers.
GpuImage make_texture(Gpu& gpu, const ImageDesc& desc, std::span<const std::vector<std::byte>> levels);

// Records a copy of all layers of level 0 into an image of the same size; the formats may differ. `from` must be in
// state `copy_from`, `to` in state `copy_to`.
void copy_image(VkCommandBuffer commands, const GpuImage& from, const GpuImage& to);

// Records a blit of one layer, scaled into the rectangle `place` of another image. `from` must be in state `copy_from`,
// `to` in state `copy_to`.
void blit_into(VkCommandBuffer commands, const GpuImage& from, std::uint32_t layer, const GpuImage& to,
               const VkRect2D& place);

// Records the barrier that lets the host read the results of copies once the commands have completed.
void make_copies_visible_to_host(VkCommandBuffer commands);

// Reads one layer of level 0 of an image with four bytes per pixel, and leaves the image in state `copy_from`. Waits
// for the copy.
Image read_back(Gpu& gpu, GpuImage& image, std::uint32_t layer = 0);

}  // namespace gearshift::engine
