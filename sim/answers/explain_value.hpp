// Where a number comes from: the steps that made it, each with its formula and numbers, back to the lines of the mesh
// file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/answers/origin/chain.hpp"
#include "traces/file/trace.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

/// A number of a trace. Without more it is a field of the step `at`; with one of the others it is a number that the
/// state holds at `at`, and stands where it was made.
struct Question {
  std::int64_t at = 0;
  std::string field = {};                                        ///< as in the vocabulary; empty: the step's main one
  std::vector<std::uint8_t> kinds = {};                          ///< of the last step of one of these kinds …
  std::vector<std::pair<std::string, std::int32_t>> where = {};  ///< … whose other fields have these values …
  std::optional<double> value = {};                              ///< … and whose field has this one
  /// The depth of this pixel, and where its attribute shades it, its colour; of the light's picture with `light`.
  std::optional<Trace::Pixel> pixel = {};
  bool light = false;
  std::optional<std::int32_t> vertex =
      {};  ///< a coordinate of this vertex: x_w, y_w, z_w in the world, else a field of its steps
};

/// A question about a row of what the state holds: made_by<EdgeStep, EdgeTableInsert>(at, "x_edge", {{"edge", 3}}).
template <class... E>
Question made_by(std::int64_t at, std::string field, std::vector<std::pair<std::string, std::int32_t>> where = {}) {
  Question question;
  question.at = at;
  question.field = std::move(field);
  question.kinds = {kind_of<E>...};
  question.where = std::move(where);
  return question;
}
inline Question of_pixel(std::int64_t at, Trace::Pixel pixel) {
  Question question;
  question.at = at;
  question.pixel = pixel;
  return question;
}
inline Question of_vertex(std::int64_t at, std::int32_t vertex, std::string field) {
  Question question;
  question.at = at;
  question.field = std::move(field);
  question.vertex = vertex;
  return question;
}

/// The step whose field answers the question, and that field; step 0 for the scene's own numbers. Nothing where there
/// is none.
struct Place {
  std::int64_t step = 0;
  std::string field;
};
std::optional<Place> place_of(const Trace& trace, const Question& question);

/// The chain; without links where the question has no answer. Throws InputError where the trace is damaged or tells
/// what cannot be. With a replay of the trace at hand there is no seek from the beginning; it is left somewhere else
/// than it was.
Chain explain_value(const Trace& trace, const Question& question);
Chain explain_value(const Trace& trace, Replay& replay, const Question& question);

/// The fields of a step's event, by name.
std::vector<std::string> fields_of_step(const Trace& trace, std::int64_t step);
/// The field of a step whose value is written so in a sentence, rounded: "z" for "0.3333". Empty where there is none.
std::string field_shown_as(const Trace& trace, std::int64_t step, std::string_view number);
/// The link that explains the number written so in the formulas of the first one: of an operand, or of what was asked
/// for. 0 where none does, as the number is a plain one.
std::size_t link_shown_as(const Chain& chain, std::string_view number);

}  // namespace zstep::answers
