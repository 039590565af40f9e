// Pictures and tables: what is written is read back, and what goes wrong says so and leaves nothing behind.
#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "tests/exr_bytes.hpp"
#include "tests/folder.hpp"
#include "traces/image/bmp_tga.hpp"
#include "traces/image/exr.hpp"
#include "traces/image/file.hpp"
#include "traces/image/png.hpp"
#include "traces/image/tables.hpp"
#include "traces/error.hpp"

namespace fs = std::filesystem;
using namespace zstep;

namespace {

std::vector<std::uint8_t> gradient(int width, int height) {
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int k = 0; k < 3; ++k) rgb.push_back(static_cast<std::uint8_t>(x * 7 + y * 31 + k * 85));
  return rgb;
}

}  // namespace

TEST_CASE("a PNG reads back as the pixels that were written, the top row first") {
  const test::Folder folder;
  const std::vector<std::uint8_t> rgb = gradient(13, 7);
  write_png(folder.path() / "a.png", 13, 7, rgb);
  const Image image = read_png(folder.path() / "a.png");
  CHECK(image.width == 13);
  CHECK(image.height == 7);
  CHECK(image.rgb == rgb);
  CHECK(folder.names() == std::vector<std::string>{"a.png"});
  CHECK(test::text_of(folder.path() / "a.png").substr(1, 3) == "PNG");
}

TEST_CASE("the same pixels give the same bytes, and an old file is replaced") {
  const test::Folder folder;
  write_png(folder.path() / "a.png", 5, 5, gradient(5, 5));
  write_png(folder.path() / "b.png", 3, 3, gradient(3, 3));
  write_png(folder.path() / "b.png", 5, 5, gradient(5, 5));
  CHECK(read_file(folder.path() / "a.png") == read_file(folder.path() / "b.png"));
  CHECK(folder.names().size() == 2);
}

TEST_CASE("where a picture cannot be written an InputError says why") {
  const test::Folder folder;
  const std::vector<std::uint8_t> rgb = gradient(4, 4);
  CHECK_THROWS_WITH_AS(write_png(folder.path() / "none" / "a.png", 4, 4, rgb), doctest::Contains("there is no folder"),
                       InputError);
  CHECK_THROWS_WITH_AS(write_png(folder.path(), 4, 4, rgb), doctest::Contains("is a folder"), InputError);
  CHECK(folder.names().empty());
  if (fs::exists("/dev/full"))
    CHECK_THROWS_WITH_AS(write_png("/dev/full", 4, 4, rgb), doctest::Contains("No space left"), InputError);
}

TEST_CASE("pixels that do not fill the picture are the caller's mistake") {
  const test::Folder folder;
  CHECK_THROWS_AS(write_png(folder.path() / "a.png", 4, 5, gradient(4, 4)), std::invalid_argument);
  CHECK_THROWS_AS(write_png(folder.path() / "a.png", 0, 4, {}), std::invalid_argument);
}

TEST_CASE("a PNG cut off anywhere, or a file that is none, is an InputError") {
  const test::Folder folder;
  write_png(folder.path() / "a.png", 9, 9, gradient(9, 9));
  const std::vector<std::uint8_t> whole = read_file(folder.path() / "a.png");
  const fs::path cut = folder.path() / "cut.png";
  // Everything up to the end of the image data; the last 12 bytes are the empty IEND chunk, which no pixel needs.
  for (std::size_t size = 0; size + 16 < whole.size(); ++size) {
    write_file(cut, std::span(whole).first(size));
    CHECK_THROWS_AS(read_png(cut), InputError);
  }
  CHECK_THROWS_WITH_AS(read_png(folder.path() / "none.png"), doctest::Contains("there is no such file"), InputError);
}

TEST_CASE_TEMPLATE("an .npy reads back with its type, shape and values", Value, std::int32_t, float, double) {
  const test::Folder folder;
  std::vector<Value> values{Value(0), Value(-1), Value(2), Value(3), Value(1000000), Value(5)};
  if constexpr (std::numeric_limits<Value>::has_infinity) values[4] = std::numeric_limits<Value>::infinity();
  write_npy(folder.path() / "a.npy", std::span<const Value>(values), 2, 3);
  const Npy read = read_npy(folder.path() / "a.npy");
  CHECK(read.height == 2);
  CHECK(read.width == 3);
  REQUIRE(std::holds_alternative<std::vector<Value>>(read.values));
  CHECK(std::get<std::vector<Value>>(read.values) == values);
  CHECK((fs::file_size(folder.path() / "a.npy") - values.size() * sizeof(Value)) % 64 == 0);
}

