// A scripted drive as text, CSV and JSON.
#pragma once

#include <string>

#include "app/lab/drive/scripted_drive.h"

namespace gearshift::lab {

// Names of car, gate and script, for the outputs.
struct DriveNames {
  std::string car, gate, script;
};

std::string drive_csv(const ScriptedDrive& drive);
std::string drive_json(const ScriptedDrive& drive, const DriveNames& names);
std::string drive_text(const ScriptedDrive& drive, const DriveNames& names);  // what happened, and the end

}  // namespace gearshift::lab
