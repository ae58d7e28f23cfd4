// Command-line options of a drive through every gear, shared by `tour` and `demo`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/lab/tour/tour.h"

namespace gearshift::verbs {

struct TourArguments {
  std::string folder;
  std::string gate = "paper";
  std::string preset = "default";
  std::string hand;            // empty: the preset's, or a grip if that is too soft to move the lever
  std::optional<double> rate;  // [Hz] empty: the preset's
  std::uint64_t seed = 1;
};

// Parses a hand that is stiff enough to move the lever. Throws CLI::ValidationError.
haptics::HandImpedance driving_hand(const std::string& text);

void add_tour_options(CLI::App& verb, TourArguments& arguments);

// Throws FileError, CLI::ValidationError.
lab::TourSetup make_tour_setup(const TourArguments& arguments);

}  // namespace gearshift::verbs
