// Compiles toml++ from its headers, so that libFuzzer and the sanitizers instrument it; the system's shared library is
// not instrumented. Assertions are off, as in the shared library: one assertion fails at a stray '\r', although the
// code after the assertion rejects the '\r' properly.
#define NDEBUG
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
