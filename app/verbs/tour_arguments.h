// Command-line options for a drive through every gear, shared by the verbs `tour` and `demo`.
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
  std::string hand;            // empty: the preset's hand, or "grip" if the preset's is too soft to move the lever
  std::optional<double> rate;  // [Hz] empty: the preset's rate
  std::uint64_t seed = 1;
};

// Parses a hand. Throws CLI::ValidationError if the hand is invalid or not stiff enough to move the lever.
haptics::HandImpedance driving_hand(const std::string& text);

void add_tour_options(CLI::App& verb, TourArguments& arguments);

// Throws FileError, CLI::ValidationError.
lab::TourSetup make_tour_setup(const TourArguments& arguments);

}  // namespace gearshift::verbs
