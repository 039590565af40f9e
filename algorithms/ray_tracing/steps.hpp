// The steps of ray tracing.
#pragma once
#include "algorithms/ray_casting/steps.hpp"
#define ZSTEP_MODULE ray_tracing
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/ray_tracing/steps.def"
#include "traces/record/declare_steps.hpp"
