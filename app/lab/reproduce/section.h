// The sections of the reproduction. Each compares statements of the paper with results of this program. All results are
// computed from one preset with the trainer's haptic cycle.
#pragma once

#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/preset.h"

namespace gearshift::lab {

inline constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

// Input for all sections.
struct Study {
  haptics::Preset preset;                             // device, rate, tuning
  haptics::GateLayout layout;                         // the paper's gate
  haptics::Gate gate;                                 // layout, compiled for the preset's device
  std::filesystem::path folder;                       // must exist; receives NAME.csv, NAME.gp, NAME.svg and NAME.png
  std::function<void(std::string_view)> on_progress;  // called often with the name of the current work; may be empty
  haptics::DeviceSpec device = {};                    // specification of the preset's lever
  haptics::AdmittedTuning admitted = {};              // the preset's tuning as limited for the lever
};

// A statement of the paper and our result.
struct Finding {
  std::string paper;       // the statement and its section: "Section 3.1: K < 605 N/m in X"
  std::string result;      // "600 N/m"
  std::string difference;  // difference and its reason: "-0.8 %: (21) was made with b = 3.025 instead of (11)'s 3.0"
};

struct Picture {
  std::string name;  // NAME.svg is in the folder; NAME.png and NAME.csv are optional
  std::string caption;
  std::string data = {};  // set if the data are in DATA.csv instead of NAME.csv
};

struct Table {
  std::string name = {};  // name of NAME.csv in the folder; empty if there is no CSV file
  std::string caption = {};
  std::vector<std::vector<std::string>> rows = {};  // the first row contains the headings
};

struct Section {
  std::string id;                 // "wall"
  std::string title;              // title such as "Fig. 8: a virtual wall"
  std::string text;               // a paragraph about method and configuration
  std::vector<Finding> findings;  // the most important one first
  std::vector<Picture> pictures;
  Table table = {};
  std::string problem = {};  // why the section failed, in one sentence; empty if it succeeded
};

using MakeSection = Section (*)(const Study&);
struct NamedSection {
  std::string_view id;
  MakeSection make;
};

Section workspace_section(const Study& study);       // the paper's Fig. 1 and 2: kinematics, eq. (1)-(3)
Section force_map_section(const Study& study);       // the paper's force equations, (4)-(6)
Section calibration_section(const Study& study);     // the paper's force sensor, eq. (7)
Section bode_section(const Study& study);            // the paper's Fig. 4: frequency response, eq. (8)-(12)
Section table_section(const Study& study);           // Table 2
Section elements_section(const Study& study);        // the paper's eq. (13)-(21): elements, coupling, rough damper
Section deferred_force_section(const Study& study);  // the paper's Fig. 6 (b): energy from late forces, and remedies
Section wall_section(const Study& study);            // Fig. 8
Section gate_section(const Study& study);            // Fig. 7
Section tour_section(const Study& study);            // Fig. 9
Section oscillation_section(const Study& study);     // the paper's section 3.1: measures against oscillation
Section over_push_section(const Study& study);       // the paper's section 3.1: pushes above 60 N
Section rate_section(const Study& study);            // 5000 N/m walls: the paper's at 100 Hz, the preset's at two rates

}  // namespace gearshift::lab
