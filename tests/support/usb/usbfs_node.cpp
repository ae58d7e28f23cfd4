#include "tests/support/usb/usbfs_node.h"

// usbdevice_fs.h uses macros of ioctl.h, so ioctl.h must come first.
#include <sys/ioctl.h>
// This comment stops clang-format from sorting the two includes.
#include <linux/usbdevice_fs.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>

namespace gearshift::test {
namespace {

constexpr std::size_t kSetup = 8;      // [bytes] size of the setup packet before the data of a control transfer
constexpr unsigned kHidInterface = 0;  // the interface that the kernel's HID driver or a different program uses

std::int64_t clock_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

// Maps the client's memory that the pointer stored at `offset` points to.
IoctlData resolve(UMockdevIoctlData* data, std::size_t offset, std::size_t size) {
  GError* error = nullptr;
  IoctlData resolved(umockdev_ioctl_data_resolve(data, offset, size, &error));
  if (error != nullptr) g_error_free(error);
  return resolved;
}

template <class T>
T* as(const IoctlData& data) {
  return data ? reinterpret_cast<T*>(data->data) : nullptr;
}

std::span<std::uint8_t> bytes_of(const IoctlData& data) {
  return data ? std::span<std::uint8_t>(data->data, static_cast<std::size_t>(data->data_len))
              : std::span<std::uint8_t>();
}

UsbSetup setup_of(std::span<const std::uint8_t> bytes) {
  const auto word = [&](std::size_t at) { return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8); };
  return {bytes[0], bytes[1], word(2), word(4), word(6)};
}

}  // namespace

UsbfsNode::UsbfsNode(UsbGadget& gadget, std::mutex& bus, bool driver_bound, bool in_use)
    : gadget_(gadget), bus_(bus), driver_bound_(driver_bound && !in_use), in_use_(in_use) {}

// The client has closed its file: its transfers are cancelled and its claims released. The kernel driver is not
// attached again.
void UsbfsNode::closed(UMockdevIoctlClient* client) {
  ++counts_.closed;
  const auto belongs_to_client = [client](const Urb& urb) { return urb.client == client; };
  std::erase_if(pending_, belongs_to_client);
  std::erase_if(completed_, belongs_to_client);
  claimed_.erase(client);
  terminal_.set_writable(!completed_.empty());
}

void UsbfsNode::ioctl(UMockdevIoctlClient* client) {
  const unsigned long request = umockdev_ioctl_client_get_request(client);
  UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
  RequestData request_data = read(client, request, argument);
  Result result;
  {
    const std::lock_guard<std::mutex> lock(bus_);
    result = handle(client, request, argument, std::move(request_data));
  }
  umockdev_ioctl_client_complete(client, result.result, result.error);
}

void UsbfsNode::advance(std::int64_t now_ns) {
  if (disconnected_) return;
  now_ns_ = now_ns;
  gadget_.advance(now_ns);
  process_pending();
}

void UsbfsNode::disconnect() {
  disconnected_ = true;
  for (Urb& urb : pending_) finish(urb, -ESHUTDOWN, 0);
  std::move(pending_.begin(), pending_.end(), std::back_inserter(completed_));
  pending_.clear();
  gadget_.unplug();
  terminal_.hang_up();
}

// ----------------------------------------------------------------------------------------------------------- ioctls

// Reads the request's data from the client's memory. The client has to answer for this, but a stopped client does not,
// so the bus lock is not held meanwhile.
UsbfsNode::RequestData UsbfsNode::read(UMockdevIoctlClient* client, unsigned long request,
                                       UMockdevIoctlData* argument) {
  if (request == USBDEVFS_DISCARDURB) return {};  // needs only the address of the URB
  if (request == USBDEVFS_REAPURBNDELAY) {
    const std::lock_guard<std::mutex> lock(bus_);
    if (find_completed(client) == completed_.end()) return {};
  }
  const std::size_t size = request == USBDEVFS_REAPURBNDELAY ? sizeof(void*)
                           : request == USBDEVFS_SUBMITURB   ? sizeof(usbdevfs_urb)
                                                             : _IOC_SIZE(request);
  RequestData request_data;
  if (size > 0) request_data.data = resolve(argument, 0, size);
  if (request == USBDEVFS_SUBMITURB && request_data.data != nullptr) {
    const auto length = static_cast<std::size_t>(as<usbdevfs_urb>(request_data.data)->buffer_length);
    if (length > 0) request_data.buffer = resolve(request_data.data.get(), offsetof(usbdevfs_urb, buffer), length);
  }
  return request_data;
}

