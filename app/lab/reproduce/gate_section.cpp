#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/base/colours.h"
#include "app/lab/gate/gate_svg.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "haptics/files/atomic_file.h"
#include "haptics/gate/gate_description.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift::lab {
namespace {

void write_walls(const Study& study, const haptics::GateDescription& list) {
  CsvFile csv(study, "gate", "from_x_mm,from_y_mm,to_x_mm,to_y_mm,role,pair");
  for (const haptics::WallInfo& wall : list.walls) {
    csv.line(fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{},{}", 1e3 * wall.from.x, 1e3 * wall.from.y, 1e3 * wall.to.x,
                         1e3 * wall.to.y, haptics::to_string(wall.role),
                         wall.pair < 0 ? "" : list.wall_pairs[static_cast<std::size_t>(wall.pair)].name));
  }
  csv.finish();
}

void draw_gate(const Study& study, const haptics::GateDescription& list) {
  write_walls(study, list);
  haptics::write_text_file(study.folder / "gate.svg", gate_svg(study.gate, list, study.layout.name));
}

constexpr double kView = 0.020;        // [m] half-width of a junction's view
constexpr double kArrowEvery = 0.002;  // [m]

// Writes the gate's force on the lever at points of the free space around each junction.
void write_forces(const Study& study, const haptics::GateDescription& list) {
  CsvFile csv(study, "junctions", "junction,x_mm,y_mm,force_x_n,force_y_n");
  const int points = static_cast<int>(std::lround(kView / kArrowEvery));
  for (const haptics::JunctionInfo& junction : list.junctions) {
    for (int i = -points; i <= points; ++i) {
      for (int j = -points; j <= points; ++j) {
        const glm::dvec2 at = junction.center + kArrowEvery * glm::dvec2(i, j);
        if (!haptics::in_free_space(study.gate, at)) continue;
        const glm::dvec2 force = haptics::gate_feel(study.gate, at);
        csv.line(
            fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g}", junction.name, 1e3 * at.x, 1e3 * at.y, force.x, force.y));
      }
    }
  }
  csv.finish();
}

// gnuplot commands that draw the walls from gate.csv.
std::string wall_lines() {
  const auto walls = [](const char* which, const char* colour) {
    return fmt::format(
        "\"gate.csv\" using 1:(strcol(5) {} \"closed side\" ? $2 : NaN):($3 - $1):($4 - $2) with vectors nohead "
        "linewidth 3 linecolor \"{}\"",
        which, colour);
  };
  return walls("ne", base::kInk) + ", " + walls("eq", base::kClosedColour);
}

std::string buffer_boxes(const haptics::Gate& gate) {
  std::string boxes;
  for (const haptics::Buffer& buffer : haptics::buffers(gate)) {
    boxes += fmt::format(
        "set object rectangle from {},{} to {},{} fillcolor \"{}\" fillstyle solid border linecolor \"{}\" behind\n",
        1e3 * std::min(buffer.wall, buffer.inner), -1e3 * gate.half_aisle, 1e3 * std::max(buffer.wall, buffer.inner),
        1e3 * gate.half_aisle, base::kBufferGround, base::kBufferColour);
  }
  return boxes;
}

// Draws forces as arrows, 0.5 mm per newton.
void draw_junctions(const Study& study, const haptics::GateDescription& list) {
  write_forces(study, list);
  std::string commands = fmt::format(
      "set multiplot layout 1,{} margins 0.06, 0.99, 0.12, 0.92 spacing 0.05\nset size ratio -1\nunset key\n"
      "set clip two\nset xlabel \"select x [mm]\"\nset ylabel \"shift y [mm]\"\n{}",
      list.junctions.size(), buffer_boxes(study.gate));
  for (const haptics::JunctionInfo& junction : list.junctions) {
    const double x = 1e3 * junction.center.x, view = 1e3 * kView;
    commands += fmt::format(
        "set title \"junction {}\"\nplot [{}:{}] [{}:{}] {}, \"junctions.csv\" using 2:3:(0.5 * $4):(0.5 * $5) "
        "with vectors head size 0.6,25 filled linecolor \"{}\"\nunset ylabel\n",
        junction.name, x - view, x + view, -view, view, wall_lines(), base::kLockoutColour);
  }
  draw(study, {"junctions", 1150, 440, commands + "unset multiplot\n"});
}

