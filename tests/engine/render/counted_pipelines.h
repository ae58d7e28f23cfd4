// Counts compiled pipelines: the test program overrides the loader's function.
#pragma once

namespace gearshift::test {

extern int compiled_pipelines;  // so far

}  // namespace gearshift::test
