#include "haptics/hardware/pid_setup.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

namespace gearshift::haptics {
namespace {

constexpr int kBlockLoadPolls = 60;                       // as in Linux
constexpr std::chrono::milliseconds kPollPause{1};        // between two polls
constexpr std::chrono::milliseconds kMaxSilencing{1000};  // for reports that switch the motors off
constexpr std::chrono::milliseconds kRetryPause{5};       // between two rounds of them

constexpr const char* kEndless =
    "the stick's effects do not end by themselves; if this program crashes, unplug the stick to stop the last force";
constexpr const char* kNoReset = "the stick cannot be reset, so effects of another program may continue until they end";
constexpr const char* kNoSwitch =
    "the stick's motors cannot be switched off; they are quiet only while no force is commanded";

class StickSetup {
 public:
  StickSetup(HidPort& port, const PidLayout& pid, StickStyle style) : port_(port), pid_(pid), style_(style) {}

  PreparedStick run() {
    read_pool();
    reset_device();
    make(StickEffect::constant_x);
    make(StickEffect::constant_y);
    if (has_conditions(PidEffect::spring)) result_.ability.spring = try_to_make(StickEffect::spring);
    if (has_conditions(PidEffect::damper)) result_.ability.damper = try_to_make(StickEffect::damper);
    send(PidControl::disable_actuators);
    send(encode_gain(pid_, 1.0));
    return std::move(result_);
  }

  const StickBlocks& blocks() const noexcept { return result_.blocks; }

 private:
  void note(const std::string& sentence) { result_.ability.notes.push_back(sentence); }
  void send(const HidBytes& report) {
    if (report.size > 0) port_.send(report);
  }
  void send(PidControl control) { send(encode_control(pid_, control)); }
  bool supports(PidControl control) const {
    return pid_.device_control.control.supports(static_cast<std::size_t>(control));
  }

  // Requests the optional pool report, only to note a stick that does not answer. The answer itself is not needed,
  // because creating an effect fails if the device's memory is full.
  void read_pool() {
    if (!pid_.pool.exists()) return;
    try {
      (void)port_.get_feature(pid_.pool.id, pid_.pool.size);
    } catch (const HidDisconnected&) {
      throw;
    } catch (const HidError&) {
      note("the stick does not report how many effects it can store");
    }
  }

  void reset_device() {
    if (!supports(PidControl::reset)) note(kNoReset);
    if (!supports(PidControl::enable_actuators) || !supports(PidControl::disable_actuators)) note(kNoSwitch);
    send(PidControl::stop_all);
    send(PidControl::reset);
    send(PidControl::stop_all);
    send(PidControl::disable_actuators);
    send(encode_gain(pid_, 0.0));
  }

  bool has_conditions(PidEffect effect) {
    if (pid_.has_effect(effect) && pid_.set_condition.exists()) return true;
    note(std::string("the stick has no ") + to_string(effect) + " effect");
    return false;
  }

  bool try_to_make(StickEffect effect) {
    try {
      make(effect);
      return true;
    } catch (const HidDisconnected&) {
      throw;
    } catch (const HidError& error) {
      note(std::string("the stick is used without a ") + to_string(kind_of(effect)) + "; " + error.what());
      return false;
    }
  }

  void make(StickEffect effect) {
    const auto index = static_cast<std::size_t>(effect);
    const int block = create(kind_of(effect));
    if (std::find(result_.blocks.begin(), result_.blocks.end(), block) != result_.blocks.end())
      throw HidError("the stick assigned effect block " + std::to_string(block) + " twice; this stick cannot be used");
    set(effect, block);
    result_.blocks[index] = block;
    ++result_.ability.blocks;
  }

  // On a device without a Create report, the effects exist from the start, as blocks 1, 2, ...
  int create(PidEffect effect) {
    if (!pid_.create.exists()) return ++implicit_blocks_;
    const std::string refuses = std::string("a ") + to_string(effect) + " cannot be created, because ";
    const HidBytes report = encode_create(pid_, effect);
    if (report.size == 0) throw HidError(refuses + "the stick does not support this effect");
    const bool is_first = !std::exchange(has_created_, true);
    BlockLoad load;
    try {
      load = create_once(report);
    } catch (const HidDisconnected&) {
      throw;
    } catch (const HidError&) {
      if (!is_first) throw;
      load.status = BlockLoad::Status::full;
    }
    // Some firmware refuses its first effect after power-on.
    if (is_first && load.status == BlockLoad::Status::full) load = create_once(report);
    if (load.status == BlockLoad::Status::full)
      throw HidError(refuses + "the stick's memory for effects is full; unplug it and plug it in again");
    if (load.status == BlockLoad::Status::error) throw HidError(refuses + "the stick reports an error");
    if (load.status == BlockLoad::Status::pending) throw HidError(refuses + "the stick does not confirm the effect");
    if (load.block == kNoBlock) throw HidError(refuses + "the stick assigns no effect block");
    return load.block;
  }

