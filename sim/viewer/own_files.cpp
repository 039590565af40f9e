#include "sim/viewer/own_files.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "algorithms/scene/files/read_mesh.hpp"
#include "sim/viewer/commands.hpp"

namespace zstep::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 40, most_looked_at = 5000;

bool can_be_opened(const fs::path& file) {
  constexpr std::array<std::string_view, 5> others{".toml", ".ztrace", ".jsonl", ".md", ".ini"};
  return scene::mesh_format(file) || std::find(others.begin(), others.end(), file.extension().string()) != others.end();
}

bool is_path(const std::string& typed) { return typed.find_first_of("/\\") != std::string::npos || typed[0] == '~'; }

/// With the reader's own folder for "~".
fs::path path_of(const std::string& typed) {
  const char* const home = std::getenv("HOME");
  if (typed[0] == '~' && home && *home && (typed.size() == 1 || typed[1] == '/'))
    return fs::path(home) / (typed.size() > 2 ? typed.substr(2) : "");
  return typed;
}

std::vector<Offer> in_folder(const std::string& typed) {
  std::vector<Offer> folders, files;
  if (typed.empty()) return files;
  const fs::path path = path_of(typed), folder = path.parent_path();
  const std::string begin = lower(path.filename().string());
  std::error_code error;
  const std::string where = "In " + fs::absolute(folder.empty() ? "." : folder, error).lexically_normal().string();
  std::size_t looked_at = 0;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (++looked_at > most_looked_at) break;
    const std::string name = entry->path().filename().string();
    if (!lower(name).starts_with(begin) || (name[0] == '.' && !begin.starts_with('.'))) continue;
    std::error_code of_entry;
    const std::string whole = (folder / name).string();
    if (entry->is_directory(of_entry)) {
      if (is_path(typed))
        folders.push_back({Offer::What::scene, whole + "/", name + "/", "Enter shows what is in it."});
    } else if (can_be_opened(name)) {
      files.push_back({Offer::What::scene, whole, name, whole});
    }
  }
  for (std::vector<Offer>* part : {&folders, &files})
    std::sort(part->begin(), part->end(), [](const Offer& a, const Offer& b) { return a.title < b.title; });
  folders.insert(folders.end(), std::make_move_iterator(files.begin()), std::make_move_iterator(files.end()));
  if (folders.size() > most_listed) folders.resize(most_listed);
  for (Offer& offer : folders) offer.theme = where;
  return folders;
}

}  // namespace

bool is_folder(const Offer& offer) { return offer.what == Offer::What::scene && offer.id.ends_with('/'); }

void OwnFiles::look_for(const std::vector<std::string>& opened_before) {
  before_.clear(), listed_.clear(), listed_for_.clear();
  for (auto path = opened_before.rbegin(); path != opened_before.rend(); ++path)
    if (std::error_code error; fs::is_regular_file(*path, error))
      before_.push_back(
          {Offer::What::scene, *path, fs::path(*path).filename().string(), *path, 0, 0, {}, "Your files"});
}

std::vector<const Offer*> OwnFiles::find(const std::string& typed) {
  if (std::exchange(listed_for_, typed) != typed) {
    listed_ = in_folder(typed);
    const bool named = std::any_of(listed_.begin(), listed_.end(), [&](const Offer& one) { return one.id == typed; });
    if (typed.find_first_of("/.=\\") != std::string::npos && !named)
      listed_.push_back({Offer::What::scene, typed, "Open " + typed,
                         "A mesh, a scene, a trace, a program's JSON Lines, or a surface by its formula."});
  }
  std::vector<const Offer*> found;
  for (const Offer& offer : before_)
    if (lower(offer.id).find(lower(typed)) != std::string::npos) found.push_back(&offer);
  for (const Offer& offer : listed_) found.push_back(&offer);
  return found;
}

}  // namespace zstep::viewer
