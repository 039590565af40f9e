// The recorders that every algorithm is compiled for. A method's .cpp ends with
//
//     #define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
//     ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#pragma once

#include "traces/record/recorder.hpp"
#include "traces/record/trace_recorder.hpp"

#define ZSTEP_FOR_EACH_RECORDER(INSTANTIATE) \
  INSTANTIATE(::zstep::NullRecorder)         \
  INSTANTIATE(::zstep::CountRecorder)        \
  INSTANTIATE(::zstep::CollectRecorder)      \
  INSTANTIATE(::zstep::TraceRecorder)
