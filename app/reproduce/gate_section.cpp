#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/draw/gate_colours.h"
#include "app/draw/gate_svg.h"
#include "app/reproduce/section.h"
#include "app/reproduce/study_files.h"
#include "haptics/files/part_file.h"
#include "haptics/gate/gate_description.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift {
namespace {

void write_walls(const Study& study, const GateDescription& list) {
  CsvFile csv(study, "gate", "from_x_mm,from_y_mm,to_x_mm,to_y_mm,role,pair");
  for (const WallInfo& wall : list.walls) {
    csv.line(fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{},{}", 1e3 * wall.from.x, 1e3 * wall.from.y, 1e3 * wall.to.x,
                         1e3 * wall.to.y, wall_role_name(wall.role),
                         wall.pair < 0 ? "" : list.wall_pairs[static_cast<std::size_t>(wall.pair)].name));
  }
  csv.finish();
}

void draw_gate(const Study& study, const GateDescription& list) {
  write_walls(study, list);
  write_text_file(study.folder / "gate.svg", gate_svg(study.gate, list, study.layout.name));
}

constexpr double kView = 0.020;        // [m] of a junction, to each side of its centre
constexpr double kArrowEvery = 0.002;  // [m]

// The force that the mechanism puts on the lever at points of the free space around a junction.
void write_forces(const Study& study, const GateDescription& list) {
  CsvFile csv(study, "junctions", "junction,x_mm,y_mm,force_x_n,force_y_n");
  const int points = static_cast<int>(std::lround(kView / kArrowEvery));
  for (const JunctionInfo& junction : list.junctions) {
    for (int i = -points; i <= points; ++i) {
      for (int j = -points; j <= points; ++j) {
        const glm::dvec2 at = junction.center + kArrowEvery * glm::dvec2(i, j);
        if (!in_free_space(study.gate, at)) continue;
        const glm::dvec2 force = gate_feel(study.gate, at);
        csv.line(
            fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g}", junction.name, 1e3 * at.x, 1e3 * at.y, force.x, force.y));
      }
    }
  }
  csv.finish();
}

// Of gate.csv.
std::string wall_lines() {
  const auto walls = [](const char* which, const char* colour) {
    return fmt::format(
        "\"gate.csv\" using 1:(strcol(5) {} \"closed side\" ? $2 : NaN):($3 - $1):($4 - $2) with vectors nohead "
        "linewidth 3 linecolor \"{}\"",
        which, colour);
  };
  return walls("ne", kInk) + ", " + walls("eq", kClosedColour);
}

std::string buffer_boxes(const Gate& gate) {
  std::string boxes;
  for (const Buffer& buffer : buffers(gate)) {
    boxes += fmt::format(
        "set object rectangle from {},{} to {},{} fillcolor \"{}\" fillstyle solid border linecolor \"{}\" behind\n",
        1e3 * std::min(buffer.wall, buffer.inner), -1e3 * gate.half_aisle, 1e3 * std::max(buffer.wall, buffer.inner),
        1e3 * gate.half_aisle, kBufferGround, kBufferColour);
  }
  return boxes;
}

// Arrows of 0.5 mm per newton.
void draw_junctions(const Study& study, const GateDescription& list) {
  write_forces(study, list);
  std::string commands = fmt::format(
      "set multiplot layout 1,{} margins 0.06, 0.99, 0.12, 0.92 spacing 0.05\nset size ratio -1\nunset key\n"
      "set clip two\nset xlabel \"select x [mm]\"\nset ylabel \"shift y [mm]\"\n{}",
      list.junctions.size(), buffer_boxes(study.gate));
  for (const JunctionInfo& junction : list.junctions) {
    const double x = 1e3 * junction.center.x, view = 1e3 * kView;
    commands += fmt::format(
        "set title \"junction {}\"\nplot [{}:{}] [{}:{}] {}, \"junctions.csv\" using 2:3:(0.5 * $4):(0.5 * $5) "
        "with vectors head size 0.6,25 filled linecolor \"{}\"\nunset ylabel\n",
        junction.name, x - view, x + view, -view, view, wall_lines(), kLockoutColour);
  }
  draw(study, {"junctions", 1150, 440, commands + "unset multiplot\n"});
}

