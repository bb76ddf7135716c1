// Shader texts: the GLSL that programs are put together from, each text by what it is about.
//
// Order     a fragment shader is kFrame, then kNoise, kGroundPatches, kGround and kLight where it shades, then its own text;
//           grass shades in its vertex shader, without kGround
#pragma once

namespace bosquet::render {

// shader_light.cpp: the block of values that all read, noise, and light that falls on a point.
extern const char* const kFrame;
extern const char* const kNoise;
extern const char* const kLight;

// shader_surfaces.cpp: meshes, what stands on the ground, and shadow maps.
extern const char* const kMeshVertex;
extern const char* const kMeshFragment;
extern const char* const kSurfaceMain;
extern const char* const kSolid;
extern const char* const kLeafCover;
extern const char* const kLeaf;
extern const char* const kShadowVertex;
extern const char* const kShadowSolid;
extern const char* const kShadowLeaf;

// shader_ground.cpp
extern const char* const kGroundPatches;
extern const char* const kGround;
extern const char* const kGroundMain;

// shader_grass.cpp: tufts, lit by the vertex.
extern const char* const kGrassVertex;
extern const char* const kGrassFragment;

// shader_sky.cpp: water, sky and the land around the site.
extern const char* const kWater;
extern const char* const kWaterMain;
extern const char* const kSkyVertex;
extern const char* const kSkyFragment;

}  // namespace bosquet::render
