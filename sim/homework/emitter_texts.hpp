// What the files that write a run begin and end with, in each language: how a line is printed, and where from. $name,
// $NAME and $Name are what the file is called; $header is the text of a header, in pieces with commas behind them, and
// $header0 the same and a 0 behind it.
#pragma once

#include <string_view>

namespace zstep::homework::emitter_texts {

extern const std::string_view c_begin, c_header, cpp_begin, cpp_header, python_begin, python_header, javascript_begin,
    javascript_header, java_begin, java_header, java_header_given, rust_begin, rust_header, rust_header_given;

}  // namespace zstep::homework::emitter_texts