SimulatedRunConfig run_without_hand(const Study& study, glm::dvec2 start) {
  SimulatedRunConfig config{study.preset.haptics, study.preset.lever, study.gate, start};
  config.lever.hand = kBareHand;
  return config;
}

struct NeutralReturn {
  double time = 0.0;    // [s] until it stays within a millimetre of neutral's column; infinite where it does not
  double offset = 0.0;  // [m] in the end
};

// The lever let go at a junction.
NeutralReturn let_go(const Study& study, glm::dvec2 start) {
  constexpr double kDuration = 3.0, kClose = 0.001;  // [s], [m]
  const glm::dvec2 neutral = rest_position(study.gate, kNeutralGear);
  RestingHand nobody;
  SimulatedRun run(run_without_hand(study, start), nobody);
  NeutralReturn result;
  while (run.time() < kDuration) {
    run.step();
    result.offset = glm::distance(run.lever().true_position(), neutral);
    if (result.offset > kClose) result.time = run.time();
  }
  if (result.offset > kClose) result.time = std::numeric_limits<double>::infinity();
  return result;
}

// Pulls at the lever ever harder, after a while of leaving it alone.
class PullingHand final : public HandDriver {
 public:
  explicit PullingHand(glm::dvec2 direction) : direction_(direction) {}
  HandTarget next(double time, glm::dvec2) noexcept override {
    HandTarget target;
    pull_ = std::max(0.0, kRise * (time - kAlone));
    target.push = pull_ * direction_;
    return target;
  }
  double pull() const { return pull_; }  // [N]

  static constexpr double kAlone = 1.5;  // [s]
  static constexpr double kRise = 4.0;   // [N/s]

 private:
  glm::dvec2 direction_;
  double pull_ = 0.0;
};

struct LockTrial {
  double drift = 0.0;  // [m] along the slot while left alone
  double pull = 0.0;   // [N] at which the gear was left; infinite where it never was
};

LockTrial pull_out(const Study& study, const Slot& slot) {
  constexpr double kDuration = 12.0;  // [s]
  const glm::dvec2 start = rest_position(study.gate, slot.gear);
  PullingHand hand({0.0, -static_cast<int>(slot.side)});
  SimulatedRun run(run_without_hand(study, start), hand);
  LockTrial trial{0.0, std::numeric_limits<double>::infinity()};
  bool engaged = false;
  while (run.time() < kDuration) {
    const bool in_gear = run.step().gear == slot.gear;
    if (engaged && !in_gear) return {trial.drift, hand.pull()};
    engaged = engaged || in_gear;
    if (run.time() < PullingHand::kAlone) trial.drift = std::abs(run.lever().true_position().y - start.y);
  }
  return trial;
}

std::string junctions_where(const GateDescription& list, bool closed) {
  std::string names;
  for (const JunctionInfo& junction : list.junctions) {
    const bool open = junction.left && junction.right && junction.forward && junction.back;
    if (open != closed) names += (names.empty() ? "" : ", ") + junction.name;
  }
  return names.empty() ? "none" : names;
}

Finding pairs_finding(const GateDescription& list) {
  const auto horizontal = std::count_if(list.wall_pairs.begin(), list.wall_pairs.end(),
                                        [](const WallPairInfo& pair) { return pair.horizontal; });
  const auto all = static_cast<std::ptrdiff_t>(list.wall_pairs.size());
  const auto rows =
      std::count_if(list.aisles.begin(), list.aisles.end(), [](const AisleInfo& aisle) { return aisle.horizontal; });
  return {"Section 4: one horizontal and three vertical aisles, formed by eight pairs of virtual walls",
          fmt::format("{} horizontal and {} vertical aisles, {} pairs: {} horizontal and {} vertical", rows,
                      static_cast<std::ptrdiff_t>(list.aisles.size()) - rows, all, horizontal, all - horizontal),
          fmt::format(
              "{:+d} pairs. A pair is two parallel walls of one aisle segment; end stops and closed sides are in none",
              all - 8)};
}

