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

// Not thread-safe: callers must hold the bus lock, except for ioctl(), which takes it.
class UsbfsNode {
 public:
  // Gadget and lock must outlive it. driver_bound: the kernel's HID driver is bound; taken: another program uses it.
  UsbfsNode(UsbGadget& gadget, std::mutex& bus, bool driver_bound, bool taken);

  const std::string& path() const noexcept { return terminal_.path(); }
  UsbGadget& gadget() noexcept { return gadget_; }
  const UsbNodeCounts& counts() const noexcept { return counts_; }
  bool driver_bound() const noexcept { return driver_bound_; }

  void opened() noexcept { ++counts_.opened; }
  void closed(UMockdevIoctlClient* client);
  void ioctl(UMockdevIoctlClient* client);  // answers the request
  void advance(std::int64_t now_ns);        // advances the gadget and processes everything that is due
  void disconnect();

  UsbWireFaults faults;

 private:
  struct Urb {
    UMockdevIoctlClient* client = nullptr;
    IoctlData urb, buffer;
    std::uint8_t type = 0, endpoint = 0;
    std::int64_t due_ns = 0;
  };
  // The data of a request.
  struct RequestData {
    IoctlData data, buffer;
  };
  struct Answer {
    long result = 0;
    int error = 0;
  };

  RequestData read(UMockdevIoctlClient* client, unsigned long request, UMockdevIoctlData* argument);
  Answer answer(UMockdevIoctlClient* client, unsigned long request, UMockdevIoctlData* argument,
                RequestData request_data);
  Answer claim(UMockdevIoctlClient* client, unsigned interface, bool detach);
  Answer release(UMockdevIoctlClient* client, unsigned interface);
  Answer clear_halt(unsigned endpoint);
  Answer drive(unsigned code);
  Answer submit(UMockdevIoctlClient* client, RequestData request_data);
  Answer discard(UMockdevIoctlData* argument);
  std::deque<Urb>::iterator done_for(UMockdevIoctlClient* client);
  Answer reap(UMockdevIoctlClient* client, UMockdevIoctlData* where);

  bool may_use(UMockdevIoctlClient* client, const Urb& urb);
  bool carry(Urb& urb);  // false: not finished yet
  bool carry_control(Urb& urb);
  bool carry_input(Urb& urb);
  bool carry_output(Urb& urb);
  bool stall(Urb& urb);
  bool stalls_output();
  void finish(Urb& urb, int status, std::size_t length);
  void carry_all();

  UsbGadget& gadget_;
  std::mutex& bus_;
  HeldTerminal terminal_;
  UsbNodeCounts counts_;
  bool driver_bound_ = false, taken_ = false, gone_ = false;
  std::int64_t now_ns_ = 0;
  std::map<UMockdevIoctlClient*, std::set<unsigned>> claimed_;
  std::set<unsigned> halted_;  // endpoints
  std::deque<Urb> pending_, done_;
};

}  // namespace gearshift::test