UsbfsNode::Result UsbfsNode::handle(UMockdevIoctlClient* client, unsigned long request, UMockdevIoctlData* argument,
                                    RequestData request_data) {
  const IoctlData& data = request_data.data;
  if (request == USBDEVFS_REAPURBNDELAY) return reap(client, data.get());
  if (disconnected_) return {-1, ENODEV};
  if (request == USBDEVFS_SUBMITURB) return submit(client, std::move(request_data));
  if (request == USBDEVFS_DISCARDURB) return discard(argument);
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      *as<std::uint32_t>(data) =
          USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return {};
    case USBDEVFS_CLAIMINTERFACE:
      return claim(client, *as<unsigned>(data), false);
    case USBDEVFS_DISCONNECT_CLAIM:
      return claim(client, as<usbdevfs_disconnect_claim>(data)->interface, true);
    case USBDEVFS_RELEASEINTERFACE:
      return release(client, *as<unsigned>(data));
    case USBDEVFS_IOCTL:
      return driver_ioctl(static_cast<unsigned>(as<usbdevfs_ioctl>(data)->ioctl_code));
    case USBDEVFS_CLEAR_HALT:
      return clear_halt(*as<unsigned>(data));
    default:
      return {-1, ENOTTY};
  }
}

UsbfsNode::Result UsbfsNode::claim(UMockdevIoctlClient* client, unsigned interface, bool detach) {
  if (interface == kHidInterface) {
    if (in_use_) return {-1, EBUSY};
    if (driver_bound_ && !detach) return {-1, EBUSY};
    for (const auto& [other, interfaces] : claimed_) {
      if (other != client && interfaces.contains(interface)) return {-1, EBUSY};
    }
    if (std::exchange(driver_bound_, false)) ++counts_.detached;
  }
  if (claimed_[client].insert(interface).second) ++counts_.claims;
  return {};
}

UsbfsNode::Result UsbfsNode::release(UMockdevIoctlClient* client, unsigned interface) {
  if (claimed_[client].erase(interface) == 0) return {-1, EINVAL};
  ++counts_.releases;
  return {};
}

// Clearing an endpoint is not allowed while transfers are pending in it.
UsbfsNode::Result UsbfsNode::clear_halt(unsigned endpoint) {
  const auto waits = [endpoint](const Urb& urb) { return urb.endpoint == endpoint; };
  if (std::any_of(pending_.begin(), pending_.end(), waits)) ++counts_.misuses;
  halted_.erase(endpoint);
  return {};
}

// Supports only one driver request, "attach" (USBDEVFS_CONNECT).
UsbfsNode::Result UsbfsNode::driver_ioctl(unsigned code) {
  if (code != USBDEVFS_CONNECT) return {-1, ENOTTY};
  if (driver_bound_) return {-1, EBUSY};
  driver_bound_ = true;
  ++counts_.attached;
  return {1, 0};
}

UsbfsNode::Result UsbfsNode::submit(UMockdevIoctlClient* client, RequestData request_data) {
  if (request_data.data == nullptr) return {-1, EFAULT};
  Urb urb;
  urb.client = client;
  urb.urb = std::move(request_data.data);
  urb.buffer = std::move(request_data.buffer);
  urb.type = as<usbdevfs_urb>(urb.urb)->type;
  urb.endpoint = as<usbdevfs_urb>(urb.urb)->endpoint;
  if (!has_claim(client, urb)) {
    ++counts_.misuses;
    return {-1, EBUSY};
  }
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL) {
    urb.due_ns = clock_ns() + static_cast<std::int64_t>(1e9 * gadget_.control_delay());
  }
  now_ns_ = clock_ns();
  ++counts_.submitted;
  pending_.push_back(std::move(urb));
  process_pending();
  return {};
}

UsbfsNode::Result UsbfsNode::discard(UMockdevIoctlData* argument) {
  const std::uint64_t address = *reinterpret_cast<std::uint64_t*>(argument->data);
  const auto found = std::find_if(pending_.begin(), pending_.end(),
                                  [address](const Urb& urb) { return urb.urb->client_addr == address; });
  if (found == pending_.end()) return {-1, EINVAL};
  finish(*found, -ENOENT, 0);
  completed_.push_back(std::move(*found));
  pending_.erase(found);
  terminal_.set_writable(true);
  return {};
}

std::deque<UsbfsNode::Urb>::iterator UsbfsNode::find_completed(UMockdevIoctlClient* client) {
  return std::find_if(completed_.begin(), completed_.end(), [client](const Urb& urb) { return urb.client == client; });
}

