// The experiment of section 2.4: sinusoids of force into one axis, gain and phase of the motion out of it.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Eqs (8)-(10). Erratum: one third of the greatest force is possible above some 5.4 Hz only; at 1 Hz it would take
// 484 mm, and the stop is at 84 mm of arc. So the amplitude is the smaller of that third and 60 % of the stroke.
//
// Works on every device that can be driven, in the plant's coordinates: along the arcs where the device has a yoke.
// Take the hand off the lever. A force sensor makes up for a hand that rests or pulls, not for one that moves along:
// its mass answers every step of the held force between two samples. At 1 kHz a grip makes the mass 5 % too large.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "haptics/analysis/harmonic_fit.h"
#include "haptics/device/haptic_device.h"
#include "haptics/safety/force_guard.h"

namespace gearshift {

enum class LeverAxis : std::uint8_t { x, y };  // select, shift

struct SweepConfig {
  double highest = 65.0;           // [Hz] up to 0.4 of the sample rate; the paper stopped there
  double lowest = 0.2;             // [Hz] 0.01 to highest
  int points = 24;                 // [1] 1 to 200, even in the logarithm, from the highest down
  double force_share = 1.0 / 3.0;  // [1] 0.001 to 1 of the device's greatest force: the paper's alpha
  double stroke_share = 0.6;       // [1] 0.05 to 0.7 of the way to the stop
  bool literal = false;            // the paper's alpha whatever the stroke: simulated devices only
};

enum class PointEnd : std::uint8_t {
  measured,
  never_settled,  // the response went on changing: not to be used
  hit_stop        // the lever came to its stop: there is no response
};

struct FrequencyPoint {
  double frequency = 0.0;          // [Hz]
  double amplitude = 0.0;          // [N] alpha of eq (9)
  bool bounded_by_stroke = false;  // else alpha is the share of the greatest force
  PointEnd end = PointEnd::measured;
  std::complex<double> response{0.0};  // [m/N] G(j omega) as measured: position by what moves the joystick, eq (4)
  double deviation = 0.0;              // [1] standard deviation of the gain, relative, and of the phase [rad]
  std::complex<double> held{1.0};      // [1] share of that force which was held from sample to sample: the motors'
};

struct FrequencyResponse {
  LeverAxis axis = LeverAxis::x;
  double period = 0.0;  // [s] of the samples
  std::vector<FrequencyPoint> points;
  std::string_view problem;  // why it ended early, empty where it did not
};

// Steps the device through the sweep: one step is one cycle of the device's loop. Per frequency: swell to the
// amplitude, then windows of whole periods until two in a row agree, then fade, so that the next one starts at rest.
// Every force goes through a guard of the sweep's own, which is armed from the first step; what it lets through is what
// is sent and measured. Its slew bends no sinusoid below half of what it lets change in a cycle: 12.5 N.
class FrequencySweep {
 public:
  // period [s] of the cycles, 1e-5 to 0.02. The device must outlive the sweep, and be driven by nobody else.
  // Throws std::invalid_argument: parameter, value and allowed range; a device without force or stroke; literal on a
  // device that is not simulated.
  FrequencySweep(const SweepConfig& config, HapticDevice& device, LeverAxis axis, double period);

  // Reads, measures, writes. False when the sweep is over: then the motors are off. It ends early, and says why in
  // response().problem, when the lever comes near its stop, a reading is no number, or the guard falls: readings stay
  // away for 20 ms, the lever is outside its workspace. Real-time safe.
  bool step(std::int64_t now_ns) noexcept;

  const FrequencyResponse& response() const noexcept { return response_; }
  double progress() const noexcept;  // [1] 0 to 1

 private:
  enum class Stage : std::uint8_t { swell, window, fade };

  // The frequency, so that `samples` of them hold `periods` whole periods and no two the same phase.
  struct Tone {
    double frequency = 0.0;  // [Hz]
    int samples = 0;
  };
  // Amplitude on its way from one value to another.
  struct Envelope {
    double from = 0.0, to = 0.0;       // [N]
    double start = 0.0, length = 0.0;  // [s]
    double at(double time) const noexcept;
  };
  struct ArcSample {
    double position = 0.0;       // [m] along the arc of the axis
    glm::dvec2 plane_per_arc{};  // plane force per newton along that arc
    glm::dvec2 arc_per_plane{};  // and back: a scalar product
  };

  static Tone make_tone(double frequency, double period);
  bool is_fresh(const LeverReading& reading) noexcept;
  void work(const LeverReading& reading) noexcept;
  void keep_time(std::int64_t time_ns) noexcept;
  void send(glm::dvec2 force, const LeverReading& reading, bool fresh) noexcept;
  ArcSample locate(glm::dvec2 plane) const noexcept;
  void watch_stroke(double position) noexcept;
  bool going_down() const noexcept;
  glm::dvec2 wanted(const ArcSample& here) const noexcept;
  void measure(const ArcSample& here, const LeverReading& reading) noexcept;
  void end_window() noexcept;
  FrequencyPoint evaluate() const noexcept;
  void keep(FrequencyPoint point, PointEnd end) noexcept;
  void next_tone() noexcept;
  double amplitude_for_stroke(double omega) const noexcept;
  void swell_to(double amplitude) noexcept;
  void fade() noexcept;
  void begin_window() noexcept;
  void finish(std::string_view problem) noexcept;

  SweepConfig config_;
  HapticDevice& device_;
  ForceGuard guard_;
  int axis_;
  double period_;    // [s]
  double stop_;      // [m] of the arc
  double greatest_;  // [N] the share of the device's greatest force
  std::vector<Tone> tones_;
  std::size_t current_ = 0;
  FrequencyResponse response_;

  bool started_ = false, done_ = false;
  std::int64_t origin_ns_ = 0;
  double time_ = 0.0;  // [s] of the sample in hand
  std::uint64_t sequence_ = 0;
  Stage stage_ = Stage::swell;
  Envelope envelope_;
  double tone_start_ = 0.0;                        // [s] where its phase is 0
  bool eased_ = false;                             // the amplitude was taken back for the stroke
  std::array<glm::dvec2, kMostDelay + 1> sent_{};  // [N] in the gate plane, by cycle
  std::uint64_t cycles_ = 0;
  HarmonicFit fit_;
  int windows_ = 0;
  FrequencyPoint last_window_;
};

using SweepProgress = std::function<void(double share)>;

// A whole sweep on a virtual clock that goes on from now_ns: for devices that live on it.
FrequencyResponse sweep_frequencies(const SweepConfig& config, HapticDevice& device, LeverAxis axis, double period,
                                    std::int64_t& now_ns, const SweepProgress& progress = {});

}  // namespace gearshift
