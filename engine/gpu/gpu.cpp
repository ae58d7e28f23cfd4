#include "engine/gpu/gpu.h"

#include <cstdlib>
#include <limits>

#include "engine/gpu/device.h"
#include "engine/gpu/instance.h"
#include "engine/gpu/memory.h"
#include "engine/gpu/pipeline_cache.h"

namespace gearshift::engine {
namespace {

using PipelineCache = Handle<VkPipelineCache, vkDestroyPipelineCache>;

std::string wanted_device() {
  const char* name = std::getenv("GEARSHIFT_GPU");
  return name == nullptr ? "" : name;
}

PipelineCache make_cache(const Device& device, const std::filesystem::path& file) {
  std::vector<std::byte> saved;
  if (!file.empty()) saved = load_pipeline_cache(file, device.properties());
  const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                       .initialDataSize = saved.size(),
                                       .pInitialData = saved.data()};
  VkPipelineCache cache = VK_NULL_HANDLE;
  check(vkCreatePipelineCache(device.get(), &info, nullptr, &cache), "vkCreatePipelineCache");
  return {device.get(), cache};
}

std::vector<std::byte> content_of(VkDevice device, VkPipelineCache cache) {
  std::size_t size = 0;
  if (vkGetPipelineCacheData(device, cache, &size, nullptr) != VK_SUCCESS) return {};
  std::vector<std::byte> content(size);
  if (vkGetPipelineCacheData(device, cache, &size, content.data()) != VK_SUCCESS) return {};
  content.resize(size);
  return content;
}

Semaphore make_timeline(VkDevice device) {
  const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                       .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
  const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device, &info, nullptr, &semaphore), "vkCreateSemaphore");
  return {device, semaphore};
}

}  // namespace

struct Gpu::State {
  explicit State(const GpuConfig& config)
      : instance(config),
        device(instance.get(), config.swapchain, wanted_device(), config.factory),
        memory(device.physical(), device.get()),
        cache_file(config.pipeline_cache),
        cache(make_cache(device, cache_file)),
        timeline(make_timeline(device.get())) {}

  Instance instance;
  Device device;
  DeviceMemory memory;
  std::filesystem::path cache_file;
  PipelineCache cache;
  Semaphore timeline;
  std::mutex queue_mutex;
  std::uint64_t submitted = 0;  // timeline value that the last submission signals
};

Gpu::Gpu(const GpuConfig& config) : state_(std::make_unique<State>(config)) {}

Gpu::~Gpu() {
  wait_idle();
  if (state_->cache_file.empty()) return;
  const std::vector<std::byte> content = content_of(device(), cache());
  if (!content.empty()) save_pipeline_cache(state_->cache_file, content);
}

VkInstance Gpu::instance() const noexcept {
  return state_->instance.get();
}
VkPhysicalDevice Gpu::physical() const noexcept {
  return state_->device.physical();
}
VkDevice Gpu::device() const noexcept {
  return state_->device.get();
}
VkQueue Gpu::queue() const noexcept {
  return state_->device.queue();
}
std::uint32_t Gpu::queue_family() const noexcept {
  return state_->device.family();
}
VkPipelineCache Gpu::cache() const noexcept {
  return state_->cache.get();
}
const GpuTraits& Gpu::traits() const noexcept {
  return state_->device.traits();
}
bool Gpu::validates() const noexcept {
  return state_->instance.validates();
}
std::uint64_t Gpu::validation_messages() const noexcept {
  return state_->instance.messages();
}

Allocation Gpu::allocate(const VkMemoryRequirements& needs, MemoryKind kind, MemoryUser user) {
  return state_->memory.allocate(needs, kind, user);
}
void Gpu::free(const Allocation& allocation) noexcept {
  state_->memory.free(allocation);
}
VkDeviceSize Gpu::allocated() const noexcept {
  return state_->memory.in_use();
}

std::uint64_t Gpu::submit(VkCommandBuffer commands, VkSemaphore wait_for, VkSemaphore then_signal) {
  const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                         .commandBuffer = commands};
  // Swapchain images are written only by blits and clears, so rendering need not wait for the acquire semaphore.
  const VkSemaphoreSubmitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                   .semaphore = wait_for,
                                   .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT};
  const std::uint64_t value = state_->submitted + 1;
  const VkSemaphoreSubmitInfo signals[] = {{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                            .semaphore = state_->timeline.get(),
                                            .value = value,
                                            .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT},
                                           {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                            .semaphore = then_signal,
                                            .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}};
  const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                           .waitSemaphoreInfoCount = wait_for == VK_NULL_HANDLE ? 0u : 1u,
                           .pWaitSemaphoreInfos = &wait,
                           .commandBufferInfoCount = 1,
                           .pCommandBufferInfos = &buffer,
                           .signalSemaphoreInfoCount = then_signal == VK_NULL_HANDLE ? 1u : 2u,
                           .pSignalSemaphoreInfos = signals};
  check(vkQueueSubmit2(queue(), 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
  state_->submitted = value;
  return value;
}

void Gpu::wait(std::uint64_t value) {
  const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                 .semaphoreCount = 1,
                                 .pSemaphores = state_->timeline.address(),
                                 .pValues = &value};
  check(vkWaitSemaphores(device(), &info, std::numeric_limits<std::uint64_t>::max()), "vkWaitSemaphores");
}

bool Gpu::is_done(std::uint64_t value) const {
  std::uint64_t reached = 0;
  check(vkGetSemaphoreCounterValue(device(), state_->timeline.get(), &reached), "vkGetSemaphoreCounterValue");
  return reached >= value;
}

void Gpu::wait_idle() noexcept {
  vkDeviceWaitIdle(device());
}

std::mutex& Gpu::queue_mutex() noexcept {
  return state_->queue_mutex;
}

bool Gpu::supports(VkFormat format, VkFormatFeatureFlags2 features) const {
  VkFormatProperties3 optional{.sType = VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3};
  VkFormatProperties2 properties{.sType = VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2, .pNext = &optional};
  vkGetPhysicalDeviceFormatProperties2(physical(), format, &properties);
  return (optional.optimalTilingFeatures & features) == features;
}

}  // namespace gearshift::engine
