// The tachometer's red line, drawn for the current car.
#pragma once

#include <array>

#include "engine/model/model.h"

namespace gearshift::cabin {

// The dial in the cabin's file has its own red line. This recolours arc, ticks and numbers in the base-colour and
// emissive textures: red from the car's red line to the end of the scale. With a red line beyond the scale nothing is
// red.
class DialPrint {
 public:
  // Saves the dial textures of the model. Throws std::runtime_error if the model has none.
  explicit DialPrint(const engine::Model& model);

  // Draws into that model's textures. red_line [rad/s]; 0 or less: no car, the dial is unchanged. True if it changed.
  bool print(engine::Model& model, double red_line);

 private:
  std::array<int, 2> texture_;             // base colour, emissive
  std::array<engine::Image, 2> original_;  // the dial's part of each, as in the file
  double red_line_ = 0.0;                  // [rad/s] drawn last; 0: that of the file
};

}  // namespace gearshift::cabin
