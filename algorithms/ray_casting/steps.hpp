// The steps of ray casting: putting facets into boxes, following one ray, and the method.
#pragma once

#define ZSTEP_MODULE boxes
#define ZSTEP_FIRST_STEP 104
#define ZSTEP_STEPS "algorithms/ray_casting/boxes_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE meeting
#define ZSTEP_FIRST_STEP 112
#define ZSTEP_STEPS "algorithms/ray_casting/meeting_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE ray_casting
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/ray_casting/steps.def"
#include "traces/record/declare_steps.hpp"
