// The steps of the naive painter's algorithm.
#pragma once
#include "algorithms/pieces/steps.hpp"
#define ZSTEP_MODULE painter
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/depth_sort/painter_steps.def"
#include "traces/record/declare_steps.hpp"
