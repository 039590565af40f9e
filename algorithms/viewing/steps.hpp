// The steps of viewing, and of culling and clipping one polygon.
#pragma once
#define ZSTEP_MODULE viewing
#define ZSTEP_FIRST_STEP 1
#define ZSTEP_STEPS "algorithms/viewing/steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE clipping
#define ZSTEP_FIRST_STEP 8
#define ZSTEP_STEPS "algorithms/viewing/clipping_steps.def"
#include "traces/record/declare_steps.hpp"
