#include "tests/support/usb/mock_usb.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/usb/usbfs_node.h"

namespace gearshift::test {
namespace {

namespace fs = std::filesystem;
constexpr std::int64_t kFrame = 1'000'000;     // [ns] period of the frames on a full-speed bus
constexpr std::int64_t kMaxLate = 3 * kFrame;  // [ns] later frames were missed

std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  std::array<char, 3> pair{};
  for (const std::uint8_t byte : bytes) {
    std::snprintf(pair.data(), pair.size(), "%02X", unsigned{byte});
    text += pair.data();
  }
  return text;
}

std::string padded(const char* format, unsigned number) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), format, number);
  return text.data();
}

// A device that is or was plugged in.
struct Plugged {
  Plugged(UsbGadget& gadget, const UsbPlug& a_plug, unsigned its_number, std::shared_ptr<std::mutex> lock)
      : mutex(std::move(lock)),
        node(gadget, *mutex, a_plug.driver_bound, a_plug.in_use),
        plug(a_plug),
        number(its_number) {}

  std::shared_ptr<std::mutex> mutex;  // the mutex of the bus
  UsbfsNode node;
  UsbPlug plug;
  unsigned number;  // device number on its bus
  bool is_connected = true;

  unsigned bus() const { return static_cast<unsigned>(std::stoul(plug.place)); }
  std::string device_node() const { return "/dev/bus/usb/" + padded("%03u", bus()) + "/" + padded("%03u", number); }
  std::string system_path() const { return "/sys/devices/pci0000:00/usb" + std::to_string(bus()) + "/" + plug.place; }
  std::string interface_path() const { return system_path() + "/" + plug.place + ":1.0"; }
  std::string driver_path() const { return interface_path() + "/0003:0000:0000." + padded("%04X", number); }
};

// ----------------------------------------------------------------------------------------- umockdev's handler class

using PluggedPtr = std::shared_ptr<Plugged>;  // shared, because a client may close its file after the bus is gone

struct NodeHandler {
  UMockdevIoctlBase parent;
};
struct NodeHandlerClass {
  UMockdevIoctlBaseClass parent;
};
G_DEFINE_TYPE(NodeHandler, node_handler, UMOCKDEV_TYPE_IOCTL_BASE)

constexpr const char* kPlugged = "plugged";

PluggedPtr& plugged_of(UMockdevIoctlBase* handler) {
  return *static_cast<PluggedPtr*>(g_object_get_data(G_OBJECT(handler), kPlugged));
}

gboolean handle_ioctl(UMockdevIoctlBase* self, UMockdevIoctlClient* client) {
  plugged_of(self)->node.ioctl(client);
  return TRUE;
}

// umockdev keeps its client object until the file is closed, and then calls this function.
void client_closed(gpointer data, GObject* client) {
  const std::unique_ptr<PluggedPtr> plugged(static_cast<PluggedPtr*>(data));
  const std::lock_guard<std::mutex> lock(*(*plugged)->mutex);
  (*plugged)->node.closed(reinterpret_cast<UMockdevIoctlClient*>(client));
}

void client_connected(UMockdevIoctlBase* self, UMockdevIoctlClient* client) {
  const PluggedPtr& plugged = plugged_of(self);
  g_object_weak_ref(G_OBJECT(client), client_closed, new PluggedPtr(plugged));
  const std::lock_guard<std::mutex> lock(*plugged->mutex);
  plugged->node.opened();
}

void node_handler_class_init(NodeHandlerClass* type) {
  reinterpret_cast<UMockdevIoctlBaseClass*>(type)->handle_ioctl = handle_ioctl;
  reinterpret_cast<UMockdevIoctlBaseClass*>(type)->client_connected = client_connected;
}
void node_handler_init(NodeHandler*) {}

using GObjectPtr = std::unique_ptr<void, Unref>;

// Drops the critical message that umockdev logs if a client dies while umockdev answers it. The message is harmless.
void filter_log(const gchar* domain, GLogLevelFlags level, const gchar* message, gpointer data) {
  if (std::string_view(message).find("IoctlClient with open stream") == std::string_view::npos) {
    g_log_default_handler(domain, level, message, data);
  }
}

