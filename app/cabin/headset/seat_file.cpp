#include "app/cabin/headset/seat_file.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/core.h>
#include <glm/trigonometric.hpp>

#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"
#include "haptics/files/verified_file.h"

namespace gearshift::cabin {
namespace {

constexpr haptics::Range kHeight{-0.3, 0.3}, kKnobRange{-1.5, 1.5}, kRoom{-50.0, 50.0}, kError{0.0, 0.1},
    kTurn{-180.0, 180.0};
constexpr glm::dvec3 kVertical{0.0, 1.0, 0.0};

double turn_of(const engine::EyePose& pose) {
  return glm::degrees(2.0 * std::atan2(pose.orientation.y, pose.orientation.w));
}

// A line with the shortest decimal number from which the value is read back exactly.
std::string line(const char* key, double value) {
  char digits[64];
  return fmt::format("{} = {}\n", key, std::string(digits, std::to_chars(digits, digits + sizeof digits, value).ptr));
}

}  // namespace

SeatSettings read_seat(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  return parse_seat(haptics::read_text_file(file), file.string());
}

SeatSettings parse_seat(std::string_view text, const std::string& file_name) {
  SeatSettings seat;
  const haptics::TomlTable all = haptics::TomlTable::parse(text, file_name);
  if (all.has("drive") && all.choice("drive", {"left", "right"}) == "right") seat.drive = DriveSide::right;
  seat.height = all.number_or("seat_height_m", 0.0, kHeight);
  if (all.has("knob")) {
    const haptics::TomlTable knob = all.table("knob");
    seat.knob = KnobDistance{knob.number("right_m", kKnobRange), knob.number("down_m", kKnobRange),
                             knob.number("ahead_m", kKnobRange)};
    try {
      check_knob(*seat.knob, seat.drive);
    } catch (const std::invalid_argument& refused) {
      knob.fail("right_m", refused.what());
    }
    knob.reject_unknown_keys();
  }
  if (all.has("touched")) {
    const haptics::TomlTable touched = all.table("touched");
    seat.touched =
        engine::EyePose{{touched.number("x_m", kRoom), touched.number("y_m", kRoom), touched.number("z_m", kRoom)},
                        glm::angleAxis(glm::radians(touched.number("turn_deg", kTurn)), kVertical)};
    seat.touch_error = touched.number("error_m", kError);
    touched.reject_unknown_keys();
  }
  all.reject_unknown_keys();
  return seat;
}

std::string seat_text(const SeatSettings& seat) {
  std::string text = "# Positions of the driver and the lever, saved by gearshift train --xr.\n\n";
  text += fmt::format("drive = \"{}\"\n", seat.drive == DriveSide::left ? "left" : "right");
  text += line("seat_height_m", seat.height);
  if (seat.knob) {
    text += "\n[knob]  # relative to the driver's eyes\n" + line("right_m", seat.knob->right) +
            line("down_m", seat.knob->down) + line("ahead_m", seat.knob->ahead);
  }
  if (seat.touched) {
    const glm::dvec3& at = seat.touched->position;
    text += "\n[touched]  # where the headset's room lies in the cabin, found by touching the knob\n" +
            line("x_m", at.x) + line("y_m", at.y) + line("z_m", at.z) +
            line("turn_deg", std::remainder(turn_of(*seat.touched), 360.0)) + line("error_m", seat.touch_error);
  }
  return text;
}

void write_seat(const SeatSettings& seat, const std::filesystem::path& file) {
  std::error_code ignored;  // ignored, because the write below reports the failure
  std::filesystem::create_directories(file.parent_path(), ignored);
  haptics::write_verified_file(file, seat_text(seat), [](const std::filesystem::path& part) { (void)read_seat(part); });
}

}  // namespace gearshift::cabin
