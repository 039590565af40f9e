// The steps of the Z-buffer.
#pragma once
#include "algorithms/scan_conversion/steps.hpp"
#include "algorithms/viewing/steps.hpp"
#define ZSTEP_MODULE z_buffer
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/z_buffer/steps.def"
#include "traces/record/declare_steps.hpp"