void check(GError* error) {
  if (error == nullptr) return;
  const std::string message = error->message;
  g_error_free(error);
  throw std::runtime_error(message);
}

}  // namespace

struct MockUsb::State {
  GObjectPtr testbed;
  std::string root;
  std::shared_ptr<std::mutex> mutex = std::make_shared<std::mutex>();
  std::vector<PluggedPtr> all;  // including the unplugged devices
  unsigned next_number = 2;
  std::atomic<bool> end{false};
  std::thread frames;

  UMockdevTestbed* bed() const { return static_cast<UMockdevTestbed*>(testbed.get()); }

  Plugged& last(const UsbGadget& gadget) const {
    const auto found =
        std::find_if(all.rbegin(), all.rend(), [&](const auto& each) { return &each->node.gadget() == &gadget; });
    if (found == all.rend()) throw std::runtime_error("it was never plugged in");
    return **found;
  }

  void run();
  void make_node(const Plugged& plugged);
  void attach_handler(const PluggedPtr& plugged);
  void announce(Plugged& plugged);
  std::string device_text(Plugged& plugged) const;
  std::string driver_text(Plugged& plugged) const;
};

// Simulates the frames of the host controller: in each frame, processes the transfers that are due. A thread that was
// stopped does not make up for the frames that it missed, because the program had no time to answer between them.
void MockUsb::State::run() {
  prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0);
  timespec next{};
  clock_gettime(CLOCK_MONOTONIC, &next);
  std::int64_t at = next.tv_sec * 1'000'000'000 + next.tv_nsec;
  while (!end) {
    at += kFrame;
    next = {at / 1'000'000'000, at % 1'000'000'000};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
    clock_gettime(CLOCK_MONOTONIC, &next);
    if (const std::int64_t now = next.tv_sec * 1'000'000'000 + next.tv_nsec; now - at > kMaxLate) at = now;
    const std::lock_guard<std::mutex> lock(*mutex);
    for (const auto& each : all) {
      if (each->is_connected) each->node.advance(at);
    }
  }
}

// Makes the device's node in the test bed's /dev: a symbolic link to the terminal of its UsbfsNode.
void MockUsb::State::make_node(const Plugged& plugged) {
  const fs::path link = root + plugged.device_node();
  fs::create_directories(link.parent_path());
  fs::create_symlink(plugged.node.path(), link);
  chmod(plugged.node.path().c_str(), plugged.plug.permitted ? 0666 : 0);
}

void MockUsb::State::attach_handler(const PluggedPtr& plugged) {
  const GObjectPtr handler(g_object_new(node_handler_get_type(), nullptr));
  g_object_set_data_full(G_OBJECT(handler.get()), kPlugged, new PluggedPtr(plugged),
                         [](gpointer data) { delete static_cast<PluggedPtr*>(data); });
  GError* error = nullptr;
  umockdev_testbed_attach_ioctl(bed(), plugged->device_node().c_str(), static_cast<UMockdevIoctlBase*>(handler.get()),
                                &error);
  check(error);
  chmod((root + "/ioctl" + plugged->device_node()).c_str(), 0666);  // gives every user access to umockdev's socket
}

std::string MockUsb::State::device_text(Plugged& plugged) const {
  UsbGadget& gadget = plugged.node.gadget();
  const UsbGadget::Bytes device = gadget.device_descriptor();
  const std::string bus = std::to_string(plugged.bus()), number = std::to_string(plugged.number);
  std::string text = "P: " + plugged.system_path().substr(4) +
                     "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: DEVNAME=" + plugged.device_node() +
                     "\nE: BUSNUM=" + padded("%03u", plugged.bus()) + "\nE: DEVNUM=" + padded("%03u", plugged.number) +
                     "\nE: MAJOR=189\nE: MINOR=" + std::to_string((plugged.bus() - 1) * 128 + plugged.number - 1) +
                     "\n";
  const auto attribute = [&text](const char* name, const std::string& value) {
    if (!value.empty()) text += std::string("A: ") + name + "=" + value + "\\n\n";
  };
  attribute("busnum", bus);
  attribute("devnum", number);
  attribute("bConfigurationValue", "1");
  attribute("bNumConfigurations", "1");
  attribute("speed", "12");
  attribute("idVendor", padded("%04x", device[8] | unsigned{device[9]} << 8));
  attribute("idProduct", padded("%04x", device[10] | unsigned{device[11]} << 8));
  attribute("manufacturer", gadget.string_descriptor(1));
  attribute("product", gadget.string_descriptor(2));
  attribute("serial", gadget.string_descriptor(3));
  return text + "H: descriptors=" + hex(device) + hex(gadget.configuration_descriptor()) + "\n\n";
}

