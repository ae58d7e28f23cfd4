#include <algorithm>
#include <numeric>

#include <doctest/doctest.h>

#include "tests/haptics/usb/usb_rig.h"

namespace gearshift::test {
namespace {

using Bytes = UsbGadget::Bytes;

haptics::HidBytes numbered_output(int number) {
  return report_of({5, static_cast<std::uint8_t>(number), 0, 0, 0, 0, 0, 0});
}

bool has_nothing_pending(UsbRig& rig) {
  const UsbNodeCounts counts = rig.usb.counts(rig.gadget);
  return counts.submitted == counts.returned && counts.misuses == 0;
}

}  // namespace

TEST_CASE("every input report comes through, whole, in order and with its time") {
  for (const bool numbered : {true, false}) {
    CAPTURE(numbered);
    UsbRig rig;
    rig.gadget.numbered = numbered;
    rig.usb.plug(rig.gadget);
    const auto port = rig.open();
    RecordingStream stream;
    haptics::StreamConfig config = stream.config();
    config.lever_report = numbered ? 1 : 0;
    config.silence_ns = 10'000'000'000;  // requests nothing
    Streaming streaming(*port, config, stream);
    CHECK(becomes_true([&] { return stream.input_count() >= 100; }));
    streaming.end();
    CHECK(streaming.error().empty());
    const std::vector<RecordingStream::Input> inputs = stream.inputs();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      REQUIRE(inputs[i].bytes == Bytes{static_cast<std::uint8_t>(numbered ? 1 : 0), static_cast<std::uint8_t>(i + 1),
                                       static_cast<std::uint8_t>((i + 1) >> 8), 0x34, 0x12});
      if (i > 0) REQUIRE(inputs[i].time_ns >= inputs[i - 1].time_ns);
    }
    CHECK(rig.gadget.idles == 1);  // SET_IDLE was sent once, at the start
    CHECK(has_nothing_pending(rig));
  }
}

TEST_CASE("each output arrives once, in order, and no two within one tick") {
  for (const bool has_out : {true, false}) {
    CAPTURE(has_out);
    UsbRig rig;
    rig.gadget.has_out = has_out;
    rig.usb.plug(rig.gadget);
    const auto port = rig.open();
    RecordingStream stream;
    Streaming streaming(*port, stream.config(), stream);
    for (int i = 0; i < 50; ++i) {
      stream.queue_output(numbered_output(i));
      if (i % 10 == 0) rest(3);
    }
    CHECK(becomes_true([&] { return stream.sent() == 50; }));
    streaming.end();
    CHECK(streaming.error().empty());
    REQUIRE(rig.gadget.outputs.size() == 50);
    for (int i = 0; i < 50; ++i) CHECK(rig.gadget.outputs[static_cast<std::size_t>(i)].bytes[1] == i);
    const std::vector<std::int64_t> times = stream.output_times();
    for (std::size_t i = 1; i < times.size(); ++i) CHECK(times[i] - times[i - 1] >= stream.config().tick_ns);
    CHECK(has_nothing_pending(rig));
  }
}

TEST_CASE("a wake-up acts immediately, not at the next tick") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  haptics::StreamConfig config = stream.config();
  config.tick_ns = 5'000'000'000;
  const auto start = std::chrono::steady_clock::now();
  Streaming streaming(*port, config, stream);
  CHECK(becomes_true([&] { return !stream.poll_times().empty(); }));
  stream.queue_output(numbered_output(1));
  CHECK(becomes_true([&] { return stream.sent() == 1; }));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::nanoseconds(config.tick_ns));
}

TEST_CASE("without wake-ups, next_output() is called at every tick") {
  UsbRig rig;
  rig.gadget.report_every = 0.0;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  haptics::StreamConfig config = stream.config();
  config.wake_fd = -1;
  config.tick_ns = 5'000'000;
  Streaming streaming(*port, config, stream);
  CHECK(becomes_true([&] { return stream.poll_times().size() >= 20; }));
  streaming.end();
  const std::vector<std::int64_t> poll_times = stream.poll_times();
  for (std::size_t i = 1; i < poll_times.size(); ++i) CHECK(poll_times[i] - poll_times[i - 1] >= config.tick_ns);
}

