// Compiles toml++ from its headers, so that libFuzzer and the sanitizers instrument it; the system's shared library is
// not instrumented. Without assertions, like that one: one of them fails at a stray '\r', which the code after it
// rejects properly.
#define NDEBUG
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
