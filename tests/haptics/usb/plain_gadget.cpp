#include "tests/haptics/usb/plain_gadget.h"

#include <time.h>

#include <cstddef>

namespace gearshift::test {
namespace {

using Bytes = UsbGadget::Bytes;

std::int64_t clock_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

std::uint8_t low(std::size_t value) {
  return static_cast<std::uint8_t>(value & 0xff);
}
std::uint8_t high(std::size_t value) {
  return static_cast<std::uint8_t>(value >> 8);
}

void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

Bytes PlainGadget::device_descriptor() const {
  return {18,
          1,
          0,
          2,
          0,
          0,
          0,
          64,
          0x09,
          0x12,
          low(product),
          high(product),
          0,
          1,
          1,
          2,
          std::uint8_t{serial.empty() ? std::uint8_t{0} : std::uint8_t{3}},
          1};
}

Bytes PlainGadget::configuration_descriptor() const {
  const std::size_t length =
      declared_length >= 0 ? static_cast<std::size_t>(declared_length) : report_descriptor().size();
  const std::size_t endpoints = std::size_t{has_in} + std::size_t{has_out};
  Bytes bytes{9, 2, low(27 + 7 * endpoints), 0, 1, 1, 0, 0x80, 50};
  append(bytes, {9, 4, 0, 0, low(endpoints), interface_class, 0, 0, 0});
  append(bytes, {9, 0x21, 0x11, 1, 0, 1, 0x22, low(length), high(length)});
  if (has_in) append(bytes, {7, 5, 0x81, 3, 16, 0, 1});
  if (has_out) append(bytes, {7, 5, 0x02, 3, 16, 0, 1});
  return bytes;
}

// Report 1 (input) has X and Y of 16 bits, report 2 (feature) has four bytes, report 5 (output) has seven bytes.
Bytes PlainGadget::report_descriptor() const {
  Bytes bytes{0x05, 0x01, 0x09, 0x04, 0xa1, 0x01};
  if (numbered) append(bytes, {0x85, 1});
  append(bytes, {0x09, 0x30, 0x09, 0x31, 0x16, 0x00, 0x80, 0x26, 0xff, 0x7f, 0x75, 16, 0x95, 2, 0x81, 0x02});
  append(bytes, {0x06, 0x00, 0xff, 0x15, 0x00, 0x26, 0xff, 0x00, 0x75, 8});
  if (numbered) append(bytes, {0x85, 2});
  append(bytes, {0x09, 0x01, 0x95, 4, 0xb1, 0x02});
  if (numbered) append(bytes, {0x85, 5});
  append(bytes, {0x09, 0x02, 0x95, 7, 0x91, 0x02, 0xc0});
  return bytes;
}

std::string PlainGadget::string_descriptor(int index) const {
  if (index == 1) return "Plain maker";
  return index == 2 ? name : serial;
}

Bytes PlainGadget::without_id(Bytes report) const {
  if (!numbered) report.erase(report.begin());
  return report;
}

Bytes PlainGadget::lever_report(int count) const {
  const auto value = static_cast<std::size_t>(count & 0x7fff);
  return without_id({1, low(value), high(value), 0x34, 0x12});
}

std::optional<Bytes> PlainGadget::control(const UsbSetup& setup, std::span<const std::uint8_t> data) {
  if (setup.request_type == 0x81 && setup.request == 6 && setup.value == 0x2200) return report_descriptor();
  const int type = setup.value >> 8;
  if (setup.request_type == 0xa1 && setup.request == 1) {
    if (type == 3) return without_id(feature);
    ++asked;
    if (type != 1 || !answers_get_report) return std::nullopt;
    return lever_report(reports);
  }
  if (setup.request_type != 0x21) return std::nullopt;
  if (setup.request == 0x0a) ++idles;
  if (setup.request == 9) (type == 3 ? features : outputs).push_back({clock_ns(), Bytes(data.begin(), data.end())});
  return Bytes();
}

bool PlainGadget::output(std::span<const std::uint8_t> report) {
  outputs.push_back({clock_ns(), Bytes(report.begin(), report.end())});
  return true;
}

std::optional<Bytes> PlainGadget::input() {
  if (report_every <= 0.0 || now_ns_ - reported_ns_ < static_cast<std::int64_t>(1e9 * report_every))
    return std::nullopt;
  reported_ns_ = now_ns_;
  return lever_report(++reports);
}

}  // namespace gearshift::test
