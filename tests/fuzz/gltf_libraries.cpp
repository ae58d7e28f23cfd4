// The libraries behind read_gltf() once more, from their headers, so that the sanitizers see into them: the system's
// shared ones are not instrumented.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
