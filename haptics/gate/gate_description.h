// Describes the aisles, junctions and walls of a compiled gate for the command `gearshift gate`; see Fig. 7 of the
// paper.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

struct AisleInfo {
  std::string name;  // "neutral", or the Roman numeral of its junction; of a mechanism its number
  bool horizontal = false;
  glm::dvec2 min{0.0}, max{0.0};    // [m]
  std::vector<glm::dvec2> outline;  // [m] of a mechanism's aisle, with its round ends
};
struct JunctionInfo {
  std::string name;                                                 // "I", "II", ... from left to right
  glm::dvec2 center{0.0};                                           // [m]
  bool left = false, right = false, forward = false, back = false;  // open directions
  bool buffer = false;  // the junction's closed side deflects the lever into the vertical aisle
};
enum class WallRole { aisle, chamfer, end_stop, closed_side };  // in a mechanism, an end stop is a part of a round end
// The name of a wall role: "aisle", "chamfer", "end_stop" or "closed_side".
const char* to_string(WallRole role) noexcept;
struct WallInfo {
  glm::dvec2 from{0.0}, to{0.0};  // [m]
  WallRole role = WallRole::aisle;
  int pair = -1;  // index into wall_pairs, or -1 if the wall has no partner
};
struct WallPairInfo {       // two parallel walls of one aisle segment
  std::string name;         // the junctions at both ends, for example "I-II", or the gear's name
  bool horizontal = false;  // in a mechanism: nearer to horizontal than to vertical
};
struct GateDescription {
  std::vector<AisleInfo> aisles;
  std::vector<JunctionInfo> junctions;
  std::vector<WallInfo> walls;
  std::vector<WallPairInfo> wall_pairs;
};
GateDescription describe_gate(const Gate& gate);

}  // namespace gearshift::haptics
