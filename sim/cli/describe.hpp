// Scenes, cameras, conventions and events in words, for info and dump; and what a shell completes.
#pragma once

#include <string>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep::cli {

std::string camera_text(const Camera& camera);
std::string raster_text(const Raster& raster);
std::string written_text(const WrittenAs& written);
std::string depth_text(const Camera& camera, Conventions::Depth depth);
std::string interpolation_text(Conventions::Interpolation interpolation);
std::string coverage_text(Conventions::Coverage coverage, const Raster& raster);
std::string nearer_text(Comparison::Nearer nearer);
std::string ties_text(Comparison::Ties ties);
std::string numbers_text(const Conventions& conventions);

/// A field's value as a dump shows it; numbers with as many digits as distinguish them.
std::string value_text(double value);
/// "x=3 y=2 z=4.25 nearer=true"
std::string fields_text(const Event& event);

}  // namespace zstep::cli
