// Prints a result as JSON to stdout, in place of the verb's text.
#pragma once

#include <nlohmann/json.hpp>

#include "app/base/console.h"

namespace gearshift::verbs {

// Bytes that are not UTF-8, as in a name of a damaged file, become U+FFFD.
inline void print_json(const nlohmann::ordered_json& json) {
  base::print_out("{}\n", json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace gearshift::verbs
