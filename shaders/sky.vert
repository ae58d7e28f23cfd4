#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "sky_vertex.glsl"