TEST_CASE("a silent lever is requested every silence_ns") {
  UsbRig rig;
  rig.gadget.report_every = 0.0;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  Streaming streaming(*port, stream.config(), stream);
  CHECK(becomes_true([&] { return stream.input_count() >= 10; }));
  streaming.end();
  const std::vector<RecordingStream::Input> inputs = stream.inputs();
  CHECK(inputs[0].bytes == Bytes{1, 0, 0, 0x34, 0x12});
  // The stream never requests a report early, so the mean interval is at least silence_ns. A late first answer can
  // shorten the mean, so the check allows 10 %.
  const std::int64_t mean =
      (inputs.back().time_ns - inputs.front().time_ns) / static_cast<std::int64_t>(inputs.size() - 1);
  CHECK(mean >= stream.config().silence_ns * 9 / 10);
}

TEST_CASE("a device that reports is not requested") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  haptics::StreamConfig config = stream.config();
  config.silence_ns = 2'000'000'000;
  Streaming streaming(*port, config, stream);
  CHECK(becomes_true([&] { return stream.input_count() >= 50; }));
  streaming.end();
  CHECK(rig.gadget.asked == 0);
}

TEST_CASE("a device that cannot be requested stalls twice and is not requested again") {
  UsbRig rig;
  rig.gadget.report_every = 0.0;
  rig.gadget.answers_get_report = false;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  Streaming streaming(*port, stream.config(), stream);
  CHECK(becomes_true([&] { return rig.query([](PlainGadget& gadget) { return gadget.asked; }) == 2; }));
  rest(60);
  streaming.end();
  CHECK(streaming.error().empty());
  CHECK(rig.gadget.asked == 2);
}

TEST_CASE("a device that sends nothing at all has failed") {
  UsbRig rig;
  rig.gadget.report_every = 0.0;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  rig.usb.set_faults(rig.gadget, {.control_stuck = true});
  RecordingStream stream;
  Streaming streaming(*port, stream.config(), stream);
  streaming.join();
  CHECK(streaming.error() == "Plain joystick (1209:0001) no longer responds");
  CHECK_FALSE(streaming.was_disconnected());
  CHECK(has_nothing_pending(rig));
}

TEST_CASE("a stalled input pipe is cleared once") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  Streaming streaming(*port, stream.config(), stream);
  CHECK(becomes_true([&] { return stream.input_count() >= 10; }));
  SUBCASE("it works again, and may stall again later") {
    for (int i = 0; i < 3; ++i) {
      rig.usb.set_faults(rig.gadget, {.input_stalls = 1});
      const std::size_t before = stream.input_count();
      CHECK(becomes_true([&] { return stream.input_count() >= before + 10; }));
    }
    streaming.end();
    CHECK(streaming.error().empty());
  }
  SUBCASE("it stalls again") {
    rig.usb.set_faults(rig.gadget, {.input_stalls = 1000});
    streaming.join();
    CHECK(streaming.error() == "Plain joystick (1209:0001) has stopped sending data. Unplug it and plug it in again.");
  }
  CHECK(has_nothing_pending(rig));
}

TEST_CASE("an output that stalls is sent once more") {
  for (const bool has_out : {true, false}) {
    CAPTURE(has_out);
    UsbRig rig;
    rig.gadget.has_out = has_out;
    rig.usb.plug(rig.gadget);
    const auto port = rig.open();
    RecordingStream stream;
    Streaming streaming(*port, stream.config(), stream);
    rig.usb.set_faults(rig.gadget, {.output_stalls = 1});
    stream.queue_output(numbered_output(7));
    CHECK(becomes_true([&] { return stream.sent() == 1; }));
    REQUIRE(rig.query([](PlainGadget& gadget) { return gadget.outputs.size(); }) == 1);
    CHECK(rig.query([](PlainGadget& gadget) { return gadget.outputs[0].bytes[1]; }) == 7);
    rig.usb.set_faults(rig.gadget, {.output_stalls = 1000});
    stream.queue_output(numbered_output(8));
    streaming.join();
    CHECK(streaming.error() ==
          "Plain joystick (1209:0001) has stopped accepting data. Unplug it and plug it in again.");
    rig.usb.set_faults(rig.gadget, {});
    CHECK_NOTHROW(port->send(numbered_output(9)));  // the device must still accept an output before it is closed
    CHECK(has_nothing_pending(rig));
  }
}