haptics::SimulatedRunConfig run_without_hand(const Study& study, glm::dvec2 start) {
  haptics::SimulatedRunConfig config{study.preset.haptics, study.preset.lever, study.gate, start};
  config.lever.hand = haptics::kBareHand;
  return config;
}

struct NeutralReturn {
  double time = 0.0;    // [s] time until the lever stays within 1 mm of neutral; infinite if it never does
  double offset = 0.0;  // [m] final distance from neutral
};

// Releases the lever at a junction and measures its return to neutral.
NeutralReturn time_neutral_return(const Study& study, glm::dvec2 start) {
  constexpr double kDuration = 3.0, kClose = 0.001;  // [s], [m]
  const glm::dvec2 neutral = haptics::rest_position(study.gate, haptics::kNeutralGear);
  haptics::IdleHand idle_hand;
  haptics::SimulatedRun run(run_without_hand(study, start), idle_hand);
  NeutralReturn result;
  while (run.time() < kDuration) {
    run.step();
    result.offset = glm::distance(run.lever().true_position(), neutral);
    if (result.offset > kClose) result.time = run.time();
  }
  if (result.offset > kClose) result.time = std::numeric_limits<double>::infinity();
  return result;
}

// Does not touch the lever for kIdleTime, then pulls with increasing force.
class PullingHand final : public haptics::HandDriver {
 public:
  explicit PullingHand(glm::dvec2 direction) : direction_(direction) {}
  haptics::HandTarget next(double time, glm::dvec2) noexcept override {
    haptics::HandTarget target;
    pull_ = std::max(0.0, kRise * (time - kIdleTime));
    target.push = pull_ * direction_;
    return target;
  }
  double pull() const { return pull_; }  // [N]

  static constexpr double kIdleTime = 1.5;  // [s]
  static constexpr double kRise = 4.0;      // [N/s]

 private:
  glm::dvec2 direction_;
  double pull_ = 0.0;
};

struct LockTrial {
  double drift = 0.0;  // [m] motion along the slot during kIdleTime
  double pull = 0.0;   // [N] pull that moved the lever out of gear; infinite if the lever stayed in gear
};

LockTrial pull_out(const Study& study, const haptics::Slot& slot) {
  constexpr double kDuration = 12.0;  // [s]
  const glm::dvec2 start = haptics::rest_position(study.gate, slot.gear);
  PullingHand hand({0.0, -static_cast<int>(slot.side)});
  haptics::SimulatedRun run(run_without_hand(study, start), hand);
  LockTrial trial{0.0, std::numeric_limits<double>::infinity()};
  bool engaged = false;
  while (run.time() < kDuration) {
    const bool in_gear = run.step().gear == slot.gear;
    if (engaged && !in_gear) return {trial.drift, hand.pull()};
    engaged = engaged || in_gear;
    if (run.time() < PullingHand::kIdleTime) trial.drift = std::abs(run.lever().true_position().y - start.y);
  }
  return trial;
}

std::string junctions_where(const haptics::GateDescription& list, bool closed) {
  std::string names;
  for (const haptics::JunctionInfo& junction : list.junctions) {
    const bool open = junction.left && junction.right && junction.forward && junction.back;
    if (open != closed) names += (names.empty() ? "" : ", ") + junction.name;
  }
  return names.empty() ? "none" : names;
}

Finding pairs_finding(const haptics::GateDescription& list) {
  const auto horizontal = std::count_if(list.wall_pairs.begin(), list.wall_pairs.end(),
                                        [](const haptics::WallPairInfo& pair) { return pair.horizontal; });
  const auto all = static_cast<std::ptrdiff_t>(list.wall_pairs.size());
  const auto rows = std::count_if(list.aisles.begin(), list.aisles.end(),
                                  [](const haptics::AisleInfo& aisle) { return aisle.horizontal; });
  return {
      "Section 4: one horizontal and three vertical aisles, formed by eight pairs of virtual walls",
      fmt::format("{} horizontal and {} vertical aisles, {} pairs: {} horizontal and {} vertical", rows,
                  static_cast<std::ptrdiff_t>(list.aisles.size()) - rows, all, horizontal, all - horizontal),
      fmt::format(
          "{:+d} pairs. A pair consists of two parallel walls of one aisle segment; end stops and closed sides are not "
          "paired",
          all - 8)};
}

