// The steps of the Z-buffer that goes by planes: one more than the others.
#pragma once
#include "algorithms/z_buffer/steps.hpp"
#define ZSTEP_MODULE interpolation
#define ZSTEP_FIRST_STEP 72
#define ZSTEP_STEPS "algorithms/interpolation/steps.def"
#include "traces/record/declare_steps.hpp"
