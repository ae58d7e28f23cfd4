#include "app/base/program_name.h"

namespace gearshift::base {

std::string program_name() {
  return "gearshift " GEARSHIFT_VERSION;
}

}  // namespace gearshift::base
