// Header, camera, raster and conventions as JSON: the HEAD chunk of a trace and the first line of its JSONL form.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// What a JSON document says that cannot be. Readers turn it into an InputError that says where.
struct MalformedJson : std::runtime_error {
  explicit MalformedJson(const std::string& what, std::string mend_ = "")
      : std::runtime_error(what), mend(std::move(mend_)) {}
  /// The same at a value of the document that is read, or at one of its members.
  MalformedJson(const nlohmann::json& at_, std::string key_, const std::string& what, std::string mend_ = "")
      : std::runtime_error(what), mend(std::move(mend_)), at(&at_), key(std::move(key_)) {}
  std::string mend;                    ///< how to mend it, if there is more to say than where the format is described
  const nlohmann::json* at = nullptr;  ///< lives as long as the document
  std::string key;
};

/// Several of them; it says what the first does.
struct MalformedParts : MalformedJson {
  explicit MalformedParts(std::vector<MalformedJson> all_) : MalformedJson(all_.front()), all(std::move(all_)) {}
  std::vector<MalformedJson> all;
};

nlohmann::ordered_json header_to_json(const Header& header);
/// Throws MalformedParts for anything missing, of the wrong type, or that this zstep does not know: nothing is passed
/// over.
/// `defaults`: what method and steps are where the header leaves them out; without them it may not.
Header header_from_json(const nlohmann::json& json, const Header* defaults = nullptr);

nlohmann::ordered_json scene_to_json(const Scene& scene);
/// Throws MalformedJson; the scene it returns has been checked (check_scene).
Scene scene_from_json(const nlohmann::json& json);

nlohmann::ordered_json camera_to_json(const Camera& camera);
Camera camera_from_json(const nlohmann::json& json, const Raster& raster);
nlohmann::ordered_json raster_to_json(const Raster& raster);
Raster raster_from_json(const nlohmann::json& json);
nlohmann::ordered_json light_to_json(const Light& light);
Light light_from_json(const nlohmann::json& json);
nlohmann::ordered_json surface_to_json(const Surface& surface);
Surface surface_from_json(const nlohmann::json& json);
nlohmann::ordered_json fit_to_json(const Fit& fit);
Fit fit_from_json(const nlohmann::json& json);
nlohmann::ordered_json textures_to_json(const std::vector<Texture>& textures);
std::vector<Texture> textures_from_json(const nlohmann::json& json);

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
