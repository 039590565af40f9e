// Where the checkout and the program lie. Only where.cpp is compiled with these paths, so that a compiler cache serves
// the other tests to every checkout.
#pragma once

#include <string>

namespace zstep::test {

/// The full path of something in the checkout: in_checkout("tests/golden/").
std::string in_checkout(const std::string& path);

/// The full path of the program `zstep`.
std::string program_path();

}  // namespace zstep::test
