// Scripted drives: hand and feet follow the script, the same script gives the same drive, a recording replays, and the
// outputs contain what the drive did.
#include "app/lab/drive/scripted_drive.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "app/lab/drive/drive_output.h"
#include "app/lessons/replay/recorded_drive.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;
using namespace gearshift::lab;
using doctest::Approx;

namespace {

ScriptedDriveConfig config_of(const std::string& script, const std::string& start = "") {
  ScriptedDriveConfig config;
  config.car = vehicle::read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml");
  config.gate = haptics::read_gate_layout(GEARSHIFT_ASSETS "/gates/" + config.car.gate + ".toml");
  config.script = parse_drive_script(script, "script.csv");
  config.start = parse_drive_start(start, config.script.rows.front().gear.value_or(haptics::kNeutralGear));
  return config;
}

// Moves off in first and shifts into second.
constexpr const char* kMoveOff =
    "time_s,throttle,clutch,gear\n0,0,1,1\n1,0.3,1,1\n3,0.3,0,1\n6,0.3,0,1\n6.2,0,1,1\n6.3,0,1,2\n7.2,0,1,2\n8,0.2,0,"
    "2\n10,0.2,0,2\n";

// The brake holds the car, the idle control holds 900 rpm, and the clutch carries 42 N m: 20 kJ in 5 s, which is less
// than an error.
constexpr const char* kGentleSlip = "time_s,brake,clutch,gear\n0,1,1,1\n1,1,1,1\n3,1,0.5,1\n120,1,0.5,1\n";

const vehicle::DriveSample& sample_at(const ScriptedDrive& drive, double time) {
  return *std::find_if(drive.samples.begin(), drive.samples.end(),
                       [&](const vehicle::DriveSample& s) { return s.time() >= time - 1e-9; });
}

}  // namespace

TEST_CASE("pedals, gear and shift follow the script") {
  const ScriptedDrive drive = drive_script(config_of(kMoveOff));
  CHECK(drive.samples.size() == 1001);
  CHECK(drive.samples.back().time() == Approx(10.0));
  CHECK(sample_at(drive, 2.0).controls.pedals.clutch == Approx(0.5));
  CHECK(sample_at(drive, 7.6).controls.pedals.throttle == Approx(0.1));
  CHECK(sample_at(drive, 5.0).car.gear == 1);
  CHECK(sample_at(drive, 7.2).car.gear == 2);
  CHECK(drive.samples.back().car.road_speed > 3.0);
  CHECK(drive.samples.back().car.running);
  REQUIRE(!drive.shifts.empty());
  CHECK(drive.shifts.back().from == 1);
  CHECK(drive.shifts.back().to == 2);
  CHECK_FALSE(drive.shifts.back().missed);
}

TEST_CASE("an error that a lesson would report is reported") {
  const ScriptedDrive drive = drive_script(config_of("time_s,clutch,gear\n0,1,1\n1,1,1\n1.05,0,1\n3,0,1\n"));
  CHECK(std::any_of(drive.errors.begin(), drive.errors.end(),
                    [](const lessons::DrivingError& e) { return e.kind == lessons::ErrorKind::stall; }));
  CHECK(drive.samples.back().car.stalled);
}

TEST_CASE("a clutch that slips until it smells is one driving error, however much heat its release made") {
  const auto burns = [](const char* script) {
    const ScriptedDrive drive = drive_script(config_of(script));
    std::vector<lessons::DrivingError> errors = drive.errors;
    std::erase_if(errors, [](const lessons::DrivingError& e) { return e.kind != lessons::ErrorKind::clutch_burn; });
    CHECK(drive.samples.back().car.clutch_smells);
    return errors;
  };
  CHECK(burns("time_s,throttle,brake,clutch,gear\n0,0,1,1,1\n1,1,1,1,1\n2,1,1,0.42,1\n40,1,1,0.42,1\n").size() == 1);
  CHECK(burns(kGentleSlip).size() == 1);
  const ScriptedDrive drive = drive_script(config_of(kGentleSlip));
  const auto burnt = std::find_if(drive.errors.begin(), drive.errors.end(), [](const lessons::DrivingError& e) {
    return e.kind == lessons::ErrorKind::clutch_burn;
  });
  REQUIRE(burnt != drive.errors.end());
  CHECK(sample_at(drive, burnt->time - 0.1).car.clutch_temperature < vehicle::kClutchSmells);
  CHECK(sample_at(drive, burnt->time + 0.1).car.clutch_temperature > vehicle::kClutchSmells);
}

