// The steps of the shadow buffer. Those of the Z-buffer, which it runs twice, have the numbers from 64.
#pragma once
#include "algorithms/z_buffer/steps.hpp"
#define ZSTEP_MODULE shadow_buffer
#define ZSTEP_FIRST_STEP 80
#define ZSTEP_STEPS "algorithms/shadow_buffer/steps.def"
#include "traces/record/declare_steps.hpp"