  BlockLoad create_once(const HidBytes& report) {
    port_.set_feature(report);
    if (!pid_.block_load.exists()) return {++implicit_blocks_, BlockLoad::Status::success};
    return poll_block_load();
  }

  BlockLoad poll_block_load() {
    BlockLoad load;
    for (int poll = 0; poll < kBlockLoadPolls && load.status == BlockLoad::Status::pending; ++poll) {
      if (poll > 0) std::this_thread::sleep_for(kPollPause);
      load = block_load();
    }
    return load;
  }

  BlockLoad block_load() {
    const HidBytes report = port_.get_feature(pid_.block_load.id, pid_.block_load.size);
    return decode_block_load(pid_, report.view()).value_or(BlockLoad{});
  }

  // Sets an effect with a finite duration. If the device refuses a duration for the first effect, all effects are
  // endless.
  void set(StickEffect effect, int block) {
    PidAbility& ability = result_.ability;
    if (accepts(effect, block, ability.finite ? kEffectDuration : kForever)) return;
    if (ability.blocks > 0 || !accepts(effect, block, kForever))
      throw HidError(std::string("the stick rejects all parameters of a ") + to_string(kind_of(effect)));
    ability.finite = false;
    note(kEndless);
  }

  bool accepts(StickEffect effect, int block, double duration) {
    const EffectReports reports(pid_, effect, block, style_, duration);
    if (!reports.has_settings())
      throw HidError("the stick assigned effect block " + std::to_string(block) +
                     ", a number that its own reports cannot hold; this stick cannot be used");
    try {
      for (const HidBytes& report : reports.all()) port_.send(report);
    } catch (const HidDisconnected&) {
      throw;
    } catch (const HidError&) {
      return false;
    }
    const bool is_known = result_.ability.blocks > 0 || duration == kForever;
    if (is_known || !pid_.create.exists() || !pid_.block_load.exists()) return true;
    const BlockLoad load = block_load();
    return load.status != BlockLoad::Status::error || load.block != block;
  }

  HidPort& port_;
  const PidLayout& pid_;
  StickStyle style_;
  PreparedStick result_;
  bool has_created_ = false;
  int implicit_blocks_ = 0;  // blocks numbered by this program, for a device without Create or Block Load
};

// Sends the last reports, some of which may be lost.
class Silencer {
 public:
  explicit Silencer(HidPort& port) noexcept : port_(port) {}

  bool send(const HidBytes& report) noexcept {  // true if it was accepted, or if there is none
    if (report.size == 0) return true;
    if (is_gone_) return false;
    try {
      port_.send(report);
      return true;
    } catch (const HidDisconnected&) {
      is_gone_ = true;
    } catch (...) {
    }
    return false;
  }

  // Repeats the reports until each was accepted, the stick is gone, or the time is over. A stick may refuse one of them
  // for good, so all are tried in turn. Returns false if one was not accepted.
  bool send_surely(std::vector<HidBytes> reports) noexcept {
    for (;;) {
      std::erase_if(reports, [&](const HidBytes& report) { return send(report); });
      if (reports.empty()) return true;
      if (is_gone_ || Clock::now() > end_) return false;
      std::this_thread::sleep_for(kRetryPause);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  HidPort& port_;
  Clock::time_point end_ = Clock::now() + kMaxSilencing;
  bool is_gone_ = false;
};

}  // namespace

PreparedStick prepare_stick(HidPort& port, const PidLayout& pid, StickStyle style) {
  StickSetup setup(port, pid, style);
  try {
    return setup.run();
  } catch (const HidDisconnected&) {
    throw;
  } catch (const HidError&) {
    silence_stick(port, pid, setup.blocks());
    throw;
  }
}

void silence_stick(HidPort& port, const PidLayout& pid, const StickBlocks& blocks) noexcept {
  Silencer silencer(port);
  std::vector<HidBytes> off;
  for (const int block : blocks) off.push_back(encode_operation(pid, block, PidOperation::stop, 0));
  off.push_back(encode_control(pid, PidControl::stop_all));
  off.push_back(encode_control(pid, PidControl::disable_actuators));
  // A reset switches the actuators on, so it is sent only to a stick that accepts outputs.
  if (!silencer.send_surely(off)) return;
  for (const int block : blocks) silencer.send(encode_block_free(pid, block));
  silencer.send(encode_control(pid, PidControl::reset));
  silencer.send_surely({encode_control(pid, PidControl::stop_all), encode_control(pid, PidControl::disable_actuators)});
}

}  // namespace gearshift::haptics
