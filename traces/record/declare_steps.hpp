// Turns a module's steps.def into typed constants and a table. No include guard: it is included once per module, as
//
//     #define ZSTEP_MODULE z_buffer                            // the namespace zstep::z_buffer and the module's name
//     #define ZSTEP_FIRST_STEP 64                              // ids of its steps begin here
//     #define ZSTEP_STEPS "algorithms/z_buffer/steps.def"
//     #include "traces/record/declare_steps.hpp"
//
// A steps.def holds, in reading order,
//     STEP(indent, name, Event, "the line of pseudo-code")
//     STEPS_OF(module)          where the lines of another module stand in this page
//     STEPS_FROM(module, name)  the same, but only those from `name` on
//     STEP_OF(indent, module, name, "text")  one line of another module, in this page's own place and words
// and yields zstep::z_buffer::step::name (a Step<Event>) and zstep::z_buffer::page().

#ifndef ZSTEP_STRINGIZE
#define ZSTEP_STRINGIZE_(text) #text
#define ZSTEP_STRINGIZE(text) ZSTEP_STRINGIZE_(text)
#endif

#include "traces/record/recorder.hpp"

namespace zstep::ZSTEP_MODULE {

namespace step {
namespace id {
enum : std::uint8_t {
  before_first = ZSTEP_FIRST_STEP - 1,
#define STEP(indent, name, event, text) name,
#define STEPS_OF(module)
#define STEPS_FROM(module, first)
#define STEP_OF(indent, module, name, text)
#include ZSTEP_STEPS
#undef STEP
#undef STEPS_OF
#undef STEPS_FROM
#undef STEP_OF
  end
};
static_assert(end <= step_limit, "a trace has room for 125 steps");
}  // namespace id

#define STEP(indent, name, event, text) inline constexpr Step<event> name{id::name};
#define STEPS_OF(module)
#define STEPS_FROM(module, first)
#define STEP_OF(indent, module, name, text)
#include ZSTEP_STEPS
#undef STEP
#undef STEPS_OF
#undef STEPS_FROM
#undef STEP_OF
}  // namespace step

/// This module's lines of pseudo-code, those of the modules it builds on included where they are read.
inline Page page() {
  Page lines;
#define STEP(indent, name, event, text) \
  lines.push_back({step::id::name, kind_of<event>, indent, ZSTEP_STRINGIZE(ZSTEP_MODULE), #name, text});
#define STEPS_OF(module) \
  for (StepInfo & line : ::zstep::module::page()) lines.push_back(line);
#define STEPS_FROM(module, first)                                          \
  for (StepInfo & line : ::zstep::module::page()) {                        \
    if (line.id >= ::zstep::module::step::first.id) lines.push_back(line); \
  }
#define STEP_OF(indent, module, name, text)                                                                          \
  lines.push_back({::zstep::module::step::name.id,                                                                   \
                   []<class E>(Step<E>) { return kind_of<E>; }(::zstep::module::step::name), indent, #module, #name, \
                   text});
#include ZSTEP_STEPS
#undef STEP
#undef STEPS_OF
#undef STEPS_FROM
#undef STEP_OF
  return lines;
}

}  // namespace zstep::ZSTEP_MODULE

#undef ZSTEP_MODULE
#undef ZSTEP_FIRST_STEP
#undef ZSTEP_STEPS
