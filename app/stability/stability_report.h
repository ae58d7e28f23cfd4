// The answer in words, as JSON and as CSV.
#pragma once

#include <string>

#include "app/stability/stability.h"
#include "app/stability/trainer_answer.h"

namespace gearshift {

std::string stability_text(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const TrainerAnswer& trainer);
std::string stability_json(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const TrainerAnswer& trainer);
std::string stability_csv(const StabilityQuestion& question, const StabilityMap& map);

// What text and drawing both say.
std::string device_words(const StabilityQuestion& question);  // "the paper's X axis: m = 0.095 kg, ..."
std::string loop_words(const StabilityQuestion& question);    // "1000 Hz, no delay, zero-order hold, ..."

}  // namespace gearshift
