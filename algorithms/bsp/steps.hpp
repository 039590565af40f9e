// The steps of building a BSP tree, of going through it, and of drawing with it.
#pragma once
#include "algorithms/pieces/pieces.hpp"
#include "algorithms/viewing/vertices.hpp"

#define ZSTEP_MODULE bsp_build
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/bsp/build_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE bsp_traverse
#define ZSTEP_FIRST_STEP 80
#define ZSTEP_STEPS "algorithms/bsp/traverse_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE bsp
#define ZSTEP_FIRST_STEP 88
#define ZSTEP_STEPS "algorithms/bsp/steps.def"
#include "traces/record/declare_steps.hpp"