UsbfsNode::Result UsbfsNode::reap(UMockdevIoctlClient* client, UMockdevIoctlData* destination) {
  const auto found = find_completed(client);
  if (found == completed_.end()) return {-1, disconnected_ ? ENODEV : EAGAIN};
  if (destination == nullptr) return {-1, EAGAIN};  // the URB completed only after read(), or the client died
  umockdev_ioctl_data_set_ptr(destination, 0, found->urb.get());
  completed_.erase(found);
  ++counts_.returned;
  terminal_.set_writable(!completed_.empty());
  return {};
}

// Transfers to an interface or its endpoints need a claim. (The real kernel would claim a free interface implicitly,
// with a warning.)
bool UsbfsNode::has_claim(UMockdevIoctlClient* client, const Urb& urb) {
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL) {
    const std::span<const std::uint8_t> bytes = bytes_of(urb.buffer);
    if (bytes.size() < kSetup || (bytes[0] & 0x1f) == 0) return bytes.size() >= kSetup;
  }
  return claimed_[client].contains(kHidInterface);
}

// --------------------------------------------------------------------------------------------------------- transfers

void UsbfsNode::process_pending() {
  // In each endpoint, transfers are processed one after the other: this set lists the endpoints that are busy.
  std::set<std::uint8_t> waiting;
  for (auto urb = pending_.begin(); urb != pending_.end();) {
    if (waiting.contains(urb->endpoint) || !process(*urb)) {
      waiting.insert(urb->endpoint);
      ++urb;
      continue;
    }
    completed_.push_back(std::move(*urb));
    urb = pending_.erase(urb);
  }
  terminal_.set_writable(!completed_.empty());
}

bool UsbfsNode::process(Urb& urb) {
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL) return process_control(urb);
  return (urb.endpoint & 0x80) != 0 ? process_input(urb) : process_output(urb);
}

bool UsbfsNode::process_control(Urb& urb) {
  if (faults.control_stuck || now_ns_ < urb.due_ns) return false;
  const std::span<std::uint8_t> bytes = bytes_of(urb.buffer);
  const UsbSetup setup = setup_of(bytes);
  const bool in = (setup.request_type & 0x80) != 0;
  const std::span<std::uint8_t> data = bytes.subspan(kSetup);
  const bool is_output = setup.request_type == 0x21 && setup.request == 9 && setup.value >> 8 == 2;
  const bool stalls = is_output && stalls_output();
  const auto result = stalls ? std::nullopt : gadget_.control(setup, in ? std::span<const std::uint8_t>() : data);
  if (!result) {
    finish(urb, -EPIPE, 0);
  } else if (in) {
    const std::size_t length = std::min({result->size(), data.size(), std::size_t{setup.length}});
    std::copy_n(result->begin(), length, data.begin());
    finish(urb, 0, length);
  } else {
    finish(urb, 0, data.size());
  }
  return true;
}

bool UsbfsNode::process_input(Urb& urb) {
  if (halted_.contains(urb.endpoint)) return false;
  if (faults.input_stalls > 0 && faults.input_stalls-- > 0) return stall(urb);
  auto report = gadget_.input();
  if (!report) return false;
  if (faults.garbled) {
    finish(urb, -EPROTO, 0);
    return true;
  }
  report->resize(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(report->size()) + faults.extra_bytes), 0xee);
  const std::span<std::uint8_t> buffer = bytes_of(urb.buffer);
  const std::size_t length = std::min(report->size(), buffer.size());
  std::copy_n(report->begin(), length, buffer.begin());
  finish(urb, report->size() > buffer.size() ? -EOVERFLOW : 0, length);
  return true;
}

bool UsbfsNode::process_output(Urb& urb) {
  if (faults.output_stuck || halted_.contains(urb.endpoint)) return false;
  const std::span<const std::uint8_t> bytes = bytes_of(urb.buffer);
  if (stalls_output() || !gadget_.output(bytes)) return stall(urb);
  finish(urb, 0, bytes.size());
  return true;
}

// Halts the endpoint until its halt is cleared; meanwhile other transfers in it wait, as on an EHCI controller.
bool UsbfsNode::stall(Urb& urb) {
  halted_.insert(urb.endpoint);
  finish(urb, -EPIPE, 0);
  return true;
}

bool UsbfsNode::stalls_output() {
  return faults.output_stalls > 0 && faults.output_stalls-- > 0;
}

void UsbfsNode::finish(Urb& urb, int status, std::size_t length) {
  auto* client_urb = as<usbdevfs_urb>(urb.urb);
  client_urb->status = status;
  client_urb->actual_length = static_cast<int>(length);
}

}  // namespace gearshift::test
