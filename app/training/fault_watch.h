// Samples and shift records to faults: what was done wrong, once per deed, as soon as it is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/training/clutch_release.h"
#include "app/training/drive_fault.h"
#include "app/training/drive_sample.h"
#include "app/training/episode.h"
#include "app/training/recent_peak.h"
#include "app/training/shift_record.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct ShiftBand {
  double from = 0.0, to = 1e9;  // [rad/s] engine speed at an upshift
};

// An engine speed up to which a lower gear suits: the band's upper end where the lesson has one, for from there on one
// shifts up again; else 1.2 times the car's own, which is 3000 rpm in the hatchback: up to there people drive who do not
// hurry (UDRIVE: advice 2000 to 2500, really 1400 to 3000). [rad/s]
double suits_up_to(const CarSpec& car, const ShiftBand& band) noexcept;

// A cause is told and not its consequences: fault_watch.cpp says which at the places where one is left out.
class FaultWatch {
 public:
  // reading: what the prompts within a shift take who obeys them. [s]
  FaultWatch(const CarSpec& car, const Gate& gate, ShiftBand band = {}, double reading = 0.0);

  // Every cycle, in order. wanted_gear: that the lesson asks for now, kNeutralGear where it does not care.
  // shifting: ShiftMeter::is_open. at: the road speed at which it wants that gear to go in; 0: any. [m/s]
  void add(const DriveSample& sample, int wanted_gear, bool shifting, double at = 0.0);

  // The record that has ended with this sample, after add.
  void judge(const ShiftRecord& record);

  // The drive is over: what still lasts is told.
  void finish();

  // Faults since the last call.
  std::vector<DriveFault> take();

 private:
  enum class Measure { length, peak, sum };
  struct Lasting {
    FaultKind kind;
    Measure measure;  // what of the episode is the fault's value
    Episode episode;
  };

  // How long a shift rolled at speed.
  struct Rolled {
    double all = 0.0;             // [s]
    double left = 0.0, in = 0.0;  // [s] of it, as the first gear was left and as the last one was in
    bool to_a_stand = false;      // it was braked out of that speed with the clutch down
    bool dead = false;            // the engine stood, or was just started again: its speed tells nothing of the driver
    double counts() const noexcept { return to_a_stand ? in - left : all; }
  };

  void watch_engine(const DriveSample& now, double dt);
  void watch_feet(const DriveSample& now, double dt);
  void watch_hand(const DriveSample& now, bool shifting, double dt);
  void watch_dogs(const DriveSample& now, double dt);
  void watch_direction(const DriveSample& now);
  void watch_gear(const DriveSample& now, int wanted_gear, double at);
  void judge_speed(const DriveSample& now, double at);
  bool moves_off_again(int gear, int wanted_gear) const noexcept;
  void watch_drive(const DriveSample& now, double dt);
  bool comes_to_stand(const DriveSample& now) const noexcept;
  void follow_shift(const DriveSample& now, bool shifting, double dt) noexcept;
  void follow_roll(const DriveSample& now, bool moves, double dt) noexcept;
  void watch_rollback(const DriveSample& now);
  void tell_rollback(double time);
  void goes_on(Lasting& lasting, bool on, double value, double time, double dt);
  void tell_lasting(const Lasting& lasting);
  void tell_coasting();
  void judge_order(const ShiftRecord& record, std::size_t faults_before);
  void judge_engine(const ShiftRecord& record);
  void judge_time(const ShiftRecord& record, const Rolled& rolled);
  const Rolled& rolled_in(const ShiftRecord& record) const noexcept;
  void judge_revs(const ShiftRecord& record);
  void judge_gear(const ShiftRecord& record);
  bool judge_clutch(const ShiftRecord& record);
  double flare_needed(const ShiftRecord& record) const noexcept;
  int missed_gear(const ShiftRecord& record) const noexcept;
  // Where the value is one.
  bool tell_if(FaultKind kind, double time, double value, std::int64_t shift = -1);
  int gear_reached_for(const DriveSample& now) const noexcept;

  CarSpec car_;
  Gate gate_;
  ShiftBand band_;
  double reading_;
  ClutchRelease release_;
  RecentPeak engine_;
  Lasting over_rev_, lugging_, riding_clutch_, riding_lever_, over_push_, grind_, block_, coasting_;
  DriveSample last_;
  bool first_ = true;
  bool has_run_ = false;         // by itself, since it was dead
  bool has_stalled_ = false;     // and is not yet in a gear again that is meant
  double runs_since_ = -1e9;     // [s]
  bool shift_moved_ = false;     // the gear was left in the shift that is open
  double shift_moved_at_ = 0.0;  // [s]
  bool shifting_ = false;
  double shift_began_ = 0.0;                 // [s]
  double slow_from_ = 0.0, slow_to_ = -1.0;  // [s] the last shift that was told to be too slow
  double coasted_at_ = -1.0;                 // [s] the last coasting that was told began
  std::vector<DriveFault> coasted_;          // while the shift is open that may be the cause
  Rolled rolled_, rolled_before_;            // of the shift that is open or was last; of the one before
  bool wrong_way_ = false;                   // told for this visit to the slot
  int last_gear_ = kNeutralGear;             // in which it was driven last
  int driven_gear_ = kNeutralGear;           // with the clutch locked, last
  std::vector<int> tried_;    // gears that the lever was pushed to since the last record, the newest last
  std::vector<int> engaged_;  // and those that were in
  bool told_speed_ = false;   // the gear went in at another speed than the lesson wants
  double asked_ = 0.0;        // [rad/s] by the gear that was engaged last, as it was
  int wanted_gear_ = kNeutralGear;
  bool touching_ = false;
  double touch_error_ = 0.0;  // [rad/s] engine less the gear's demand, at the dogs' first touch without clutch
  double highest_ = 0.0;      // [m] of the distance, since it last stood or rolled forward
  std::vector<DriveFault> faults_;
};

}  // namespace gearshift
