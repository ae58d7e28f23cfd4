// Measures the frequency response of one axis (section 2.4 of the paper): drives the axis with sinusoidal forces and
// measures gain and phase of the motion.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Eqs (8)-(10). Erratum: the paper drives with one third of the maximum force, but this is possible only above about
// 5.4 Hz. At 1 Hz this force would need a stroke of 484 mm, but the stop is at 84 mm of arc. So here the force is at
// most one third of the maximum, and the motion at most 60 % of the distance to the stop.
//
// Works on every device that can be driven. Forces and positions are in the plant's coordinates, which run along the
// arcs if the device has a yoke. No hand may move the lever. With a force sensor, the effect of a hand that only rests
// on the lever or pulls it is removed. A hand that moves with the lever still falsifies the result, because its mass
// responds to every step of the force: at 1 kHz a firm grip makes the measured mass 5 % too large.
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

namespace gearshift::haptics {

enum class LeverAxis : std::uint8_t { x, y };  // select, shift
const char* to_string(LeverAxis axis) noexcept;

struct SweepConfig {
  double highest = 65.0;              // [Hz] highest frequency, up to 0.4 of the sample rate; 65 Hz in the paper
  double lowest = 0.2;                // [Hz] lowest frequency, 0.01 to `highest`
  int points = 24;                    // number of frequencies, 1 to 200, logarithmically spaced; highest first
  double force_fraction = 1.0 / 3.0;  // [1] 0.001 to 1, force amplitude / maximum force; the paper's alpha
  double stroke_fraction = 0.6;       // [1] 0.05 to 0.7, largest motion as a fraction of the distance to the stop
  bool literal = false;               // ignores stroke_fraction, as the paper does; simulated devices only
};

enum class PointEnd : std::uint8_t {
  measured,
  never_settled,  // the response kept changing, so it cannot be used
  hit_stop        // the lever reached its stop, so there is no response
};

struct FrequencyPoint {
  double frequency = 0.0;          // [Hz]
  double amplitude = 0.0;          // [N] amplitude of the force in the paper's eq (9)
  double motion = 0.0;             // [m] amplitude of the position
  bool bounded_by_stroke = false;  // the stroke limits the amplitude, not force_fraction
  PointEnd end = PointEnd::measured;
  std::complex<double> response{0.0};  // [m/N] measured G(j omega): position per force f_j of the paper's eq (4)
  double deviation = 0.0;              // standard deviation of the relative gain [1] and of the phase [rad]
  double rounding = 0.0;               // [1] standard deviation of the gain by encoder rounding, in addition
  std::complex<double> held{1.0};      // [1] motors' fraction of the force; only this part is held between samples
};

struct FrequencyResponse {
  LeverAxis axis = LeverAxis::x;
  double period = 0.0;  // [s] between samples
  std::vector<FrequencyPoint> points;
  std::string_view problem;  // reason why the sweep ended early; empty if it did not
};

// Runs the sweep on the device; one step is one cycle of the device's loop. At each frequency the sweep raises the
// force to its amplitude and measures windows of whole periods until two consecutive windows agree. It then fades the
// force out, so that the next frequency starts at rest. Every force passes the sweep's own guard, which is armed from
// the first step. The guard's output is sent to the device and used in the measurement. The guard does not distort
// sinusoids with amplitudes below 12.5 N: even from peak to peak they change by less than 25 N, the guard's limit per
// cycle.
class FrequencySweep {
 public:
  // period: cycle time [s], 1e-5 to 0.02. The device must outlive the sweep, and nothing else may drive it. Throws
  // std::invalid_argument if a parameter is out of range; the message has parameter, value and range. Also throws if
  // the device has no force or no stroke, or if `literal` is set for a device that is not simulated.
  FrequencySweep(const SweepConfig& config, HapticDevice& device, LeverAxis axis, double period);

  // Performs one cycle: reads, measures and writes. Returns false when the sweep is over; the motors are then off. The
  // sweep ends early, with the reason in response().problem, if the lever comes near its stop, a reading is not finite,
  // or the guard reports a fault (no fresh reading for 20 ms, lever outside its workspace). Real-time safe.
  bool step(std::int64_t now_ns) noexcept;

  const FrequencyResponse& response() const noexcept { return response_; }
  double progress() const noexcept;  // [1] fraction of the sweep that is done, 0 to 1

 private:
  enum class Stage : std::uint8_t { ramp, window, fade };

  // A frequency such that `samples` samples span whole periods and no two of these samples have the same phase.
  struct Tone {
    double frequency = 0.0;  // [Hz]
    int samples = 0;
  };
  // Smooth transition of the amplitude from one value to another.
  struct Envelope {
    double from = 0.0, to = 0.0;       // [N]
    double start = 0.0, length = 0.0;  // [s]
    double at(double time) const noexcept;
  };
  struct ArcSample {
    double position = 0.0;       // [m] position along the driven axis's arc
    glm::dvec2 plane_per_arc{};  // [1] force in the gate plane per newton along that arc
    glm::dvec2 arc_per_plane{};  // [1] its dot product with a force in the gate plane is the force along the arc
  };

  static Tone make_tone(double frequency, double period);
  bool is_fresh(const LeverReading& reading) noexcept;
  void process_sample(const LeverReading& reading) noexcept;
  void update_time(std::int64_t time_ns) noexcept;
  void send(glm::dvec2 force, const LeverReading& reading, bool fresh) noexcept;
  ArcSample locate(glm::dvec2 plane) const noexcept;
  void check_stroke(double position) noexcept;
  bool is_decreasing() const noexcept;
  glm::dvec2 wanted_force(const ArcSample& here) const noexcept;
  void measure(const ArcSample& here, const LeverReading& reading) noexcept;
  void end_window() noexcept;
  FrequencyPoint evaluate() const noexcept;
  void record_point(FrequencyPoint point, PointEnd end) noexcept;
  void next_tone() noexcept;
  double amplitude_for_stroke(double omega) const noexcept;
  void ramp_to(double amplitude) noexcept;
  void fade() noexcept;
  void begin_window() noexcept;
  void finish(std::string_view problem) noexcept;

  SweepConfig config_;
  HapticDevice& device_;
  ForceGuard guard_;
  int axis_;
  double period_;         // [s]
  double stop_;           // [m] position of the stop along the arc
  double max_amplitude_;  // [N] force_fraction times the device's maximum force
  std::vector<Tone> tones_;
  std::size_t current_ = 0;
  FrequencyResponse response_;

  bool started_ = false, done_ = false;
  std::int64_t origin_ns_ = 0;
  double time_ = 0.0;  // [s] time of the current sample
  std::uint64_t sequence_ = 0;
  Stage stage_ = Stage::ramp;
  Envelope envelope_;
  double tone_start_ = 0.0;                               // [s] time at which the sinusoid's phase is 0
  bool is_reduced_ = false;                               // the amplitude was reduced because the stroke was too large
  std::array<glm::dvec2, kMaxLoopDelay + 1> commands_{};  // [N] ring buffer, one gate-plane command per cycle
  std::uint64_t cycles_ = 0;
  HarmonicFit fit_;
  int windows_ = 0;
  FrequencyPoint last_window_;
};

using SweepProgress = std::function<void(double fraction)>;

// Runs a whole sweep of a simulated device on a virtual clock. now_ns: start of the clock; set to the clock's end.
FrequencyResponse sweep_frequencies(const SweepConfig& config, HapticDevice& device, LeverAxis axis, double period,
                                    std::int64_t& now_ns, const SweepProgress& progress = {});

}  // namespace gearshift::haptics
