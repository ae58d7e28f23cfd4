#include "engine/gpu/commands.h"

namespace gearshift::engine {
namespace {

CommandPool make_pool(const Gpu& gpu, VkCommandPoolCreateFlags flags) {
  const VkCommandPoolCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .flags = flags, .queueFamilyIndex = gpu.queue_family()};
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(gpu.device(), &info, nullptr, &pool), "vkCreateCommandPool");
  return {gpu.device(), pool};
}

void allocate(const Gpu& gpu, VkCommandPool pool, std::uint32_t count, VkCommandBuffer* commands) {
  const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                         .commandPool = pool,
                                         .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                         .commandBufferCount = count};
  check(vkAllocateCommandBuffers(gpu.device(), &info, commands), "vkAllocateCommandBuffers");
}

void begin_once(VkCommandBuffer commands) {
  const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                      .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

}  // namespace

FrameRing::FrameRing(Gpu& gpu) : gpu_(gpu), pool_(make_pool(gpu, VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT)) {
  allocate(gpu, pool_.get(), kFramesInFlight, commands_.data());
}

FrameRing::~FrameRing() {
  try {
    wait();
  } catch (const GpuError&) {
    gpu_.wait_idle();  // wait() fails if the device is lost; wait_idle() returns even then
  }
}

VkCommandBuffer FrameRing::begin() {
  slot_ = (slot_ + 1) % kFramesInFlight;
  const auto index = static_cast<std::size_t>(slot_);
  if (done_[index] != 0) {
    gpu_.wait(done_[index]);
    done_[index] = 0;
  }
  VkCommandBuffer commands = commands_[index];
  // Also resets the commands of a frame that was begun but never ended.
  check(vkResetCommandBuffer(commands, 0), "vkResetCommandBuffer");
  begin_once(commands);
  return commands;
}

std::uint64_t FrameRing::end(VkSemaphore wait_for, VkSemaphore then_signal) {
  const auto index = static_cast<std::size_t>(slot_);
  check(vkEndCommandBuffer(commands_[index]), "vkEndCommandBuffer");
  return done_[index] = gpu_.submit(commands_[index], wait_for, then_signal);
}

void FrameRing::wait() {
  for (const std::uint64_t value : done_) gpu_.wait(value);
}

void run_once(Gpu& gpu, const std::function<void(VkCommandBuffer)>& record) {
  const CommandPool pool = make_pool(gpu, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT);
  VkCommandBuffer commands = VK_NULL_HANDLE;
  allocate(gpu, pool.get(), 1, &commands);
  begin_once(commands);
  record(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  gpu.wait(gpu.submit(commands));
}

}  // namespace gearshift::engine
