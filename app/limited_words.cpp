#include "app/limited_words.h"

#include <fmt/format.h>

namespace gearshift {

std::string limited_words(const Limited& limited) {
  const bool used_all_the_same = limited.used == limited.wanted;
  const std::string what =
      used_all_the_same
          ? fmt::format("{} {:g} used all the same, the bound is {:g}", limited.what, limited.wanted, limited.bound)
          : fmt::format("{} limited from {:g} to {:g}", limited.what, limited.wanted, limited.used);
  return fmt::format("{} ({}{}{})", what, limited.law, limited.hand.empty() ? "" : "; hand: ", limited.hand);
}

}  // namespace gearshift
