// The steps of depth sort.
#pragma once
#include "algorithms/pieces/steps.hpp"
#define ZSTEP_MODULE depth_sort
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/depth_sort/steps.def"
#include "traces/record/declare_steps.hpp"
