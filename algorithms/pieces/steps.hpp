// The steps of gathering all polygons, of cutting them, and of painting them.
#pragma once
#include "algorithms/scan_conversion/steps.hpp"
#include "algorithms/viewing/steps.hpp"

#define ZSTEP_MODULE pieces
#define ZSTEP_FIRST_STEP 40
#define ZSTEP_STEPS "algorithms/pieces/steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE painting
#define ZSTEP_FIRST_STEP 48
#define ZSTEP_STEPS "algorithms/pieces/painting_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE cutting
#define ZSTEP_FIRST_STEP 52
#define ZSTEP_STEPS "algorithms/pieces/cutting_steps.def"
#include "traces/record/declare_steps.hpp"
