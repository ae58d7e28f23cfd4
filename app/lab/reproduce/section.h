// The sections of the reproduction: the paper's statements, this program's results and their differences. Every figure
// is computed from one preset through the shipped cycle.
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

// Input of all sections.
struct Study {
  haptics::Preset preset;                             // device, rate, tuning
  haptics::GateLayout layout;                         // the paper's gate
  haptics::Gate gate;                                 // the layout compiled for the preset's device
  std::filesystem::path folder;                       // must exist; receives NAME.csv, NAME.gp, NAME.svg, NAME.png
  std::function<void(std::string_view)> on_progress;  // called now and then with the current work; may be empty
  haptics::DeviceSpec device = {};                    // of the preset's lever
  haptics::AdmittedTuning admitted = {};              // the preset's tuning, limited for the lever
};

// One statement of the paper and our result.
struct Finding {
  std::string paper;       // a sentence with its section: "Section 3.1: K < 605 N/m in X"
  std::string result;      // "600 N/m"
  std::string difference;  // and its reason: "-0.8 %: (21) was made with b = 3.025 instead of (11)'s 3.0"
};

struct Picture {
  std::string name;  // NAME.svg is in the folder; NAME.png and NAME.csv are optional
  std::string caption;
  std::string data = {};  // DATA.csv, if the data are not in NAME.csv
};

struct Table {
  std::string name = {};  // NAME.csv is in the folder; may be empty
  std::string caption = {};
  std::vector<std::vector<std::string>> rows = {};  // the first row has the headings
};

struct Section {
  std::string id;                 // "wall"
  std::string title;              // "Fig. 8: a virtual wall"
  std::string text;               // a paragraph: method and configuration
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

Section workspace_section(const Study& study);       // the paper's Fig. 1, 2: kinematics, eq. (1)-(3)
Section force_map_section(const Study& study);       // the paper's forces, eq. (4)-(6)
Section calibration_section(const Study& study);     // the force sensor, eq. (7)
Section bode_section(const Study& study);            // Fig. 4: frequency response, eq. (8)-(12)
Section table_section(const Study& study);           // Table 2
Section elements_section(const Study& study);        // eq. (13)-(21): emulated elements, coupling, rough damper
Section deferred_force_section(const Study& study);  // Fig. 6 (b): energy of regions I and II, and the remedy
Section wall_section(const Study& study);            // Fig. 8
Section gate_section(const Study& study);            // Fig. 7
Section tour_section(const Study& study);            // Fig. 9
Section oscillation_section(const Study& study);     // section 3.1: measures against oscillation
Section over_push_section(const Study& study);       // section 3.1: pushes above 60 N
Section rate_section(const Study& study);            // the paper's wall and the preset's, both at 100 Hz and 5000 N/m

}  // namespace gearshift::lab
