// Header, camera, raster and conventions as JSON: the HEAD chunk of a trace and the first line of its JSONL form.
#pragma once

#include <nlohmann/json.hpp>

#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// What a JSON document says that cannot be. Readers turn it into an InputError that says where.
struct MalformedJson : std::runtime_error {
  using std::runtime_error::runtime_error;
};

nlohmann::ordered_json header_to_json(const Header& header);
/// Throws MalformedJson for anything missing, of the wrong type, or an event kind this zstep does not know.
Header header_from_json(const nlohmann::json& json);

nlohmann::ordered_json scene_to_json(const Scene& scene);
/// Throws MalformedJson; the scene it returns has been checked (check_scene).
Scene scene_from_json(const nlohmann::json& json);

nlohmann::ordered_json camera_to_json(const Camera& camera);
Camera camera_from_json(const nlohmann::json& json);
nlohmann::ordered_json raster_to_json(const Raster& raster);
Raster raster_from_json(const nlohmann::json& json);
nlohmann::ordered_json light_to_json(const Light& light);
Light light_from_json(const nlohmann::json& json);
nlohmann::ordered_json surface_to_json(const Surface& surface);
Surface surface_from_json(const nlohmann::json& json);
nlohmann::ordered_json fit_to_json(const Fit& fit);
Fit fit_from_json(const nlohmann::json& json);

/// Parses JSON that may be made to fill the machine: long texts only as deep as ours are. Throws MalformedJson for
/// that, nlohmann::json::exception for what is no JSON.
nlohmann::json parse_bounded(const std::string& text);

/// A double as JSON: a number, or "inf", "-inf", "nan", which JSON has no numbers for.
nlohmann::ordered_json real_to_json(double value);
double real_from_json(const nlohmann::json& json, const char* what);

/// Throws MalformedJson unless every index of the scene points into it, every size is one a raster can have, and
/// materials, light and surface are possible.
void check_scene(const Scene& scene);

}  // namespace zstep
