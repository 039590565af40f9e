// The steps of the floating horizon.
#pragma once
#include "algorithms/viewing/steps.hpp"
#define ZSTEP_MODULE floating_horizon
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/floating_horizon/steps.def"
#include "traces/record/declare_steps.hpp"
