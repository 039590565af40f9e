// The steps of the wireframe.
#pragma once
#include "algorithms/hidden_line/line_steps.hpp"
#define ZSTEP_MODULE wireframe
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/hidden_line/wireframe_steps.def"
#include "traces/record/declare_steps.hpp"
