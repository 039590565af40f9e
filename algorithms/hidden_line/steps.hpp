// The steps of hidden-line removal.
#pragma once
#include "algorithms/hidden_line/line_steps.hpp"
#include "algorithms/pieces/steps.hpp"
#define ZSTEP_MODULE hidden_line
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/hidden_line/steps.def"
#include "traces/record/declare_steps.hpp"
