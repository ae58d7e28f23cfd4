// toml++ once more, from its headers, so that libFuzzer and the sanitizers see into it: the system's shared library is not
// instrumented. Without assertions, as that one: it has one that a stray '\r' fails, behind which the refusal stands.
#define NDEBUG
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