// Describes the HID device and the interface in sysfs, as after the kernel's HID driver has read the report descriptor.
std::string MockUsb::State::driver_text(Plugged& plugged) const {
  UsbGadget& gadget = plugged.node.gadget();
  const std::string hid = plugged.driver_path().substr(4), interface = plugged.interface_path().substr(4);
  return "P: " + hid + "\nE: SUBSYSTEM=hid\nH: report_descriptor=" + hex(gadget.report_descriptor()) +
         "\n\nP: " + interface + "\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\n\n";
}

void MockUsb::State::announce(Plugged& plugged) {
  GError* error = nullptr;
  const std::string text = (plugged.node.driver_bound() ? driver_text(plugged) : std::string()) + device_text(plugged);
  umockdev_testbed_add_from_string(bed(), text.c_str(), &error);
  check(error);
}

MockUsb::MockUsb() : state_(std::make_unique<State>()) {
  g_log_set_handler(nullptr, G_LOG_LEVEL_CRITICAL, filter_log, nullptr);
  state_->testbed.reset(umockdev_testbed_new());
  if (umockdev_in_mock_environment() == 0) throw std::runtime_error("start this program with umockdev-wrapper");
  gchar* root = umockdev_testbed_get_root_dir(state_->bed());
  state_->root = root;
  g_free(root);
  chmod(state_->root.c_str(), 0777);  // lets tests run as a user without access to the device
  state_->frames = std::thread([this] { state_->run(); });
}

// NOLINTNEXTLINE(bugprone-exception-escape): a failed teardown ends the test
MockUsb::~MockUsb() {
  state_->end = true;
  state_->frames.join();
  for (const auto& each : state_->all) {
    if (each->is_connected) unplug(each->node.gadget());
  }
}

void MockUsb::plug(UsbGadget& gadget, const UsbPlug& plug) {
  const auto plugged = std::make_shared<Plugged>(gadget, plug, state_->next_number++, state_->mutex);
  state_->make_node(*plugged);
  state_->attach_handler(plugged);
  {
    const std::lock_guard<std::mutex> lock(*state_->mutex);
    state_->all.push_back(plugged);
  }
  state_->announce(*plugged);  // also sends udev's "add" event
}

void MockUsb::unplug(UsbGadget& gadget) {
  Plugged& plugged = state_->last(gadget);
  {
    const std::lock_guard<std::mutex> lock(*state_->mutex);
    if (!plugged.is_connected) return;
    plugged.is_connected = false;
    plugged.node.disconnect();
  }
  fs::remove(state_->root + plugged.device_node());
  umockdev_testbed_uevent(state_->bed(), plugged.system_path().c_str(), "remove");
  for (const std::string& path : {plugged.driver_path(), plugged.interface_path(), plugged.system_path()}) {
    if (fs::exists(state_->root + path)) umockdev_testbed_remove_device(state_->bed(), path.c_str());
  }
  GError* error = nullptr;
  umockdev_testbed_detach_ioctl(state_->bed(), plugged.device_node().c_str(), &error);
  check(error);
}

UsbNodeCounts MockUsb::counts(UsbGadget& gadget) const {
  const std::lock_guard<std::mutex> lock(*state_->mutex);
  return state_->last(gadget).node.counts();
}

bool MockUsb::driver_bound(UsbGadget& gadget) const {
  const std::lock_guard<std::mutex> lock(*state_->mutex);
  return state_->last(gadget).node.driver_bound();
}

void MockUsb::set_faults(UsbGadget& gadget, const UsbWireFaults& faults) {
  const std::lock_guard<std::mutex> lock(*state_->mutex);
  state_->last(gadget).node.faults = faults;
}

std::mutex& MockUsb::mutex() const {
  return *state_->mutex;
}

}  // namespace gearshift::test
