// The steps of scan conversion with an edge table and an active edge list.
#pragma once
#define ZSTEP_MODULE scan_conversion
#define ZSTEP_FIRST_STEP 24
#define ZSTEP_STEPS "algorithms/scan_conversion/steps.def"
#include "traces/record/declare_steps.hpp"
