#include "app/limited_words.h"

#include <fmt/format.h>

#include "app/hold_words.h"

namespace gearshift {
namespace {

bool is_hold(const Limited& limited) {
  return limited.what == "hold";
}
bool is_raised(const Limited& limited) {
  return !is_hold(limited) && limited.used > limited.wanted;
}

// A hold is told by its name.
std::string value_words(const Limited& limited, double value) {
  return is_hold(limited) ? hold_name(static_cast<ContactHold>(value)) : fmt::format("{:g}", value);
}

}  // namespace

std::string limited_words(const Limited& limited) {
  const bool used_all_the_same = limited.used == limited.wanted;
  const std::string what =
      used_all_the_same
          ? fmt::format("{} {:g} used all the same, the bound is {:g}", limited.what, limited.wanted, limited.bound)
          : fmt::format("{} {} from {} to {}", limited.what, is_raised(limited) ? "raised" : "limited",
                        value_words(limited, limited.wanted), value_words(limited, limited.used));
  return fmt::format("{} ({}{}{})", what, limited.law, limited.hand.empty() ? "" : "; hand: ", limited.hand);
}

}  // namespace gearshift
