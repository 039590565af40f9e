// The steps of Warnock's algorithm.
#pragma once
#include "algorithms/pieces/steps.hpp"
#define ZSTEP_MODULE warnock
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/warnock/steps.def"
#include "traces/record/declare_steps.hpp"
