#include "algorithms/catalog/option.hpp"

#include <charconv>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "traces/error.hpp"

namespace zstep {

namespace {

const Option* find(std::span<const Option> table, std::string_view name) {
  for (const Option& option : table) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

const Option& known(std::span<const Option> table, std::string_view name) {
  const Option* option = find(table, name);
  if (option == nullptr) throw std::logic_error(fmt::format("the method has no option {}", name));
  return *option;
}

std::string_view value_of(const Option& option, const Conventions& conventions) {
  const auto given = conventions.options.find(std::string(option.name));
  return given == conventions.options.end() ? option.standard : std::string_view(given->second);
}

std::optional<std::size_t> place_among(std::string_view words, std::string_view value) {
  for (std::size_t place = 0;; ++place) {
    const std::size_t bar = words.find('|');
    if (words.substr(0, bar) == value) return place;
    if (bar == words.npos) return std::nullopt;
    words.remove_prefix(bar + 1);
  }
}

std::optional<std::int64_t> number_in(const Option& option, std::string_view value) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc{} || end != value.data() + value.size() || number < option.least || number > option.most)
    return std::nullopt;
  return number;
}

std::string values_text(const Option& option) {
  if (option.words.empty()) return fmt::format("a whole number from {} to {}", option.least, option.most);
  std::string text(option.words);
  for (std::size_t bar = text.find('|'); bar != text.npos; bar = text.find('|', bar)) text.replace(bar, 1, ", ");
  return "one of " + text;
}

}  // namespace

std::size_t choice(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  const Option& option = known(table, name);
  return place_among(option.words, value_of(option, conventions)).value();
}

std::int64_t whole_number(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  const Option& option = known(table, name);
  return number_in(option, value_of(option, conventions)).value();
}

void check_options(std::span<const Option> table, std::string_view method, const Conventions& conventions,
                   const std::string& who) {
  for (const auto& [name, value] : conventions.options) {
    const Option* option = find(table, name);
    if (option == nullptr) {
      std::string names;
      for (const Option& one : table) names += (names.empty() ? "" : ", ") + std::string(one.name);
      throw InputError(who, fmt::format("{} has no option '{}'", method, name),
                       names.empty() ? "it has none; leave it out" : "its options are: " + names);
    }
    const bool good =
        option->words.empty() ? number_in(*option, value).has_value() : place_among(option->words, value).has_value();
    if (!good)
      throw InputError(who, fmt::format("{} cannot be '{}'", name, value),
                       fmt::format("give {}", values_text(*option)));
  }
}

std::string options_for_planes(const Conventions& conventions) {
  const Conventions standard;
  std::string options;
  const auto want = [&](bool other, const char* option) {
    if (other) options += (options.empty() ? "" : " ") + std::string(option);
  };
  want(conventions.depth != standard.depth, "--depth pseudodepth");
  want(conventions.interpolation != standard.interpolation, "--interpolation direct");
  want(conventions.coverage != standard.coverage, "--coverage top-left");
  want(conventions.number_format != standard.number_format, "--number-format float64");
  want(conventions.positions != standard.positions, "--positions exact");
  want(conventions.attribute != standard.attribute, "--attribute none");
  return options;
}

}  // namespace zstep
