// How often a pipeline was compiled: the test program stands before the loader's function.
#pragma once

namespace gearshift {

extern int compiled_pipelines;  // so far

}  // namespace gearshift
