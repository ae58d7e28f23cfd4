// Writes the demo page, index.html, into the folder of the pictures that it shows.
#pragma once

#include "app/demo/demo.h"

namespace gearshift::demo {

// Writes a page that has no script and loads nothing from outside its folder. Throws FileError.
void write_demo_page(const DemoSetup& setup, const DemoResult& result);

}  // namespace gearshift::demo
