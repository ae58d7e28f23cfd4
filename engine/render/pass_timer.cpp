#include "engine/render/pass_timer.h"

namespace gearshift::engine {

PassTimer::PassTimer(Gpu& gpu) : gpu_(gpu) {
  if (gpu.traits().timestamp_bits == 0) return;
  const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                   .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                   .queryCount = kQueries * kFramesInFlight};
  VkQueryPool pool = VK_NULL_HANDLE;
  check(vkCreateQueryPool(gpu.device(), &info, nullptr, &pool), "vkCreateQueryPool");
  queries_ = QueryPool(gpu.device(), pool);
}

void PassTimer::begin(VkCommandBuffer commands, int slot) {
  if (!queries_) return;
  const auto index = static_cast<std::size_t>(slot);
  const std::uint32_t first = kQueries * static_cast<std::uint32_t>(slot);
  if (submitted_[index]) read(first);
  submitted_[index] = false;
  vkCmdResetQueryPool(commands, queries_.get(), first, kQueries);
  next_ = first;
  next_flush_stamp_ = first + kStamps;
  end_ = first + kQueries;
  stamp(commands);
}

void PassTimer::end(int slot) {
  submitted_[static_cast<std::size_t>(slot)] = true;
}

void PassTimer::stamp(VkCommandBuffer commands) {
  if (!queries_) return;
  vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_.get(), next_++);
}

void PassTimer::stamp_to_flush(VkCommandBuffer commands) {
  if (queries_ && next_flush_stamp_ < end_)
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_.get(), next_flush_stamp_++);
}

void PassTimer::read(std::uint32_t first) {
  std::array<std::uint64_t, kStamps> stamps{};
  if (vkGetQueryPoolResults(gpu_.device(), queries_.get(), first, kStamps, sizeof stamps, stamps.data(),
                            sizeof stamps[0], VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
    return;
  const std::uint32_t bits = gpu_.traits().timestamp_bits;
  const std::uint64_t valid = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const auto between = [&](std::size_t from, std::size_t to) {
    return static_cast<double>((stamps[to] - stamps[from]) & valid) * gpu_.traits().tick_ns * 1e-6;
  };
  times_ = {between(0, 1), between(1, 2), between(2, 3), between(3, 4), between(4, 5), between(0, 5)};
}

}  // namespace gearshift::engine