TEST_CASE("the head of an .npy is what NumPy writes") {
  const test::Folder folder;
  const std::vector<std::int32_t> values{1, 2};
  write_npy(folder.path() / "a.npy", values, 1, 2);
  const std::string text = test::text_of(folder.path() / "a.npy");
  CHECK(text.substr(0, 10) == std::string("\x93NUMPY\x01\x00\x76\x00", 10));
  CHECK(text.find("{'descr': '<i4', 'fortran_order': False, 'shape': (1, 2), }") == 10);
  CHECK(text[127] == '\n');
  CHECK(text.size() == 128 + 8);
}

TEST_CASE("an .npy cut off anywhere, or of another shape, is an InputError") {
  const test::Folder folder;
  const std::vector<float> values{1, 2, 3, 4};
  write_npy(folder.path() / "a.npy", values, 2, 2);
  const std::vector<std::uint8_t> whole = read_file(folder.path() / "a.npy");
  const fs::path cut = folder.path() / "cut.npy";
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_file(cut, std::span(whole).first(size));
    CHECK_THROWS_AS(read_npy(cut), InputError);
  }
  std::string text(whole.begin(), whole.end());
  text.replace(text.find("(2, 2)"), 6, "(2,2,)");
  const auto write_text = [&] {
    write_file(cut, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  };
  write_text();
  CHECK(read_npy(cut).width == 2);
  text.replace(text.find("(2,2,)"), 6, "(4,)  ");
  write_text();
  CHECK_THROWS_WITH_AS(read_npy(cut), doctest::Contains("two-dimensional"), InputError);
}

