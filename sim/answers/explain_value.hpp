// Where a number comes from: the steps that made it, each with its formula and numbers, back to the lines of the mesh file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/answers/chain.hpp"
#include "traces/file/trace.hpp"

namespace zstep::answers {

/// A number of a trace. Exactly one of three: a field of the step `at`; a field of the last step of a kind up to `at` whose other
/// fields have these values ("x_edge of the last edge_step of edge 3"), which is how what the state holds came to be; or the depth
/// (the t, along a ray) that a pixel has at `at`.
struct Question {
  std::int64_t at = 0;
  std::string field;                 ///< as in the vocabulary; empty: the step's main one
  std::optional<std::uint8_t> kind;  ///< with `where`
  std::vector<std::pair<std::string, std::int32_t>> where;
  std::optional<Trace::Pixel> pixel;
  bool operator==(const Question& other) const;
};

/// A question about a row of what the state holds.
template <class E>
Question made_by(std::int64_t at, std::string field, std::vector<std::pair<std::string, std::int32_t>> where = {}) {
  return {at, std::move(field), kind_of<E>, std::move(where), {}};
}

/// The step whose field answers the question, and that field; nothing where there is none.
struct Place {
  std::int64_t step = 0;
  std::string field;
};
std::optional<Place> place_of(const Trace& trace, const Question& question);

/// The chain; without links where the question has no answer. Throws InputError where the trace is damaged or tells what cannot be.
Chain explain_value(const Trace& trace, const Question& question);

/// The fields of a step's event, by name.
std::vector<std::string> fields_of_step(const Trace& trace, std::int64_t step);

}  // namespace zstep::answers
