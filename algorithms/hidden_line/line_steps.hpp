// The steps that wireframe and hidden lines share.
#pragma once
#include "algorithms/viewing/steps.hpp"
#define ZSTEP_MODULE lines
#define ZSTEP_FIRST_STEP 56
#define ZSTEP_STEPS "algorithms/hidden_line/line_steps.def"
#include "traces/record/declare_steps.hpp"
