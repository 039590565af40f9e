// Mutations of a trace's file behind its checksums: parts are unpacked, changed, packed and sealed again.
#pragma once

#include <span>

#include "tests/fuzz/text_mutator.hpp"
#include "traces/file/container.hpp"
#include "traces/file/trace.hpp"

namespace zstep::fuzz {

/// A trace of JSON Lines. Throws InputError.
Trace trace_of_lines(const std::string& text);
/// The same as a file.
Bytes bytes_of_lines(const std::string& text);

/// The trace with something of it changed, sealed; unchanged where its chunks cannot be read.
Bytes mutate_trace(std::span<const std::uint8_t> bytes, const TextMutator& words, Random& random);

}  // namespace zstep::fuzz
