// The demo as one page for people: index.html beside the pictures it shows.
#pragma once

#include "app/demo/demo.h"

namespace gearshift {

// No script, nothing from outside the folder. Throws FileError.
void write_demo_page(const DemoSetup& setup, const DemoResult& result);

}  // namespace gearshift