TEST_CASE("a device that no longer accepts outputs has failed, and reports until then") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  rig.usb.set_faults(rig.gadget, {.output_stuck = true});
  Streaming streaming(*port, stream.config(), stream);
  stream.queue_output(numbered_output(1));
  streaming.join();
  CHECK(streaming.error() == "Plain joystick (1209:0001) accepts no more reports");
  CHECK(stream.input_count() > 0);
  CHECK(stream.sent() == 0);
  CHECK(has_nothing_pending(rig));
}

TEST_CASE("bus errors are tolerated for a moment") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  haptics::StreamConfig config = stream.config();
  config.silence_ns = 10'000'000'000;
  Streaming streaming(*port, config, stream);
  rig.usb.set_faults(rig.gadget, {.garbled = true});
  rest(50);
  rig.usb.set_faults(rig.gadget, {});
  const std::size_t before = stream.input_count();
  CHECK(becomes_true([&] { return stream.input_count() >= before + 10; }));
  rig.usb.set_faults(rig.gadget, {.garbled = true});
  streaming.join();
  CHECK(streaming.error() == "Plain joystick (1209:0001) sends reports that are incomplete or too long");
  CHECK(has_nothing_pending(rig));
}

TEST_CASE("short reports are passed on unchanged, too long ones are not") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  haptics::StreamConfig config = stream.config();
  config.silence_ns = 10'000'000'000;
  SUBCASE("short") {
    rig.usb.set_faults(rig.gadget, {.extra_bytes = -2});
    Streaming streaming(*port, config, stream);
    CHECK(becomes_true([&] { return stream.input_count() >= 5; }));
    streaming.end();
    CHECK(stream.inputs()[0].bytes.size() == 3);
  }
  SUBCASE("longer than any that it declares") {
    rig.usb.set_faults(rig.gadget, {.extra_bytes = 1});
    Streaming streaming(*port, config, stream);
    const int before = rig.query([](PlainGadget& gadget) { return gadget.reports; });
    CHECK(becomes_true([&] { return rig.query([](PlainGadget& gadget) { return gadget.reports; }) > before + 10; }));
    streaming.end();
    CHECK(streaming.error().empty());
    CHECK(stream.input_count() == 0);
  }
  SUBCASE("longer than a packet") {
    rig.usb.set_faults(rig.gadget, {.extra_bytes = 40});
    Streaming streaming(*port, config, stream);
    streaming.join();
    CHECK(stream.input_count() == 0);
    CHECK(streaming.error() == "Plain joystick (1209:0001) sends reports that are incomplete or too long");
  }
}

TEST_CASE("a slow control pipe delays neither input nor output") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  rig.query([](PlainGadget& gadget) { return gadget.delay = 0.2; });
  RecordingStream stream;
  haptics::StreamConfig config = stream.config();
  config.lever_report = 9;  // report 9 never arrives, so the stream keeps requesting it
  Streaming streaming(*port, config, stream);
  CHECK(becomes_true([&] { return stream.input_count() >= 1; }));
  const std::size_t before = stream.input_count();
  for (int i = 0; i < 20; ++i) stream.queue_output(numbered_output(i));
  CHECK(becomes_true([&] { return stream.sent() == 20 && stream.input_count() >= before + 20; }));
  streaming.end();
  CHECK(streaming.error().empty());
  CHECK(has_nothing_pending(rig));
}

TEST_CASE("an unplugged device is gone, and no transfer stays pending") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  Streaming streaming(*port, stream.config(), stream);
  CHECK(becomes_true([&] { return stream.input_count() >= 10; }));
  SUBCASE("while it reports") {}
  SUBCASE("while an output waits") {
    rig.usb.set_faults(rig.gadget, {.output_stuck = true});
    stream.queue_output(numbered_output(1));
    rest(5);
  }
  SUBCASE("while it is asked") {
    rig.query([](PlainGadget& gadget) {
      gadget.report_every = 0.0;
      return gadget.delay = 0.2;
    });
    rest(20);
  }
  rig.usb.unplug(rig.gadget);
  streaming.join();
  CHECK(streaming.was_disconnected());
  CHECK(streaming.error() == "Plain joystick (1209:0001) was unplugged");
  CHECK(has_nothing_pending(rig));
}

TEST_CASE("a device without an interrupt IN endpoint cannot stream") {
  UsbRig rig;
  rig.gadget.has_in = false;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  RecordingStream stream;
  CHECK(sentence_of<haptics::HidError>([&] { port->stream(stream.config(), stream); }) ==
        "Plain joystick (1209:0001) has no interrupt endpoint for input reports");
}

}  // namespace gearshift::test
