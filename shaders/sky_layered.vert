#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#define LAYERED
#include "shared.h"
#include "sky_vertex.glsl"