TEST_CASE("writing replaces the file a link points to, not the link") {
  const test::Folder folder;
  std::ofstream(folder.path() / "target") << "old";
  std::error_code error;
  fs::create_symlink("target", folder.path() / "link", error);
  if (error) return;  // a file system without links
  const std::string text = "new";
  write_file(folder.path() / "link", std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  CHECK(fs::is_symlink(folder.path() / "link"));
  CHECK(test::text_of(folder.path() / "target") == "new");
}

TEST_CASE("portable pixmaps and graymaps are read as text and as bytes, with comments and with values of two bytes") {
  const test::Folder folder;
  const auto read = [&](const std::string& text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    write_file(folder.path() / "a.ppm", bytes);
    return read_pnm(folder.path() / "a.ppm");
  };
  const Image expected{2, 1, {255, 0, 51, 0, 255, 102}};
  CHECK(read("P3\n# a comment\n2 1 # and one more\n255\n255 0 51  0 255 102\n") == expected);
  CHECK(read("P3 2 1 5 5 0 1 0 5 2") == expected);
  CHECK(read(std::string("P6\n2 1\n255\n\xff\0\x33\0\xff\x66", 17)) == expected);
  CHECK(read(std::string("P6\n2 1\n65535\n\xff\xff\0\0\x33\x33\0\0\xff\xff\x66\x66", 25)) == expected);
  const Image grey{1, 2, {0, 0, 0, 128, 128, 128}};
  CHECK(read("P2 1 2 255 0 128") == grey);
  CHECK(read(std::string("P5 1 2 255\n\0\x80", 13)) == grey);
}

TEST_CASE("a damaged pixmap says what is wrong with it") {
  const test::Folder folder;
  const auto said = [&](const std::string& text) -> std::string {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    write_file(folder.path() / "a.ppm", bytes);
    try {
      read_pnm(folder.path() / "a.ppm");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(said("").find("is no .ppm or .pgm") != std::string::npos);
  CHECK(said("P7 2 2 255 ").find("is no .ppm or .pgm") != std::string::npos);
  CHECK(said("P3 2").find("has no height in its head") != std::string::npos);
  CHECK(said("P3 0 2 255 ").find("has no size") != std::string::npos);
  CHECK(said("P3 2 2 70000 ").find("has no size, or no largest value") != std::string::npos);
  CHECK(said("P6 2 2 255\nabc").find("has not the 12 bytes of 2x2 pixels") != std::string::npos);
  CHECK(said("P6 2000000000 2000000000 255\nabc").find("has not 2000000000x2000000000 pixels") != std::string::npos);
  CHECK(said("P3 30000 30000 255 1 2 3").find("has not 30000x30000 pixels") != std::string::npos);
  CHECK(said("P2 2 1 7 3 8").find("has a value that is not from 0 to 7") != std::string::npos);
  CHECK(said("P2 2 1 7 3").find("has no value in its head") != std::string::npos);
}

namespace {

std::string little(std::uint32_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> 8 * i & 255);
  return text;
}
/// Of 3 by 2 pixels. `kind`: 2 as they are, 10 packed.
std::string tga(int kind, int bits, const std::string& rows) {
  return little(static_cast<std::uint32_t>(kind) << 16, 3) + std::string(9, '\0') + little(3, 2) + little(2, 2) +
         little(static_cast<std::uint32_t>(bits), 2) + rows;
}
std::string bmp(std::uint32_t bits, std::uint32_t packing, const std::string& rows) {
  return "BM" + little(54, 4) + little(0, 4) + little(54, 4) + little(40, 4) + little(3, 4) + little(2, 4) +
         little(1, 2) + little(bits, 2) + little(packing, 4) + std::string(20, '\0') + rows;
}

}  // namespace

TEST_CASE("a TGA whose rows are packed has the same pixels, and one that is cut off is refused") {
  const test::Folder folder;
  const std::string blue("\xff\0\0", 3), red("\0\0\xff", 3), green("\0\xff\0", 3);
  const auto read = [&](const std::string& bytes) {
    std::ofstream(folder.path() / "a.tga", std::ios::binary) << bytes;
    return read_bmp_or_tga(folder.path() / "a.tga").rgb;
  };
  const std::string rows = "\x82" + blue + "\x01" + red + green + std::string(1, '\0') + red;
  const std::vector<std::uint8_t> plain = read(tga(2, 24, blue + blue + blue + red + green + red));
  CHECK(plain.size() == 18);
  CHECK(read(tga(10, 24, rows)) == plain);
  for (std::size_t length = 0; length < rows.size(); ++length)
    CHECK_THROWS_AS(read(tga(10, 24, rows.substr(0, length))), InputError);
}

TEST_CASE("a BMP or a TGA that cannot be held against a scene is refused with the reason") {
  const test::Folder folder;
  const auto reason = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder.path() / name, std::ios::binary) << bytes;
    try {
      read_bmp_or_tga(folder.path() / name);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string row(12, '\x11');
  CHECK(reason("a.bmp", bmp(24, 0, row + row)).empty());
  for (const std::uint32_t packing : {1u, 2u})
    CHECK(reason("a.bmp", bmp(packing == 1 ? 8 : 4, packing, row + row)).find("packed rows (RLE)") !=
          std::string::npos);
  CHECK(reason("a.bmp", bmp(16, 0, row + row)).find("5 or 6 bits for each") != std::string::npos);
  for (const int kind : {2, 10})
    for (const int bits : {15, 16})
      CHECK(reason("a.tga", tga(kind, bits, row + row)).find("5 or 6 bits for each") != std::string::npos);
}

TEST_CASE("the depths of a .exr are read, and what has none or is cut off is refused") {
  const test::Folder folder;
  const auto read = [&](const std::string& bytes) {
    std::ofstream(folder.path() / "a.exr", std::ios::binary) << bytes;
    return read_exr(folder.path() / "a.exr");
  };
  const std::vector<float> depths{0.5f, 1.25f, std::numeric_limits<float>::infinity(), -3, 0, 7};
  std::string rows;
  for (const float depth : depths) rows += test::bytes_in(depth);
  for (const char* channel : {"Z", "depth.Z", "Y"}) {
    const Pfm read_depths = read(test::exr_of(3, 2, channel, rows));
    CHECK(read_depths.width == 3);
    CHECK(read_depths.height == 2);
    CHECK(read_depths.values == depths);
  }
  const std::string whole = test::exr_of(3, 2, "Z", rows);
  for (std::size_t length = 0; length < whole.size(); length += 7)
    CHECK_THROWS_AS(read(whole.substr(0, length)), InputError);
  std::string large = whole;
  large.replace(large.find("box2i") + 6 + 4 + 8, 8, test::bytes_in(std::int64_t{0x7fffffff7fffffff}));
  CHECK_THROWS_AS(read(large), InputError);
}
