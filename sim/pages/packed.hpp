// Bytes inside a page: small, and safe wherever HTML is.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace zstep {

/// As a .gz file, which a browser can unpack by itself; told between its parts how much of it is done, from 0 to 1.
std::vector<std::uint8_t> gzip(std::span<const std::uint8_t> bytes, const std::function<void(double)>& on_part = {});

/// Bytes as text that can stand in a script element: seven bits a letter of ASCII, and fourteen a letter of two bytes
/// where the first seven would be NUL, CR or "<". 8/7 of the bytes; base64 takes 4/3. sim/web/one_page.py writes the
/// same, sim/web/page/packed.js reads it.
std::string seven_bits(std::span<const std::uint8_t> bytes);

/// The element that packed.js looks for.
std::string packed_element(const std::string& name, std::span<const std::uint8_t> gzipped);

}  // namespace zstep
