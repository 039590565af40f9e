#include "sim/homework/new_homework.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "sim/classroom/lesson.hpp"
#include "sim/homework/emitters.hpp"
#include "sim/homework/handout.hpp"
#include "sim/homework/step_fields.hpp"
#include "traces/error.hpp"
#include "traces/formulas/eye_rays.hpp"
#include "traces/near_word.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

/// The folders homework/METHOD of the first place that has any.
std::vector<fs::path> templates() {
  for (const fs::path& place : lesson_folders()) {
    std::vector<fs::path> found;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(place / "homework", none))
      if (fs::exists(entry.path() / "homework.toml", none)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    if (!found.empty()) return found;
  }
  return {};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw InputError(path.string(), "cannot be written", "check the folder and the room on the disk");
}

std::string rays_as_numbers(const Scene& scene) {
  const formulas::EyeRays rays(scene.camera, scene.raster);
  const auto first = rays.through(0, 0), right = rays.through(1, 0), down = rays.through(0, 1);
  std::string text;
  for (const glm::dvec3& v : {first.from, right.from - first.from, down.from - first.from, first.along,
                              right.along - first.along, down.along - first.along})
    text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
  const double unit = scene.camera.kind == Camera::Kind::orthographic ? 1 : scene.camera.d;
  return text + fmt::format("{} {}\n", scene.camera.near / unit, scene.camera.far / unit);
}

/// Rows of samples, and what takes them to the screen: T_v, d, half the height of the window, near and far.
std::string surface_as_numbers(const Scene& scene) {
  const Surface& surface = scene.surface.value();
  std::string text = fmt::format("{} {}\n", surface.rows, surface.columns);
  for (const glm::dvec3& p : scene.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  const Camera& camera = scene.camera;
  for (int row = 0; row < 3; ++row) {
    const auto t = [&](int column) { return camera.view[column][row]; };
    text += fmt::format("{} {} {} {}\n", t(0), t(1), t(2), t(3));
  }
  const double d = camera.kind == Camera::Kind::orthographic ? 0 : camera.d;
  return text + fmt::format("{} {} {} {}\n", d, camera.window, camera.near, camera.far);
}

std::string text_of_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::string plain_numbers(const Method& method, const Scene& scene) {
  std::string text = fmt::format("{} {}\n", scene.raster.width, scene.raster.height);
  if (method.needs == Needs::surface) return text + surface_as_numbers(scene);
  text += fmt::format("{}\n", scene.points.size());
  for (const glm::dvec3& p : scene.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  text += fmt::format("{}\n", scene.facets.size());
  for (const Facet& facet : scene.facets) {
    text += fmt::format("{}", facet.corner_count);
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      text += fmt::format(" {}", scene.corners[static_cast<std::size_t>(facet.first_corner + k)]);
    text += '\n';
  }
  const auto add = [&](Color color) { text += fmt::format("{} {} {}\n", color.red, color.green, color.blue); };
  add(scene.background);
  for (const Facet& facet : scene.facets) add(scene.polygons[static_cast<std::size_t>(facet.polygon)].color);
  if (scene.camera.kind != Camera::Kind::screen) text += rays_as_numbers(scene);
  return text;
}

std::vector<std::pair<fs::path, std::string>> made_files(const Homework& homework) {
  std::vector<std::pair<fs::path, std::string>> files;
  for (const Task& task : homework.tasks)
    if (!task.made)
      files.emplace_back(fs::path(task.scene.source).replace_extension(".txt"),
                         plain_numbers(*homework.method, task.scene));
  for (const char* place : {"starter", "solution"}) {
    if (!fs::is_directory(homework.folder / place)) continue;
    for (std::size_t k = 0; k < languages.size(); ++k)
      files.emplace_back(homework.folder / place / languages[k].file,
                         emitter(static_cast<Language>(k), homework.steps));
  }
  if (fs::is_directory(homework.folder / "starter"))
    files.emplace_back(homework.folder / "starter" / "run.schema.json", run_schema(homework.steps));
  if (const std::string words = text_of_file(homework.folder / "handout.md"); !words.empty())
    files.emplace_back(homework.folder / "handout.html", handout_html(homework, words));
  std::erase_if(files, [](const auto& file) { return text_of_file(file.first) == file.second; });
  return files;
}

std::vector<std::string> refresh_homework(const fs::path& folder) {
  std::vector<std::string> written;
  for (const auto& [path, text] : made_files(load_homework(folder))) {
    write(path, text);
    written.push_back(path.lexically_relative(folder).generic_string());
  }
  return written;
}

std::vector<std::string> homework_methods() {
  std::vector<std::string> names;
  for (const fs::path& folder : templates()) names.push_back(folder.filename().string());
  return names;
}

std::vector<std::string> new_homework(const std::string& method, const fs::path& folder) {
  const std::vector<fs::path> all = templates();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const fs::path& one) { return one.filename().string() == method; });
  if (found == all.end()) {
    const std::vector<std::string> names = homework_methods();
    const std::vector<std::string_view> words(names.begin(), names.end());
    throw InputError(method, "there is no homework of this method",
                     words.empty() ? "set ZSTEP_LESSONS to the folder of the lessons"
                                   : near_word_or_list(method, words, "there are"));
  }
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !(fs::is_directory(folder, ignored) && fs::is_empty(folder, ignored)))
    throw InputError(folder.string(), "is there already", "give the name of a new folder");
  const fs::path partial = (folder / "").parent_path().string() + ".part";
  if (fs::exists(partial, ignored))
    throw InputError(partial.string(), "is in the way: the folder is made under this name", "move it away");
  std::vector<std::string> written;
  try {
    fs::copy(*found, partial, fs::copy_options::recursive);
    if (fs::is_directory(partial / "class"))  // its programs differ, what makes them does not
      fs::copy(found->parent_path() / "make_class.py", partial / "class");
    refresh_homework(partial);
    fs::remove(folder, ignored);  // an empty one
    fs::rename(partial, folder);
  } catch (const fs::filesystem_error& error) {
    fs::remove_all(partial, ignored);
    throw InputError(folder.string(), "cannot be made: " + error.code().message(), "check the folder it lies in");
  } catch (...) {
    fs::remove_all(partial, ignored);
    throw;
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) written.push_back(fs::relative(entry.path(), folder).generic_string());
  std::sort(written.begin(), written.end());
  return written;
}

}  // namespace zstep::homework
