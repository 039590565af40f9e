#include "sim/words/link.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "sim/words/escaped.hpp"
#include "traces/conventions.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep {
namespace {

/// What a link can say, by its own word and by the command line's.
struct Part {
  std::string_view key, option;
  bool flag = false;
  std::string_view on = "on";  ///< a flag's value
};
constexpr std::array parts = {
    Part{"step", "--at"},
    Part{"pixel", "--pixel"},
    Part{"pane", "--lead"},
    Part{"race", "--race"},
    Part{"race-by", "--race-by"},
    Part{"presenter", "--presenter", true},
    Part{"embed", "--embed", true, "1"},
    Part{"change", "--change"},
    // Of a scene alone.
    Part{"method", "--algorithm"},
    Part{"option", "--option"},
    Part{"size", "--size"},
    Part{"no-cull", "--no-cull", true},
    Part{"rho", "--rho"},
    Part{"theta", "--theta"},
    Part{"phi", "--phi"},
    Part{"d", "--d"},
    Part{"window", "--window"},
    Part{"near", "--near"},
    Part{"far", "--far"},
    Part{"ortho", "--ortho", true},
    Part{"fit", "--fit", true},
};

/// Those of the table, and the conventions, which a link calls as the command line does.
std::vector<Part> all_parts() {
  static const std::vector<std::string> conventions = [] {
    std::vector<std::string> names;
    for_each_convention([&](std::string_view key, auto) {
      std::string option = "--" + std::string(key);
      std::replace(option.begin(), option.end(), '_', '-');
      names.push_back(option);
    });
    return names;
  }();
  std::vector<Part> all(parts.begin(), parts.end());
  for (const std::string& option : conventions) all.push_back({std::string_view(option).substr(2), option});
  return all;
}

std::string encoded(std::string_view text) {
  std::string out = percent_encoded(text, "-_.~,: ");
  std::replace(out.begin(), out.end(), ' ', '+');
  return out;
}

[[noreturn]] void wrong(std::string_view what, std::string_view mend) { throw InputError("link", what, mend); }

std::string decoded(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    char c = text[at] == '+' ? ' ' : text[at];
    if (c == '%') {
      unsigned code = 0;
      const char* from = text.data() + at + 1;
      const bool two = at + 2 < text.size() || at + 3 == text.size();
      if (!two || std::from_chars(from, from + 2, code, 16).ptr != from + 2)
        wrong(fmt::format("'{}' ends in half a sign", printable(text)), "copy the whole of it");
      c = static_cast<char>(code);
      at += 2;
    }
    if (byte_of(c) < ' ') wrong("it has a sign that is no letter in it", "copy it anew from the window");
    out.push_back(c);
  }
  return out;
}

/// A name of zstep's own, as "z-buffer" or "teapot:16": no path, no formula.
bool is_name(std::string_view text) {
  const std::string_view name = text.substr(0, text.find(':')),
                         number = text.substr(std::min(text.size(), name.size() + 1));
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto letter = [&](char c) { return (c >= 'a' && c <= 'z') || c == '-' || digit(c); };
  return !name.empty() && name.front() != '-' && name.size() < 64 && number.size() <= 2 &&
         (number.empty() ? name.size() == text.size() : true) && std::all_of(name.begin(), name.end(), letter) &&
         std::all_of(number.begin(), number.end(), digit);
}

void check_raster(const std::string& size) {
  std::int64_t width = 0, height = 0;
  const char* const end = size.data() + size.size();
  const auto [cross, fault] = std::from_chars(size.data(), end, width);
  const bool read = fault == std::errc() && cross != end && std::from_chars(cross + 1, end, height).ec == std::errc();
  if (read && width > 0 && height > 0 && width <= largest_raster && height <= largest_raster / width) return;
  wrong(fmt::format("size={} is no raster that a link may ask for", printable(size)),
        "write for example size=64x48, with at most 2097152 pixels");
}

/// What a key stands for, where the command line says it in another way.
std::optional<std::string> in_other_words(std::string_view key, const std::string& value) {
  if (key == "stop") return "--at=stop " + value;
  if (key != "theme") return std::nullopt;
  if (value == "dark" || value == "light") return "--" + value;
  wrong(fmt::format("theme={} is neither dark nor light", printable(value)), "write theme=dark or theme=light");
}