Finding junctions_finding(const GateDescription& list) {
  return {"Section 4: junctions I and III are closed on one side, II is open in all four directions",
          fmt::format("closed on one side: {}; open in all four: {}", junctions_where(list, true),
                      junctions_where(list, false)),
          "the paper prints no sizes: they are those of the layout file"};
}

Finding buffer_finding(const Gate& gate, const GateDescription& list, double layout_force) {
  double most = 0.0;
  constexpr int kBufferSteps = 60;
  for (const Buffer& buffer : buffers(gate)) {
    for (int i = 0; i <= kBufferSteps; ++i) {
      const glm::dvec2 at{buffer.wall, gate.half_aisle * (2.0 * i / kBufferSteps - 1.0)};
      most = std::max(most, std::abs(gate_feel(gate, at).y));
    }
  }
  const auto with_buffer = std::count_if(list.junctions.begin(), list.junctions.end(),
                                         [](const JunctionInfo& junction) { return junction.buffer; });
  return {
      "Section 4: a rectangular buffer region at their closed ends; force from the vertical direction deviates the "
      "joystick into the vertical aisle",
      fmt::format("{} buffers, a force of up to {:.1f} N across the aisle", with_buffer, most),
      fmt::format("the paper names no force: it is the layout's {:g} N less the centring of the aisle", layout_force)};
}

Finding lock_finding(const Study& study) {
  double drift = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Slot& slot : slots(study.gate)) {
    tell(study, "locks");
    const LockTrial trial = pull_out(study, slot);
    drift = std::max(drift, trial.drift);
    least = std::min(least, trial.pull);
    most = std::max(most, trial.pull);
  }
  return {
      "Section 4: a locking function when the joystick rests in the six gear positions",
      fmt::format("all {} gears hold the lever against a pull of {:.1f} to {:.1f} N; left alone it moves {:.2f} mm "
                  "along the slot",
                  study.gate.slot_count, least, most, 1e3 * drift),
      fmt::format(
          "the paper names no force; the layout asks for {:g} N of the motors, the yoke's own spring helps the hand",
          study.layout.feel.lock_force)};
}

Finding return_finding(const Study& study, const GateDescription& list) {
  std::string times;
  double offset = 0.0;
  for (const JunctionInfo& junction : list.junctions) {
    if (glm::distance(junction.center, rest_position(study.gate, kNeutralGear)) == 0.0) continue;
    tell(study, "neutral");
    const NeutralReturn back = let_go(study, junction.center);
    times += fmt::format("{}from {} within {:.2f} s", times.empty() ? "" : ", ", junction.name, back.time);
    offset = std::max(offset, back.offset);
  }
  return {"Section 4: an automatic return to the neutral position, at junction II, away from the gears",
          fmt::format("let go, the lever is back within 1 mm: {}", times),
          fmt::format("it comes to rest {:.2f} mm from the middle", 1e3 * offset)};
}

}  // namespace

Section gate_section(const Study& study) {
  const GateDescription list = describe_gate(study.gate);
  draw_gate(study, list);
  draw_junctions(study, list);
  return {
      "gate",
      "Fig. 7: the gate, its junctions and buffers",
      fmt::format("The gate \"{}\" is not written down here: it is assembled from its layout file ({} columns), "
                  "which is the systematic assembly that section 5 leaves to future work. Locks and the return to "
                  "neutral are driven through the shipped cycle, on the preset's lever without a hand.",
                  study.layout.name, study.layout.columns.size()),
      {pairs_finding(list), junctions_finding(list), buffer_finding(study.gate, list, study.layout.feel.buffer_force),
       lock_finding(study), return_finding(study, list)},
      {{"gate", "Fig. 7 (a), (b): the gate as assembled, and the force along a slot."},
       {"junctions",
        "Fig. 7 (c): the junctions enlarged. Arrows: the force on the lever, 0.5 mm per newton. Shaded: the "
        "buffers; brown: the closed sides."}}};
}

}  // namespace gearshift