Finding junctions_finding(const haptics::GateDescription& list) {
  return {"Section 4: junctions I and III are closed on one side, II is open in all four directions",
          fmt::format("closed on one side: {}; open in all four directions: {}", junctions_where(list, true),
                      junctions_where(list, false)),
          "the paper prints no sizes, so they come from the layout file"};
}

Finding buffer_finding(const haptics::Gate& gate, const haptics::GateDescription& list, double layout_force) {
  double max_force = 0.0;
  constexpr int kBufferSteps = 60;
  for (const haptics::Buffer& buffer : haptics::buffers(gate)) {
    for (int i = 0; i <= kBufferSteps; ++i) {
      const glm::dvec2 at{buffer.wall, gate.half_aisle * (2.0 * i / kBufferSteps - 1.0)};
      max_force = std::max(max_force, std::abs(haptics::gate_feel(gate, at).y));
    }
  }
  const auto with_buffer = std::count_if(list.junctions.begin(), list.junctions.end(),
                                         [](const haptics::JunctionInfo& junction) { return junction.buffer; });
  return {
      "Section 4: a junction has a rectangular buffer region at its closed end, where a vertical force diverts the "
      "joystick into the vertical aisle",
      fmt::format("{} buffers with a force of up to {:.1f} N across the aisle", with_buffer, max_force),
      fmt::format("the paper names no force; here it is the layout's {:g} N minus the centring force of the aisle",
                  layout_force)};
}

Finding lock_finding(const Study& study) {
  double drift = 0.0, min_pull = std::numeric_limits<double>::infinity(), max_pull = 0.0;
  for (const haptics::Slot& slot : haptics::slots(study.gate)) {
    report_progress(study, "locks");
    const LockTrial trial = pull_out(study, slot);
    drift = std::max(drift, trial.drift);
    min_pull = std::min(min_pull, trial.pull);
    max_pull = std::max(max_pull, trial.pull);
  }
  return {"Section 4: a locking function holds the joystick in each of the six gear positions",
          fmt::format("all {} gears hold the lever against a pull of {:.1f} to {:.1f} N; an untouched lever moves by "
                      "{:.2f} mm along the slot",
                      study.gate.slot_count, min_pull, max_pull, 1e3 * drift),
          fmt::format("the paper gives no value; the layout specifies {:g} N, and the yoke's spring helps the hand to "
                      "pull the lever out",
                      study.layout.feel.lock_force)};
}

Finding return_finding(const Study& study, const haptics::GateDescription& list) {
  std::string times;
  double offset = 0.0;
  for (const haptics::JunctionInfo& junction : list.junctions) {
    if (glm::distance(junction.center, haptics::rest_position(study.gate, haptics::kNeutralGear)) == 0.0) continue;
    report_progress(study, "neutral");
    const NeutralReturn back = time_neutral_return(study, junction.center);
    times += fmt::format("{}from {} in {:.2f} s", times.empty() ? "" : ", ", junction.name, back.time);
    offset = std::max(offset, back.offset);
  }
  return {"Section 4: outside the gears, the joystick returns automatically to neutral at junction II",
          fmt::format("after its release, the lever returns to within 1 mm of neutral: {}", times),
          fmt::format("the lever comes to rest {:.2f} mm from the middle", 1e3 * offset)};
}

}  // namespace

Section gate_section(const Study& study) {
  const haptics::GateDescription list = haptics::describe_gate(study.gate);
  draw_gate(study, list);
  draw_junctions(study, list);
  return {
      "gate",
      "Fig. 7: the gate, its junctions and buffers",
      fmt::format(
          "The gate \"{}\" is assembled from its layout file ({} columns). This is the systematic assembly that "
          "section 5 leaves to future work. Locks and the return to neutral are simulated with the same haptic cycle "
          "as "
          "in the trainer, with the preset's lever and without a hand.",
          study.layout.name, study.layout.columns.size()),
      {pairs_finding(list), junctions_finding(list), buffer_finding(study.gate, list, study.layout.feel.buffer_force),
       lock_finding(study), return_finding(study, list)},
      {{"gate", "Fig. 7 (a), (b): the assembled gate, and the force along a slot."},
       {"junctions",
        "Fig. 7 (c): the junctions enlarged. Arrows: the force on the lever, 0.5 mm per newton. Shaded: the "
        "buffers; brown: the closed sides."}}};
}

}  // namespace gearshift::lab
