// Formats the answer as text, JSON and CSV.
#pragma once

#include <string>

#include "app/lab/stability/runtime_answer.h"
#include "app/lab/stability/stability.h"

namespace gearshift::lab {

std::string stability_text(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const RuntimeAnswer& runtime);
std::string stability_json(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const RuntimeAnswer& runtime);
std::string stability_csv(const StabilityQuestion& question, const StabilityMap& map);

// Helpers for text and drawing.
std::string describe_device(const StabilityQuestion& question);  // "the paper's X axis: m = 0.095 kg, ..."
std::string describe_loop(const StabilityQuestion& question);    // "1000 Hz, no delay, zero-order hold, ..."

}  // namespace gearshift::lab