std::string word_of_part(std::string_view key, const std::string& value) {
  if (const auto word = in_other_words(key, value)) return *word;
  const std::vector<Part> all = all_parts();
  const auto part = std::find_if(all.begin(), all.end(), [&](const Part& one) { return one.key == key; });
  if (part == all.end()) {
    std::vector<std::string_view> known = {"lesson", "scene", "stop", "theme"};
    for (const Part& one : all) known.push_back(one.key);
    const std::string_view near = near_word(key, known);
    wrong(fmt::format("'{}' is nothing that a link says", printable(key)),
          near.empty() ? "it says lesson or scene, step or stop, pixel, pane, theme and what the run is made with"
                       : fmt::format("did you mean {}?", near));
  }
  if (key == "size") check_raster(value);
  if (!part->flag) return fmt::format("{}={}", part->option, value);
  if (value != part->on)
    wrong(fmt::format("{}={} is not {}", key, printable(value), part->on),
          fmt::format("write {}={}, or leave it out", key, part->on));
  return std::string(part->option);
}

}  // namespace

bool is_link(std::string_view word) {
  const auto begins = [&](std::string_view with) { return word.starts_with(with); };
  if (begins("#lesson=") || begins("#scene=") || begins("#embed=")) return true;
  if (!begins("http://") && !begins("https://") && !begins("file://")) return false;
  return word.find('#') != std::string_view::npos;
}

std::vector<std::string> words_of_link(std::string_view text) {
  if (text.size() > longest_link)
    wrong(fmt::format("it is {} bytes long, and at most {} are read", text.size(), longest_link),
          "open the scene as a file");
  text.remove_prefix(std::min(text.size(), text.find('#') + 1));
  std::vector<std::string> words = {"", ""}, options;
  bool stop = false, step = false;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    if (part.empty()) continue;
    const std::size_t equals = part.find('=');
    if (equals == part.npos) wrong(fmt::format("'{}' has no value", printable(part)), "write NAME=VALUE");
    const std::string_view key = part.substr(0, equals);
    const std::string value = decoded(part.substr(equals + 1));
    if (key == "lesson" || key == "scene") {
      if (!words[0].empty()) wrong("it names two things to open", "keep one lesson or one scene");
      if (!is_name(value))
        wrong(fmt::format("'{}' is not the name of a {}", printable(value), key),
              "a link opens what zstep has, and no files");
      words = {key == "lesson" ? "lesson" : "view", value};
      continue;
    }
    // A stop stands at a step; where both are named the step is what counts.
    if (key == "stop" && std::exchange(stop, true)) wrong("it names two stops", "keep one of them");
    if (key == "step" && std::exchange(step, true)) wrong("it names two steps", "keep one of them");
    std::string word = word_of_part(key, value);
    if (key == "step") std::erase_if(options, [](const std::string& one) { return one.starts_with("--at="); });
    if (key != "stop" || !step) options.push_back(std::move(word));
  }
  if (words[0].empty()) wrong("it does not say what to open", "it begins with #lesson=NAME or #scene=NAME");
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

std::optional<std::string> link_of(std::span<const std::string> words) {
  if (words.size() < 2 || (words[0] != "lesson" && words[0] != "view") || !is_name(words[1])) return std::nullopt;
  std::string link = fmt::format("#{}={}", words[0] == "lesson" ? "lesson" : "scene", words[1]);
  const std::vector<Part> all = all_parts();
  for (std::size_t k = 2; k < words.size(); ++k) {
    if (words[k] == "--dark" || words[k] == "--light") {
      link += "&theme=" + words[k].substr(2);
      continue;
    }
    const std::string option = words[k].substr(0, words[k].find('='));
    const auto part = std::find_if(all.begin(), all.end(), [&](const Part& one) { return one.option == option; });
    if (part == all.end()) return std::nullopt;
    std::string value(part->on);
    if (!part->flag) {
      if (option.size() < words[k].size()) value = words[k].substr(option.size() + 1);
      else if (++k < words.size()) value = words[k];
      else return std::nullopt;
    }
    const std::string_view stop = "stop ";
    if (part->key == "step" && value.starts_with(stop)) link += "&stop=" + encoded(value.substr(stop.size()));
    else link += fmt::format("&{}={}", part->key, encoded(value));
  }
  if (link.size() > longest_link) return std::nullopt;
  return link;
}

}  // namespace zstep
