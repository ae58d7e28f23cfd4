// Draws the tachometer's red line for the current car.
#pragma once

#include <array>

#include "engine/model/model.h"

namespace gearshift::cabin {

// The dial in the cabin's model file has a red line of its own. This class recolours arc, ticks and numbers in the
// base-colour and emissive textures so that they are red from the car's red line to the end of the scale. If the car's
// red line is beyond the scale, nothing is red.
class DialPrint {
 public:
  // Saves the dial textures of the model. Throws std::runtime_error if the model has none.
  explicit DialPrint(const engine::Model& model);

  // Draws into the model's textures. red_line [rad/s]; <= 0: there is no car, and the dial is not changed. Returns true
  // if the dial changed.
  bool print(engine::Model& model, double red_line);

 private:
  std::array<int, 2> texture_;             // indices of the base-colour and the emissive texture
  std::array<engine::Image, 2> original_;  // the dial's area of these textures, as in the model file
  double red_line_ = 0.0;                  // [rad/s] red line drawn last; 0: dial as in the model file
};

}  // namespace gearshift::cabin
