// The one place that compiles tinygltf. Without a file system it forgets a header that its writer needs.
#include <fstream>

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
