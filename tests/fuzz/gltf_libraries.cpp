// Compiles the libraries behind read_gltf() from their headers, so that the sanitizers instrument them; the system's
// shared libraries are not instrumented.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
