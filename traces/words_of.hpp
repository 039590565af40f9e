// The words that stand for the values of an enumeration in traces, on the command line and in lessons.
#pragma once

namespace zstep {

/// In value order from 0. Specialised, as an array of texts, beside every enumeration that an event or a header
/// carries.
template <class Enumeration>
inline constexpr auto words_of = nullptr;

}  // namespace zstep