TEST_CASE("a start in motion, on a slope, in reverse or with the engine off") {
  const ScriptedDrive rolling = drive_script(config_of("time_s,throttle\n0,0.2\n1,0.2\n", "gear=3,speed_km_per_h=50"));
  CHECK(rolling.samples.front().car.road_speed == Approx(50.0 / 3.6));
  CHECK(rolling.samples.front().car.gear == 3);
  // Without a gear, the car rolls down 20 %: g sin(atan 0.2) less rolling resistance, over the mass with wheels.
  const ScriptedDrive downhill = drive_script(config_of("time_s,slope_percent\n0,-20\n0.5,-20\n", "engine=off"));
  const vehicle::BodySpec body = vehicle::read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml").body;
  const double pull = body.mass * 9.81 * std::sin(std::atan(0.2)) - body.resistance;
  CHECK(downhill.samples.back().car.road_speed == Approx(0.5 * pull / (body.mass + body.rotating)).epsilon(0.01));
  CHECK_FALSE(downhill.samples.back().car.running);
  const ScriptedDrive back =
      drive_script(config_of("time_s,throttle,clutch,gear\n0,0,1,R\n0.5,0.3,1,R\n3,0.3,0,R\n5,0.3,0,R\n"));
  CHECK(back.samples.back().car.road_speed < -1.0);
}

TEST_CASE("the lever can be led point by point") {
  const ScriptedDrive drive =
      drive_script(config_of("time_s,clutch,lever_x_mm,lever_y_mm\n0,1,0,0\n1,1,0,4\n2,1,0,4\n"));
  CHECK(drive.samples.back().lever.lever.y > 0.001);
  CHECK(drive.samples.back().lever.lever.y < 0.0041);
}

TEST_CASE("the same script gives the same drive, and its recording replays to the same shifts") {
  const test::TempFolder folder;
  ScriptedDriveConfig config = config_of(kMoveOff);
  const std::string first = drive_csv(drive_script(config));
  config.trace = folder / "drive.trace";
  CHECK(drive_csv(drive_script(config)) == first);
  const lessons::RecordedDrive recorded(config.trace);
  CHECK_FALSE(recorded.has_diverged());
  REQUIRE(!recorded.shifts().empty());
  CHECK(recorded.shifts().back().record.to == 2);
}

TEST_CASE("CSV and JSON contain the promised columns, events, shifts and errors") {
  const ScriptedDrive drive = drive_script(config_of(kMoveOff));
  const std::string csv = drive_csv(drive);
  const std::string head = "," + csv.substr(0, csv.find_first_of("\r\n")) + ",";
  for (const char* column : {"time_s", "engine_rpm", "road_speed_km_per_h", "distance_m", "gear", "clutch_torque_nm",
                             "clutch_temperature_c", "running", "lever_x_mm", "event"})
    CHECK(head.find("," + std::string(column) + ",") != std::string::npos);
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == drive.samples.size() + 1);
  CHECK(csv.find("2 engaged") != std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(drive_json(drive, {"hatchback", "gate", "script.csv"}));
  CHECK(json["samples"].size() == drive.samples.size());
  CHECK(json["samples"].back()["gear"] == "2");
  CHECK(json["samples"].back()["road_speed_km_per_h"].get<double>() ==
        Approx(3.6 * drive.samples.back().car.road_speed));
  CHECK(json["shifts"].back()["to_gear"] == "2");
  CHECK(json["events"].size() == drive.events.size());
  CHECK(json["errors"].size() == drive.errors.size());
  CHECK(drive_text(drive, {"hatchback", "gate", "script.csv"}).find("gear 2, engine on") != std::string::npos);
}
