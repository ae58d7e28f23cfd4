// This work is based on:
// The Linux kernel's documentation of USB/IP: usb/usbip_protocol.rst
#include "tests/guest/attached_stick.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace gearshift::test {
namespace {

constexpr std::uint32_t kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4;
constexpr std::uint32_t kFromDevice = 1;
constexpr const char* kController = "/sys/devices/platform/vhci_hcd.0/";
constexpr int kFullSpeed = 2;                            // enum usb_device_speed
constexpr unsigned kDevice = 0x10002;                    // bus 1, device 2: invented numbers
constexpr std::chrono::microseconds kPollInterval{500};  // how often the stick is polled for reports

// The header of a USB/IP message, with big-endian numbers.
struct Message {
  std::uint32_t command = 0, number = 0, device = 0, direction = 0, endpoint = 0;
  // The contents depend on the kind of message. A submit has flags, length and so on. An unlink has the number of the
  // request to cancel. A reply has status, length and so on.
  std::array<std::uint32_t, 5> word{};
  std::array<std::uint8_t, 8> setup{};
};
static_assert(sizeof(Message) == 48);

Message swapped(Message m) {
  for (std::uint32_t* word : {&m.command, &m.number, &m.device, &m.direction, &m.endpoint}) *word = ntohl(*word);
  for (std::uint32_t& word : m.word) word = ntohl(word);
  return m;
}

bool read_all(int fd, void* to, std::size_t size) {
  auto* bytes = static_cast<std::uint8_t*>(to);
  while (size > 0) {
    const ssize_t got = read(fd, bytes, size);
    if (got <= 0) return false;
    bytes += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

// Ignores errors, because the next read from the socket detects a closed connection.
void send_all(int fd, const void* from, std::size_t size) {
  [[maybe_unused]] const ssize_t sent = send(fd, from, size, MSG_NOSIGNAL);
}

UsbSetup setup_of(const std::array<std::uint8_t, 8>& s) {
  const auto word = [&](std::size_t at) { return static_cast<std::uint16_t>(s[at] | s[at + 1] << 8); };
  return {s[0], s[1], word(2), word(4), word(6)};
}

std::int64_t monotonic_ns() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void write_controller_file(const char* file, const std::string& text) {
  std::ofstream out(std::string(kController) + file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(std::string("The virtual host controller does not take ") + file + " " + text);
}

}  // namespace

struct AttachedStick::Wire {
  Wire(EmulatedStick& its, std::mutex& guard) : stick(its), mutex(guard) {
    std::array<int, 2> pair{};
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, pair.data()) != 0) throw std::runtime_error("No socket for USB/IP");
    server_socket = pair[0];
    kernel_socket = pair[1];
  }
  ~Wire() {
    close(server_socket);
    close(kernel_socket);
  }

  void handle_requests();
  void run_clock();
  void submit(const Message& request, std::vector<std::uint8_t> data);
  void unlink(const Message& request);
  void send_reply(const Message& request, std::int32_t status, std::size_t length, std::span<const std::uint8_t> data);
  void reply_to_inputs();

  EmulatedStick& stick;
  std::mutex& mutex;  // guards the stick, the pending requests and writes to the socket
  int server_socket = -1, kernel_socket = -1;
  std::deque<Message> pending;  // requests for reports that are not available yet
  bool is_ending = false;
  std::thread server, clock;
};

// Serves the kernel's requests until the connection is closed.
void AttachedStick::Wire::handle_requests() {
  Message request;
  while (read_all(server_socket, &request, sizeof request)) {
    request = swapped(request);
    const bool sends = request.command == kSubmit && request.direction != kFromDevice;
    std::vector<std::uint8_t> data(sends ? request.word[1] : 0);
    if (!read_all(server_socket, data.data(), data.size())) return;
    if (request.command == kUnlink) {
      unlink(request);
    } else {
      submit(request, std::move(data));
    }
  }
}

// Advances the stick's time, and answers pending requests as soon as the stick has a report.
void AttachedStick::Wire::run_clock() {
  auto next = std::chrono::steady_clock::now();
  for (;;) {
    next = std::max(next + kPollInterval, std::chrono::steady_clock::now() - kPollInterval);
    std::this_thread::sleep_until(next);
    const std::lock_guard lock(mutex);
    if (is_ending) return;
    stick.advance(monotonic_ns());
    reply_to_inputs();
  }
}

void AttachedStick::Wire::submit(const Message& request, std::vector<std::uint8_t> data) {
  const bool is_control = request.endpoint == 0;
  std::unique_lock lock(mutex);
  if (is_control && stick.faults.slow > 0.0) {
    const std::chrono::duration<double> slow(stick.faults.slow);
    lock.unlock();
    std::this_thread::sleep_for(slow);
    lock.lock();
  }
  stick.advance(monotonic_ns());
  if (is_control) {
    const auto reply = stick.control(setup_of(request.setup), data);
    const std::size_t length = !reply ? 0 : request.direction == kFromDevice ? reply->size() : data.size();
    send_reply(request, reply ? 0 : -EPIPE, length, reply ? std::span(*reply) : std::span<const std::uint8_t>{});
  } else if (request.direction == kFromDevice) {
    pending.push_back(request);
    reply_to_inputs();
  } else {
    const bool accepted = stick.output(data);
    send_reply(request, accepted ? 0 : -EPIPE, accepted ? data.size() : 0, {});
  }
}

void AttachedStick::Wire::reply_to_inputs() {
  while (!pending.empty()) {
    std::optional<std::vector<std::uint8_t>> report = stick.input();
    if (!report) return;
    const Message request = pending.front();
    pending.pop_front();
    report->resize(std::min<std::size_t>(report->size(), request.word[1]));
    send_reply(request, 0, report->size(), *report);
  }
}

void AttachedStick::Wire::unlink(const Message& request) {
  const std::lock_guard lock(mutex);
  const auto has_number = [&](const Message& m) { return m.number == request.word[0]; };
  const auto found = std::find_if(pending.begin(), pending.end(), has_number);
  Message reply;
  reply.command = kUnlinked;
  reply.number = request.number;
  reply.word[0] = found == pending.end() ? 0 : static_cast<std::uint32_t>(-ECONNRESET);
  if (found != pending.end()) pending.erase(found);
  reply = swapped(reply);
  send_all(server_socket, &reply, sizeof reply);
}

void AttachedStick::Wire::send_reply(const Message& request, std::int32_t status, std::size_t length,
                                     std::span<const std::uint8_t> data) {
  Message reply;
  reply.command = kSubmitted;
  reply.number = request.number;
  reply.word[0] = static_cast<std::uint32_t>(status);
  reply.word[1] = static_cast<std::uint32_t>(length);
  reply = swapped(reply);
  std::vector<std::uint8_t> bytes(sizeof reply);
  std::memcpy(bytes.data(), &reply, sizeof reply);
  bytes.insert(bytes.end(), data.begin(), data.end());
  send_all(server_socket, bytes.data(), bytes.size());
}

AttachedStick::AttachedStick(EmulatedStick& stick, std::mutex& mutex) : wire_(std::make_unique<Wire>(stick, mutex)) {
  write_controller_file("attach", "0 " + std::to_string(wire_->kernel_socket) + " " + std::to_string(kDevice) + " " +
                                      std::to_string(kFullSpeed));
  wire_->server = std::thread([this] { wire_->handle_requests(); });
  wire_->clock = std::thread([this] { wire_->run_clock(); });
}

AttachedStick::~AttachedStick() {
  try {
    write_controller_file("detach", "0");
  } catch (const std::runtime_error&) {  // already detached
  }
  {
    const std::lock_guard lock(wire_->mutex);
    wire_->is_ending = true;
    wire_->stick.unplug();
  }
  shutdown(wire_->server_socket, SHUT_RDWR);
  wire_->server.join();
  wire_->clock.join();
}

}  // namespace gearshift::test
