// Selects the letters of a Turkish locale during its lifetime: std::tolower('I') is 'I', because the Turkish lower-case
// letter (dotless i) does not fit into one byte. The locale is compiled into a temporary folder, because the system may
// have no Turkish locale.
#pragma once

#include <cctype>
#include <clocale>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

namespace gearshift::test {

class TurkishLetters {
 public:
  TurkishLetters() : locpath_("LOCPATH", folder_.path().c_str()) {
    const std::string locale_folder = (folder_ / "tr_TR.UTF-8").string();
    if (std::system(("localedef -i tr_TR -f UTF-8 " + locale_folder).c_str()) != 0 ||
        std::setlocale(LC_CTYPE, "tr_TR.UTF-8") == nullptr || std::tolower('I') != 'I')
      throw std::runtime_error("no Turkish locale can be made: install the package locales");
  }
  ~TurkishLetters() { std::setlocale(LC_CTYPE, "C"); }
  TurkishLetters(const TurkishLetters&) = delete;
  TurkishLetters& operator=(const TurkishLetters&) = delete;

 private:
  TempFolder folder_;
  Variable locpath_;
};

}  // namespace gearshift::test
