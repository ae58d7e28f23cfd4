// Emulates the Linux kernel's usbfs behind /dev/bus/usb/001/002 as far as libusb uses it: claims and the kernel driver;
// submitting, discarding and reaping URBs; disconnects.
//
// This work is based on:
// Linux 6.1, drivers/usb/core/devio.c; include/uapi/linux/usbdevice_fs.h
#pragma once

#include <umockdev.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "tests/support/usb/held_terminal.h"
#include "tests/support/usb/usb_gadget.h"
#include "tests/support/usb/usb_plug.h"

namespace gearshift::test {

struct Unref {
  void operator()(void* object) const noexcept { g_object_unref(object); }
};
using IoctlData = std::unique_ptr<UMockdevIoctlData, Unref>;

// Not thread-safe: callers must hold the bus lock. Only ioctl() takes the lock itself.
class UsbfsNode {
 public:
  // Gadget and bus lock must outlive the node. `driver_bound`: the kernel's HID driver is bound. `in_use`: a different
  // program uses the device.
  UsbfsNode(UsbGadget& gadget, std::mutex& bus, bool driver_bound, bool in_use);

  const std::string& path() const noexcept { return terminal_.path(); }
  UsbGadget& gadget() noexcept { return gadget_; }
  const UsbNodeCounts& counts() const noexcept { return counts_; }
  bool driver_bound() const noexcept { return driver_bound_; }

  void opened() noexcept { ++counts_.opened; }
  void closed(UMockdevIoctlClient* client);
  void ioctl(UMockdevIoctlClient* client);  // answers the request
  void advance(std::int64_t now_ns);        // advances the gadget and processes the transfers that are due
  void disconnect();

  UsbWireFaults faults;

 private:
  struct Urb {
    UMockdevIoctlClient* client = nullptr;
    IoctlData urb, buffer;
    std::uint8_t type = 0, endpoint = 0;
    std::int64_t due_ns = 0;
  };
  // The client's data for a request.
  struct RequestData {
    IoctlData data, buffer;
  };
  struct Result {
    long result = 0;
    int error = 0;
  };

  RequestData read(UMockdevIoctlClient* client, unsigned long request, UMockdevIoctlData* argument);
  Result handle(UMockdevIoctlClient* client, unsigned long request, UMockdevIoctlData* argument,
                RequestData request_data);
  Result claim(UMockdevIoctlClient* client, unsigned interface, bool detach);
  Result release(UMockdevIoctlClient* client, unsigned interface);
  Result clear_halt(unsigned endpoint);
  Result driver_ioctl(unsigned code);
  Result submit(UMockdevIoctlClient* client, RequestData request_data);
  Result discard(UMockdevIoctlData* argument);
  std::deque<Urb>::iterator find_completed(UMockdevIoctlClient* client);
  Result reap(UMockdevIoctlClient* client, UMockdevIoctlData* destination);

  bool has_claim(UMockdevIoctlClient* client, const Urb& urb);
  bool process(Urb& urb);  // false: the transfer is not finished yet
  bool process_control(Urb& urb);
  bool process_input(Urb& urb);
  bool process_output(Urb& urb);
  bool stall(Urb& urb);
  bool stalls_output();
  void finish(Urb& urb, int status, std::size_t length);
  void process_pending();

  UsbGadget& gadget_;
  std::mutex& bus_;
  HeldTerminal terminal_;
  UsbNodeCounts counts_;
  bool driver_bound_ = false, in_use_ = false, disconnected_ = false;
  std::int64_t now_ns_ = 0;
  std::map<UMockdevIoctlClient*, std::set<unsigned>> claimed_;
  std::set<unsigned> halted_;  // endpoints
  std::deque<Urb> pending_, completed_;
};

}  // namespace gearshift::test
