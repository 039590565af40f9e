// The vocabulary as a table for people, generated from its description.
#pragma once

#include <string>

namespace zstep {

/// Markdown: a heading and a table of fields for every kind of event, in the vocabulary's order. It is the last section
/// of docs/trace-format.md; a test holds the two together.
std::string vocabulary_markdown();

}  // namespace zstep
