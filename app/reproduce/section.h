// The paper, section by section: what it says, what this program gives, and how far apart they are. Every figure comes
// from one preset through the shipped cycle.
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

namespace gearshift {

inline constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]

// What all sections are made from.
struct Study {
  Preset preset;                                // device, rate, tuning
  GateLayout layout;                            // the paper's gate
  Gate gate;                                    // compiled for that device
  std::filesystem::path folder;                 // exists; receives NAME.csv, NAME.gp, NAME.svg, NAME.png
  std::function<void(std::string_view)> doing;  // told now and then what is in hand; may be empty
  DeviceSpec device = {};                       // the preset's lever, as it tells the loop
  AdmittedTuning admitted = {};                 // what that lever admits of the preset's tuning
};

// One statement of the paper beside ours.
struct Finding {
  std::string paper;       // "Section 3.1: K < 605 N/m in X"
  std::string ours;        // "600 N/m"
  std::string difference;  // "-0.8 %: (21) was made with b = 3.025 instead of (11)'s 3.0"
};

struct Picture {
  std::string name;       // NAME.svg lies in the folder, with NAME.png and NAME.csv where there are such
  std::string caption;    // what is seen
  std::string data = {};  // DATA.csv, where the data are not in NAME.csv
};

struct Table {
  std::string name = {};  // NAME.csv lies in the folder where it is not empty
  std::string caption = {};
  std::vector<std::vector<std::string>> rows = {};  // the first are the headings
};

struct Section {
  std::string id;                 // "wall"
  std::string title;              // "Fig. 8: a virtual wall"
  std::string text;               // a paragraph: what was done, with which configuration
  std::vector<Finding> findings;  // the main one first
  std::vector<Picture> pictures;
  Table table = {};
  std::string problem = {};  // why it could not be made, in one sentence; empty where it was
};

using MakeSection = Section (*)(const Study&);
struct NamedSection {
  std::string_view id;
  MakeSection make;
};

Section workspace_section(const Study& study);    // Fig. 1, 2: (1)-(3)
Section force_map_section(const Study& study);    // (4)-(6)
Section calibration_section(const Study& study);  // (7)
Section bode_section(const Study& study);         // Fig. 4: (8)-(12)
Section table_section(const Study& study);        // Table 2
Section elements_section(const Study& study);     // (13)-(21): spring, damper, mass, impedance, coupling, rough damper
Section deferred_force_section(const Study& study);  // Fig. 6 (b): regions I and II, and the cure
Section wall_section(const Study& study);            // Fig. 8
Section gate_section(const Study& study);            // Fig. 7
Section tour_section(const Study& study);            // Fig. 9
Section oscillation_section(const Study& study);     // section 3.1: what calms the wall
Section over_push_section(const Study& study);       // section 3.1: above 60 N
Section rate_section(const Study& study);            // 5000 N/m at 100 Hz: the paper's, and ours

}  // namespace gearshift
