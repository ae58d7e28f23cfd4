// Images that know their own state: one helper moves them from use to use, and a use in the wrong state throws.
//
// Synchronization validation is blind to the attachments of dynamic rendering: this is what stands in for it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/gpu.h"
#include "engine/image/image.h"

namespace gearshift {

// What an image is used for; layout, stages and accesses follow from it.
enum class ImageUse : std::uint8_t {
  none,           // undefined content
  colour_target,  // written, blended, resolved into
  depth_target,
  depth_resolved,  // the samples of a depth target are resolved into it
  sampled,         // in a fragment shader
  copy_from,       // copied, blitted or resolved from
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
  bool cube = false;                    // six layers
  VkFormat also = VK_FORMAT_UNDEFINED;  // a second format that views may have (sRGB seen as UNORM)
};

class GpuImage {
 public:
  GpuImage() = default;
  GpuImage(Gpu& gpu, const ImageDesc& desc);
  GpuImage(VkImage foreign, const ImageDesc& desc);  // of a swapchain or an XR runtime: not owned
  GpuImage(GpuImage&& other) noexcept;
  GpuImage& operator=(GpuImage&& other) noexcept;
  ~GpuImage();

  VkImage get() const noexcept { return image_; }
  const ImageDesc& desc() const noexcept { return desc_; }
  VkExtent2D extent() const noexcept { return {desc_.width, desc_.height}; }
  VkImageAspectFlags aspect() const noexcept;  // colour or depth, from the format

  // State of a mip level; all layers share it.
  ImageUse use(std::uint32_t level = 0) const noexcept { return states_[level].use; }

 private:
  friend void transition(VkCommandBuffer, GpuImage&, ImageUse, std::uint32_t, std::uint32_t);
  friend void forget(GpuImage&) noexcept;
  Gpu* gpu_ = nullptr;
  VkImage image_ = VK_NULL_HANDLE;
  ImageDesc desc_;
  Allocation allocation_;
  struct LevelState {
    ImageUse use = ImageUse::none;
    ImageUse given_up = ImageUse::none;  // the use before forget(): a barrier still waits for it
  };
  std::vector<LevelState> states_;
};

inline constexpr std::uint32_t kAllLevels = ~0u;

// Records the barrier that makes the image ready for the use, whatever it was used for before: its earlier writes are
// made visible, its earlier reads are waited for. To the same use again: a barrier between two writes, nothing between
// two reads.
void transition(VkCommandBuffer commands, GpuImage& image, ImageUse use, std::uint32_t first_level = 0,
                std::uint32_t level_count = kAllLevels);

// The barrier alone, for all levels and layers of the aspect; image left null. Nothing where none is needed. A source
// `none` with given_up: its content is dropped but that use is waited for. Throws std::logic_error to `none`.
std::optional<VkImageMemoryBarrier2> barrier_between(ImageUse from, ImageUse to, VkImageAspectFlags aspect,
                                                     ImageUse given_up = ImageUse::none);

// Throws std::logic_error naming both uses where the image is not in that state: call before each use.
void expect(const GpuImage& image, ImageUse use, std::uint32_t level = 0);

// The content is given up (a swapchain image that was presented; a target about to be cleared).
void forget(GpuImage& image) noexcept;

VkImageLayout layout_of(ImageUse use) noexcept;

ImageView make_view(const Gpu& gpu, const GpuImage& image, VkImageViewType type, std::uint32_t first_layer = 0,
                    std::uint32_t layer_count = 1, VkFormat format = VK_FORMAT_UNDEFINED);  // undefined: its own

struct SamplerDesc {
  bool linear = true;
  VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_REPEAT, v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  bool mips = true;
  bool anisotropic = false;  // as much as the device has, 8 at most; none on a software driver
  bool compare = false;      // depth compare, greater or equal (reverse-Z)
};
Sampler make_sampler(const Gpu& gpu, const SamplerDesc& desc);

// Uploaded, with mips by blitting where levels > 1, left in ImageUse::sampled. Waits.
GpuImage make_texture(Gpu& gpu, const Image& pixels, bool srgb, bool mips);
// Raw texels for each level of each layer, level by level: tables and environments.
GpuImage make_texture(Gpu& gpu, const ImageDesc& desc, std::span<const std::vector<std::byte>> levels);

// Records the copy of all layers at level 0 into an image of the same size, in whatever format it has. from in copy_from,
// to in copy_to.
void copy_whole(VkCommandBuffer commands, const GpuImage& from, const GpuImage& to);

// Records the blit of a layer, scaled into that place of another picture. from in copy_from, to in copy_to.
void blit_into(VkCommandBuffer commands, const GpuImage& from, std::uint32_t layer, const GpuImage& to,
               const VkRect2D& place);

// Records the barrier after which the host may read what copies have written, once the commands are done.
void make_copies_visible_to_host(VkCommandBuffer commands);

// Four bytes a pixel, of one layer at level 0; the image is left in copy_from. Waits.
Image read_back(Gpu& gpu, GpuImage& image, std::uint32_t layer = 0);

}  // namespace gearshift
