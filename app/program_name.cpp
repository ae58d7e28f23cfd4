#include "app/program_name.h"

namespace gearshift {

std::string program_name() {
  return "gearshift " GEARSHIFT_VERSION;
}

}  // namespace gearshift
