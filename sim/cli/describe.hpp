// Scenes, cameras, conventions and events in words, for info and dump.
#pragma once

#include <string>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep::cli {

std::string camera_text(const Camera& camera);
std::string raster_text(const Raster& raster);
std::string depth_text(const Camera& camera, Conventions::Depth depth);
std::string interpolation_text(Conventions::Interpolation interpolation);
std::string coverage_text(Conventions::Coverage coverage, const Raster& raster);
std::string nearer_text(Comparison::Nearer nearer);
std::string ties_text(Comparison::Ties ties);
std::string numbers_text(const Conventions& conventions);

/// A field's value as a dump shows it; numbers with as many digits as distinguish them.
std::string value_text(double value);
inline std::string value_text(std::int32_t value) { return std::to_string(value); }
inline std::string value_text(bool value) { return value ? "true" : "false"; }
template <class Enumeration>
  requires std::is_enum_v<Enumeration>
std::string value_text(Enumeration value) {
  return std::string(zstep::words_of<Enumeration>.at(static_cast<std::size_t>(value)));
}

/// "x=3 y=2 z=4.25 nearer=true"
template <class E>
std::string fields_text(const E& event) {
  std::string text;
  for_each_field<E>([&](const auto& field) {
    if (!text.empty()) text += ' ';
    text += field.name;
    text += '=';
    text += value_text(event.*field.member);
  });
  return text;
}

}  // namespace zstep::cli
