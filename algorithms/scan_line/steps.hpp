// The steps of the scan-line method.
#pragma once
#include "algorithms/pieces/steps.hpp"

#define ZSTEP_MODULE scan_line
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/scan_line/steps.def"
#include "traces/record/declare_steps.hpp"
