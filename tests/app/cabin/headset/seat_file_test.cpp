// Tests of the file that stores the seat calibration.
#include "app/cabin/headset/seat_file.h"

#include <fstream>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/files/file_error.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

std::string refusal(const TempFolder& folder, const std::string& text) {
  const std::filesystem::path file = folder.path() / "headset.toml";
  std::ofstream(file) << text;
  try {
    (void)read_seat(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a saved seat is read back exactly") {
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "config" / "headset.toml";
  CHECK(read_seat(file).height == 0.0);  // the file does not exist yet
  SeatSettings seat;
  seat.drive = DriveSide::right;
  seat.height = 0.0613;
  seat.knob = KnobDistance{-0.28, 0.461, 0.3};
  seat.touched = EyePose{{1.25, -0.875, 0.1}, glm::angleAxis(-2.5, glm::dvec3(0, 1, 0))};
  seat.touch_error = 0.0035;
  write_seat(seat, file);
  const SeatSettings read = read_seat(file);
  CHECK(read.drive == DriveSide::right);
  CHECK(read.height == seat.height);
  REQUIRE(read.knob);
  CHECK(read.knob->down == 0.461);
  REQUIRE(read.touched);
  CHECK(read.touched->position == seat.touched->position);
  const glm::dvec3 far(3.0, 1.0, -2.0);
  CHECK(glm::distance(*read.touched * far, *seat.touched * far) < 1e-12);
  CHECK(read.touch_error == 0.0035);
}

TEST_CASE("an invalid seat file is rejected with file, line, key, value and range") {
  const TempFolder folder;
  CHECK(refusal(folder, "seat_height_m = 0.7\n").find("headset.toml:1: seat_height_m = 0.7") != std::string::npos);
  CHECK(refusal(folder, "seat_height_m = 0.7\n").find("0.3") != std::string::npos);
  CHECK(refusal(folder, "drive = \"middle\"\n").find("left") != std::string::npos);
  CHECK(refusal(folder, "[knob]\nright_m = 0.1\ndown_m = 0.2\n").find("ahead_m") != std::string::npos);
  CHECK(refusal(folder, "drive = \"right\"\n[knob]\nright_m = 0.3\ndown_m = 0.5\nahead_m = 0.3\n")
            .find("right_m = 0.3") != std::string::npos);
  CHECK(refusal(folder, "[touched]\nx_m = 0\ny_m = 0\nz_m = 0\nturn_deg = 400\nerror_m = 0\n").find("turn_deg = 400") !=
        std::string::npos);
  CHECK(refusal(folder, "seat_hight_m = 0.1\n").find("seat_hight_m") != std::string::npos);
  CHECK(refusal(folder, "") == "");
}
