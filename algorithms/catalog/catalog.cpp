#include "algorithms/catalog/catalog.hpp"

#include <array>
#include <string>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "traces/error.hpp"

namespace zstep {

namespace {

// A method is a folder with a page of steps and a function `run`; here it gets its names and its paper.
#define METHOD(id, title, paper, module)                                                                              \
  Method {                                                                                                            \
    id, title, paper, module::page, module::run<NullRecorder>, module::run<CountRecorder>, module::run<TraceRecorder> \
  }

constexpr std::array catalog{
    METHOD("z-buffer", "Z-buffer",
           "E. Catmull, A Subdivision Algorithm for Computer Display of Curved Surfaces, PhD thesis, University of "
           "Utah, 1974",
           z_buffer),
};

#undef METHOD

}  // namespace

std::span<const Method> methods() { return catalog; }

const Method& method(std::string_view id) {
  std::string known;
  for (const Method& candidate : catalog) {
    if (candidate.id == id) return candidate;
    known += (known.empty() ? "" : ", ") + std::string(candidate.id);
  }
  throw InputError("--algorithm " + std::string(id), "there is no such method", "the methods are: " + known);
}

Header header_for(const Method& method, const Conventions& conventions) {
  return {"zstep " ZSTEP_VERSION, std::string(method.id), std::string(method.title), conventions, method.page()};
}

}  // namespace zstep
