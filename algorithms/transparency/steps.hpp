// The steps of drawing what is transparent. Those of building a BSP tree and of going through it have the numbers from
// 64.
#pragma once
#include "algorithms/bsp/steps.hpp"
#define ZSTEP_MODULE transparency
#define ZSTEP_FIRST_STEP 96
#define ZSTEP_STEPS "algorithms/transparency/steps.def"
#include "traces/record/declare_steps.hpp"
