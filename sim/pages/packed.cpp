#include "sim/pages/packed.hpp"

#include <algorithm>
#include <new>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "sim/words/escaped.hpp"
#include "traces/scene.hpp"

namespace zstep {
namespace {

constexpr std::string_view unsafe{"\0\r<", 3};
constexpr unsigned first_pair = 256;  // of the letters that stand for fourteen bits: beyond ASCII and the controls

/// What is to become letters, seven bits at a time.
class Letters {
 public:
  explicit Letters(std::size_t bytes) { text_.reserve(bytes / 7 * 8 + 16); }

  void put(unsigned group) {
    if (waiting_ != none) {
      const unsigned letter = first_pair + waiting_ * 128 + group;
      text_.push_back(static_cast<char>(0xc0 | letter >> 6));
      text_.push_back(static_cast<char>(0x80 | (letter & 0x3f)));
      waiting_ = none;
    } else if (const std::size_t which = unsafe.find(static_cast<char>(group)); which != unsafe.npos) {
      waiting_ = static_cast<unsigned>(which);
    } else {
      text_.push_back(static_cast<char>(group));
    }
  }
  std::string take() {
    if (waiting_ != none) put(0);  // stands for no whole byte
    return std::move(text_);
  }

 private:
  static constexpr unsigned none = 3;
  unsigned waiting_ = none;  ///< which unsafe group the next one goes with
  std::string text_;
};

}  // namespace

std::vector<std::uint8_t> gzip(std::span<const std::uint8_t> bytes, const std::function<void(double)>& on_part) {
  constexpr std::size_t part = std::size_t{1} << 20;
  constexpr int gzip_window = 15 + 16;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  struct End {
    z_stream& stream;
    ~End() { deflateEnd(&stream); }
  } const end{stream};
  std::vector<std::uint8_t> out, room(part);
  std::size_t at = 0;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    const std::size_t count = std::min(part, bytes.size() - at);
    stream.next_in = const_cast<Bytef*>(bytes.data() + at);  // zlib only reads there
    stream.avail_in = static_cast<uInt>(count);
    at += count;
    do {
      stream.next_out = room.data();
      stream.avail_out = static_cast<uInt>(room.size());
      state = deflate(&stream, at == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
      out.insert(out.end(), room.begin(), room.end() - stream.avail_out);
    } while (stream.avail_out == 0);
    if (on_part) on_part(bytes.empty() ? 1 : ratio(at, bytes.size()));
  }
  return out;
}

std::string seven_bits(std::span<const std::uint8_t> bytes) {
  Letters letters(bytes.size());
  unsigned held = 0, bits = 0;
  for (const std::uint8_t byte : bytes) {
    held = held << 8 | byte;
    for (bits += 8; bits >= 7;) {
      bits -= 7;
      letters.put(held >> bits & 127);
    }
    held &= (1u << bits) - 1;
  }
  if (bits > 0) letters.put(held << (7 - bits) & 127);
  return letters.take();
}

std::string packed_element(const std::string& name, std::span<const std::uint8_t> gzipped) {
  return fmt::format("<script type=\"application/gzip\" data-name=\"{}\" data-bytes=\"{}\">{}</script>\n", markup(name),
                     gzipped.size(), seven_bits(gzipped));
}

}  // namespace zstep
