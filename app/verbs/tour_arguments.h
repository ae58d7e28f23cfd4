// The command line of a drive through every gear: what `tour` and `demo` share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/tour/tour.h"

namespace gearshift {

struct TourArguments {
  std::string folder;
  std::string gate = "paper";
  std::string preset = "default";
  std::string hand;            // empty: the preset's, or a grip where that cannot lead
  std::optional<double> rate;  // [Hz] none: the preset's
  std::uint64_t seed = 1;
};

HandImpedance driving_hand(const std::string& text);  // one that can lead a lever. Throws CLI::ValidationError

void add_tour_options(CLI::App& verb, TourArguments& arguments);

// Throws FileError, CLI::ValidationError.
TourSetup make_tour_setup(const TourArguments& arguments);

}  // namespace gearshift
