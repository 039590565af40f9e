#include "sim/cli/run_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "traces/error.hpp"
#include "traces/file/written.hpp"

namespace zstep::cli {
namespace {

namespace fs = std::filesystem;

/// A word of a trace's header as the command line has it, and back: "top_left", "top-left".
std::string with_hyphens(std::string_view word) {
  std::string text(word);
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

/// What each convention means, by its key.
const std::map<std::string_view, const char*> convention_help{
    {"depth",
     "What the depth buffer holds: pseudodepth, linear on the picture (default); z_v, interpolated as it stands (view) "
     "or by way of 1/z_v (corrected); 1/z_v; or what is 1 at the near plane (reversed), or 0 there and -1 "
     "(foley) or 1 (zero-to-one) at the far one"},
    {"interpolation",
     "How x and z go along edges and spans: by the formula each time (default), by adding slopes, or z by the slopes "
     "of the polygon's plane, each time or added"},
    {"coverage",
     "Which pixels a polygon owns: centres inside, top-left rule (default), the textbook's x_L to x_R, or "
     "round(x_L) to round(x_R), or to one less (round-half-open), or ceil(x_L) to floor(x_R)"},
    {"number_format", "What is computed in (default float64); of fixed-point numbers, the bits of a depth"},
    {"rounding", "How fixed-point quotients become whole (default nearest)"},
    {"positions",
     "Where vertices are on the raster: as they come (default), at whole pixels, or at 256ths of one, as GPUs have "
     "them"},
    {"attribute",
     "How the attribute that shades polygons in stripes, x_w, goes over them: not at all (default), linearly on the "
     "picture, or by way of a/z_v and 1/z_v"},
};

/// What else a name of a library says, where no option says otherwise. OpenGL: its window coordinates and the depth
/// that its depth buffer has ("The OpenGL Graphics System", version 4.6 core, sections 13.8 and 14.6); Vulkan: its
/// framebuffer coordinates, and view coordinates as its tutorials have them (Vulkan 1.3, section 27.9); Direct3D: its
/// viewport ("Coordinate systems" and "Rasterization rules" of Direct3D 11). None of them drops back faces by itself
/// but Direct3D.
struct Like {
  std::string_view name;
  Conventions::Depth depth;
  bool y_up, cull;
  WrittenAs written;
  Conventions::Coverage coverage = Conventions::Coverage::top_left;
  bool corners = false;
  bool eye_at_d = false;  ///< depths are d^2/z_v - d
};
using Centre = WrittenAs::Centre;
using Axes = WrittenAs::Axes;
constexpr std::array likes{
    Like{"lecture", Conventions::Depth::pseudodepth, false, true, {}},
    Like{"opengl", Conventions::Depth::zero_to_one, true, false, {Centre::half, Axes::right_handed}},
    Like{"vulkan", Conventions::Depth::zero_to_one, false, false, {Centre::half, Axes::right_handed}},
    Like{"direct3d", Conventions::Depth::zero_to_one, false, true, {Centre::half, Axes::left_handed}},
    Like{"tinyrenderer",
         Conventions::Depth::reversed,
         true,
         true,
         {Centre::integer, Axes::right_handed},
         Conventions::Coverage::inclusive,
         true,
         true},
};

/// One of some words; the words are the help's type name too, and what a shell offers to complete. `take` gets the
/// place of the one that is given.
CLI::Option* add_choice(CLI::App& command, const std::string& name, const std::vector<std::string>& words,
                        const std::string& help, const std::function<void(std::size_t)>& take) {
  return command
      .add_option_function<std::string>(
          name, [=](const std::string& text) { take(parse_choice(name, text, words)); }, help)
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->group("Method");
}
/// The words of an enumeration, with hyphens.
template <class Enumeration>
std::vector<std::string> hyphenated() {
  std::vector<std::string> words;
  for (const std::string_view word : zstep::words_of<Enumeration>) words.push_back(with_hyphens(word));
  return words;
}

std::vector<std::string> method_ids() {
  std::vector<std::string> ids;
  for (const Method& m : methods()) ids.emplace_back(m.id);
  return ids;
}

/// What a program has whose clip coordinates are (x, y, z, 1 - z/d), z from the middle of the scene to an eye at d.
Camera::DepthRange range_from_d(const Camera& camera) {
  const double d = camera.d;
  return {d * d / camera.far - d, d * d / camera.near - d};
}

Camera::DepthRange parse_range(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto low = scene::parse_number(text.substr(0, comma)),
             high = comma == std::string::npos ? std::nullopt : scene::parse_number(text.substr(comma + 1));
  if (!low || !high || !Camera::DepthRange{*low, *high}.is_right())
    throw InputError("--depth-range " + text, "is not two numbers, the smaller one first", "as in --depth-range 0,1");
  return {*low, *high};
}

/// A name that is neither built in nor a file gets an answer that knows both.
void check_scene_exists(const std::string& name) {
  std::vector<std::string> known;
  for (const BuiltIn& scene : built_in_scenes()) known.emplace_back(scene.name);
  const std::string stem = name.substr(0, name.find(':'));
  for (const std::string& scene : known)
    if (scene == stem) return;
  if (names_formula(name)) return;
  std::error_code ignored;
  if (fs::exists(name, ignored)) {
    if (is_trace(name))
      throw InputError(name, "is a recorded trace, not a scene", fmt::format("to open it: zstep view {}", name));
    return;
  }
  throw InputError(name, "there is no such file and no built-in scene of this name",
                   did_you_mean(stem, known,
                                "'zstep list scenes' names the scenes, or give the path of a .toml, .obj, .off, .ply "
                                "or .stl, or a formula: \"y = sin(x)\""));
}

void add_method_options(CLI::App& command, RunOptions& options) {
  const auto take_algorithm = [&options](const std::string& id) {
    const std::vector<std::string> ids = method_ids();
    options.algorithm = ids.at(parse_choice("--algorithm", id, ids));
  };
  options.declared.push_back(
      command
          .add_option_function<std::string>("--algorithm", take_algorithm,
                                            "The method, one of 'zstep list methods' (default z-buffer)")
          ->type_name("METHOD")
          ->group("Method"));
  const auto take_option = [&options](const std::vector<std::string>& given) {
    for (const std::string& text : given) {
      const std::size_t equals = text.find('=');
      if (equals == 0 || equals == text.npos)
        throw InputError("--option " + text, "is not NAME=VALUE", "give for example --option boxes=on");
      const bool fresh = options.options.try_emplace(text.substr(0, equals), text.substr(equals + 1)).second;
      if (!fresh)
        throw InputError("--option " + text, "is the second value of " + text.substr(0, equals), "keep one of them");
    }
  };
  options.declared.push_back(
      command
          .add_option_function<std::vector<std::string>>(
              "--option", take_option,
              "An option of the method, as 'zstep list options' names them; may be given more than once")
          ->type_name("NAME=VALUE")
          ->allow_extra_args(false)
          ->take_all()
          ->group("Method"));
  const auto take_changes = [&options](const std::vector<std::string>& given) {
    for (const std::string& text : given) options.changes.push_back(read_change(text));
  };
  options.declared.push_back(
      command
          .add_option_function<std::vector<std::string>>(
              "--change", take_changes,
              "One thing other than it would be, as the viewer changes it (Ctrl+E): \"vertex 3 = 1 0 2\"; may be given "
              "more than once, and comes after all other options")
          ->type_name("\"NAME = VALUE\"")
          ->allow_extra_args(false)
          ->take_all()
          ->group("Method"));
}

}  // namespace

CLI::Option* add_number(CLI::App& command, const std::string& name, std::optional<double>& value,
                        const std::string& help) {
  const auto take = [name, &value](const std::string& text) { value = parse_number(name, text); };
  return command.add_option_function<std::string>(name, take, help)->type_name("NUMBER");
}

CLI::Option* add_whole(CLI::App& command, const std::string& name, std::optional<std::int64_t>& value,
                       std::int64_t least, const std::string& help) {
  const auto take = [name, least, &value](const std::string& text) { value = parse_whole(name, text, least); };
  return command.add_option_function<std::string>(name, take, help)->type_name("STEP");
}

std::string RunOptions::given() const {
  for (const CLI::Option* option : declared)
    if (option->count() > 0) return option->get_name();
  return "";
}

void add_scene(CLI::App& command, RunOptions& options) {
  command
      .add_option(
          "scene", options.scene,
          "A built-in scene's name, a .toml scene, a .obj, .off, .ply or .stl mesh, or a formula as \"y = sin(x)\"")
      ->type_name("SCENE|MESH")
      ->required();
}

void add_run_options(CLI::App& command, RunOptions& options, bool of_one_method) {
  std::vector<CLI::Option*>& all = options.declared;
  const auto in = [&](const std::string& group, CLI::Option* option) { all.push_back(option->group(group)); };
  ViewOptions& view = options.view;

  if (of_one_method) add_method_options(command, options);
  const auto take_size = [&view](const std::string& text) {
    const auto [width, height] = parse_size("--size", text);
    view.width = width;
    view.height = height;
  };
  in("Method", command
                   .add_option_function<std::string>("--size", take_size,
                                                     "Pixels of the raster, as 640x480 (default: the scene's)")
                   ->type_name("WxH"));
  in("Method", command.add_flag("--no-cull", options.no_cull, "Draw back faces too"));
  all.push_back(add_choice(command, "--y-axis", {"down", "up"},
                           "Where rows are counted to: down from the top (default), or up from the bottom, as OpenGL "
                           "has them",
                           [&view](std::size_t at) { view.y_up = at == 1; }));
  all.push_back(add_choice(command, "--seen-at", {"centres", "corners"},
                           "Where in a pixel the scene is sampled: at its centre (default), or at its first corner, as "
                           "many short rasterisers do",
                           [&view](std::size_t at) { view.corners = at == 1; }));
  std::vector<std::string> names;
  for (const Like& like : likes) names.emplace_back(like.name);
  all.push_back(add_choice(command, "--like", names,
                           "Whose conventions hold where no other option says otherwise: depth, rows, pixel centres, "
                           "view coordinates, back faces",
                           [&options](std::size_t at) { options.like = likes[at].name; }));
  for_each_convention([&]<class E>(const char* key, E Conventions::*) {
    all.push_back(
        add_choice(command, "--" + with_hyphens(key), hyphenated<E>(), convention_help.at(key),
                   [key, &options](std::size_t at) { options.conventions.words[key] = zstep::words_of<E>[at]; }));
  });

  in("Camera", add_number(command, "--rho", view.rho, "Distance of the eye from the origin"));
  in("Camera",
     add_number(command, "--theta", view.theta, "Angle of the eye around the z axis, from the x axis, in degrees"));
  in("Camera", add_number(command, "--phi", view.phi, "Angle of the eye from the z axis, in degrees"));
  in("Camera", add_number(command, "--d", view.d, "Distance of the projection plane from the eye"));
  in("Camera",
     add_number(command, "--window", view.window, "Half the height of the window on the projection plane (default 1)"));
  in("Camera",
     add_number(command, "--near", view.near, "z_v of the near clipping plane (default: from the scene's extent)"));
  in("Camera", command
                   .add_option_function<std::string>(
                       "--depth-range", [&view](const std::string& text) { view.depth_range = parse_range(text); },
                       "What depths of 0 and 1, of zero-to-one and reversed, are in the depth buffer (default 0,1)")
                   ->type_name("LOW,HIGH"));
  in("Camera",
     add_number(command, "--far", view.far, "z_v of the far clipping plane (default: from the scene's extent)"));
  const auto take_ortho = [&view](std::int64_t count) { view.orthographic = count > 0; };
  in("Camera", command.add_flag_function("--ortho", take_ortho, "Parallel projection instead of perspective"));
  in("Camera", command.add_flag("--fit", view.fit,
                                "Move the scene's centre to the origin and scale its farthest vertex to distance 1"));
}

void add_written_options(CLI::App& command, RunOptions& options) {
  const auto add = [&]<class E>(const std::string& name, E WrittenAs::*member, const char* help) {
    options.declared.push_back(
        add_choice(command, name, hyphenated<E>(), help, [name, member, &options](std::size_t at) {
          options.written.*member = zstep::values_of<E>[at];
          options.written_given.insert(name);
        }));
  };
  add("--pixel-centre", &WrittenAs::centre,
      "Where the program has the centre of pixel (x, y): at (x, y) (default), or at (x + 1/2, y + 1/2)");
  add("--view-coordinates", &WrittenAs::axes,
      "Its view coordinates: left-handed, z_v growing away from the eye (default), or right-handed, z_v negative "
      "before it");
}

namespace {
Run prepare_with(const RunOptions& options, bool notes) {
  check_scene_exists(options.scene);
  SceneFile file = load_scene(options.scene);
  if (notes)
    for (const std::string& note : file.notes) complain("note: " + note);
  ViewOptions view = options.view;
  const auto like = std::find_if(likes.begin(), likes.end(), [&](const Like& one) { return one.name == options.like; });
  const bool has_camera = file.scene.camera.kind != Camera::Kind::screen;
  if (like != likes.end() && !view.y_up) {
    if (like->y_up && file.scene.surface)
      throw InputError("--like " + options.like, "has rows that go up, and those of a surface's picture go down",
                       "give --y-axis down besides");
    view.y_up = like->y_up;
  }
  if (like != likes.end() && like->corners && has_camera && !view.corners) view.corners = true;
  Conventions asked = file.conventions;
  for (const auto& [name, value] : options.options) asked.options[name] = value;
  prepare_for_shade(file, asked);
  Run run{look_at_scene(std::move(file.scene), view), file.conventions, &method(options.algorithm), options.written};
  if (like != likes.end()) {
    if (has_camera) run.conventions.depth = like->depth;
    run.conventions.cull = like->cull;
    run.conventions.coverage = like->coverage;
    if (like->eye_at_d && !view.depth_range && run.scene.camera.kind == Camera::Kind::perspective)
      run.scene.camera.depth_range = range_from_d(run.scene.camera);
    if (!options.written_given.contains("--pixel-centre")) run.written.centre = like->written.centre;
    if (has_camera && !options.written_given.contains("--view-coordinates")) run.written.axes = like->written.axes;
  }
  options.conventions.apply(run.conventions);
  // Where back faces are drawn anyhow, as of a surface, it asks for what is so.
  if (options.no_cull && run.conventions.cull && !run.method->culls)
    throw InputError("--no-cull", fmt::format("means nothing to {}, which drops no back faces by it", run.method->id),
                     "leave it out");
  if (options.no_cull) run.conventions.cull = false;
  for (const auto& given : run.conventions.options)
    if (std::none_of(run.method->options.begin(), run.method->options.end(),
                     [&](const Option& option) { return option.name == given.first; }))
      throw InputError(options.scene,
                       fmt::format("its [options] ask for {} = {}, which {} does not have", given.first, given.second,
                                   run.method->id),
                       "take z-buffer or half-space, or take it out");
  for (const auto& [name, value] : options.options) run.conventions.options[name] = value;
  check_run(*run.method, run.scene, run.conventions);
  if (const std::string_view kind = kind_that_cannot_turn(header_of(run)); !kind.empty()) {
    if (!options.written_given.empty())
      throw InputError(*options.written_given.begin(),
                       fmt::format("is not written for {}, whose steps have planes or cuts on the raster ({})",
                                   run.method->id, kind),
                       "leave it out, or take z-buffer or half-space");
    run.written = {};
  }
  for (const Change& change : options.changes) make_change(*run.method, change, run.scene, run.conventions);
  return run;
}

}  // namespace

Header header_of(const Run& run) {
  Header header = header_for(*run.method, run.conventions, run.scene.camera.kind);
  header.written = run.written;
  if (run.conventions.options.contains(std::string(interpolation::initial_depth_option.name)))
    if (const double initial = interpolation::initial_depth(run.scene, run.conventions); std::isfinite(initial))
      header.initial_depth = initial;
  return header;
}

Run prepare(const RunOptions& options) { return prepare_with(options, true); }
Run prepare_again(const RunOptions& options) { return prepare_with(options, false); }

Run prepare_within_budget(const RunOptions& options) {
  const auto size_of = [](const std::string& path) -> std::uintmax_t {
    std::error_code none;
    const std::uintmax_t bytes = fs::file_size(path, none);
    return none ? 0 : bytes;
  };
  // A formula is a small file that can ask for much work: all its cells for each ray, say.
  const std::uintmax_t bytes = names_formula(options.scene) ? options.scene.size() : size_of(options.scene);
  if (bytes == 0) return begin_budget(std::nullopt), prepare(options);
  const std::int64_t pixels = std::int64_t{options.view.width.value_or(0)} * options.view.height.value_or(0);
  begin_budget(bytes + static_cast<std::uintmax_t>(pixels));
  Run run = prepare(options);
  std::uintmax_t meshes = 0;
  for (const auto& placement : run.scene.placements)
    if (placement.source != options.scene) meshes += size_of(placement.source);
  if (meshes > 0) begin_budget(meshes);
  return run;
}

}  // namespace zstep::cli
