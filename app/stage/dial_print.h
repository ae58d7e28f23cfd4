// The tachometer's red line, printed for the car that is driven.
#pragma once

#include <array>

#include "engine/model/model.h"

namespace gearshift {

// The cabin's file has a dial with a red line of its own. Arc, ticks and numbers are coloured anew, red from the car's
// red line to the end of the scale, on what reflects and on what glows; a line beyond the scale leaves nothing red.
class DialPrint {
 public:
  // Keeps the print of the model's file. Throws std::runtime_error where it has none of a dial.
  explicit DialPrint(const Model& model);

  // Into that model. red_line [rad/s]; 0 or less: no car, the dial stays as it is. True where the print has changed.
  bool print(Model& model, double red_line);

 private:
  std::array<int, 2> texture_;     // what reflects, what glows
  std::array<Image, 2> as_filed_;  // the dial's field of each
  double red_line_ = 0.0;          // [rad/s] printed last; 0: the file's
};

}  // namespace gearshift
