// Typefaces: found on the system, or done without.
#include <cstdlib>

#include <doctest/doctest.h>

#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("with or without a system font, every character that is drawn has a glyph or an ASCII substitute") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.settle();
  const Fonts& fonts = app.ui().fonts;
  if (!fonts.lacking.empty() && std::getenv("ZSTEP_FONTS")) {
    CHECK(fonts.drawable("\u2212\u221e \u2264 \u03c6") == "-inf <= phi");
  }
  const std::string used =
      "\u2212 \u00b7 \u221e \u03c6 \u03b8 \u03c1 \u2264 \u2265 \u2192 \u2190 \u25b6 \u25c0 \u2026 \u2013 \u00d7 \u2713 "
      "\u2717 \u2022 x\u2080";
  const std::string shown = fonts.drawable(used);
  for (std::size_t at = 0; at < shown.size();) {
    const auto lead = static_cast<unsigned char>(shown[at]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : 3;
    unsigned code = length == 1 ? lead : length == 2 ? lead & 0x1fu : lead & 0x0fu;
    for (std::size_t k = 1; k < length; ++k) code = code << 6 | (static_cast<unsigned char>(shown[at + k]) & 0x3fu);
    CAPTURE(code);
    for (const ImFont* font : {fonts.text, fonts.bold, fonts.mono, fonts.small})
      CHECK(font->FindGlyphNoFallback(static_cast<ImWchar>(code)));
    at += length;
  }
}

TEST_CASE("digits are all as wide, so that numbers line up") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.settle();
  for (const ImFont* font : {app.ui().fonts.text, app.ui().fonts.mono, app.ui().fonts.small})
    for (ImWchar digit = '1'; digit <= '9'; ++digit) CHECK(font->GetCharAdvance(digit) == font->GetCharAdvance('0'));
}
