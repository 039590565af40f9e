// Wavefront OBJ, as in appendix B1 of the Advanced Visualizer manual (Wavefront Technologies, 1989–1995), polygons
// only.
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/error.hpp"
#include "traces/math/whole.hpp"

namespace zstep::scene {

namespace {

struct Look {
  std::optional<Color> color;
  Material material;
};
using Looks = std::map<std::string, Look, std::less<>>;

constexpr std::array<std::string_view, 24> passed_over{
    "vt",       "vn",       "vp",     "g",      "o",      "s",          "mg",        "bevel",
    "c_interp", "d_interp", "lod",    "maplib", "usemap", "shadow_obj", "trace_obj", "deg",
    "bmat",     "step",     "cstype", "ctech",  "stech",  "call",       "csh",       "con"};

template <std::size_t N>
bool one_of(const std::array<std::string_view, N>& words, std::string_view word) {
  for (const std::string_view w : words)
    if (w == word) return true;
  return false;
}

std::uint8_t channel(double value) { return nearest_byte(255 * std::fmin(1, std::fmax(0, value))); }

void read_materials(Tokens file, Looks& looks) {
  std::string current;
  do {
    const std::string_view word = file.next_in_line();
    if (word == "newmtl") {
      current = std::string(file.rest_of_line());
    } else if (word == "Kd" && !current.empty()) {
      const std::string_view red = file.next_in_line();
      if (red == "spectral" || red == "xyz") continue;  // colours of other kinds: the material has none for us
      const double r = file.coordinate(red, "red of Kd");
      const std::string_view green = file.next_in_line();  // one number alone is a grey
      const double g = green.empty() ? r : file.coordinate(green, "green of Kd");
      const double b = green.empty() ? r : file.coordinate(file.next_in_line(), "blue of Kd");
      looks[current].color = {channel(r), channel(g), channel(b)};
    } else if ((word == "d" || word == "Tr") && !current.empty()) {
      std::string_view token = file.next_in_line();
      if (token == "-halo") token = file.next_in_line();
      const double value = std::fmin(1, std::fmax(0, file.coordinate(token, word)));
      looks[current].material.opacity = word == "d" ? value : 1 - value;
    } else if (word == "Ni" && !current.empty()) {
      const double value = file.coordinate(file.next_in_line(), "Ni");  // programs write 0 for "not set"
      looks[current].material.refraction = value >= least_refraction && value <= most_refraction ? value : 1;
    }
  } while (file.next_line());
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name, const MaterialFiles& files)
      : file_(bytes, name, Tokens::Comments::hash, Tokens::Joining::backslash), files_(files) {}

  PolygonSoup read() {
    do {
      const std::string_view word = file_.next_in_line();
      if (word.empty()) continue;
      if (word == "v") vertex();
      else if (word == "f" || word == "fo") face();  // fo: an old spelling of f
      else if (word == "usemtl") material_ = std::string(file_.rest_of_line());
      else if (word == "mtllib") library();
      else if (word == "p" || word == "l") ++elements_passed_over_;
      else if (word == "curv" || word == "curv2" || word == "surf") free_forms_.add(word, file_);
      else if (!one_of(passed_over, word) && !one_of(free_form_, word)) unknown_.add(word, file_);
    } while (file_.next_line());
    check_forward_references();
    // Beside polygons they are left out; without any the file is another one than was meant.
    if (soup_.outlines.empty() && free_forms_.count > 0)
      throw InputError(free_forms_.where, "free-form curves and surfaces are not read", "export the mesh as polygons");
    if (soup_.outlines.empty() && unknown_.count > 0)
      throw InputError(unknown_.where, fmt::format("{} is no statement of an OBJ file", in_quotes(unknown_.word)),
                       "is this an OBJ file, and is it whole?");
    if (elements_passed_over_ > 0)
      soup_.notes.push_back(fmt::format("{} points and lines (p, l) are not drawn", elements_passed_over_));
    if (free_forms_.count > 0)
      soup_.notes.push_back(fmt::format("{}: {} free-form curves and surfaces (curv, curv2, surf) are left out",
                                        free_forms_.where, free_forms_.count));
    if (unknown_.count > 0)
      soup_.notes.push_back(fmt::format("{}: {} is no statement of an OBJ file; {} such line{} left out",
                                        unknown_.where, in_quotes(unknown_.word), unknown_.count,
                                        unknown_.count == 1 ? " was" : "s were"));
    return std::move(soup_);
  }

 private:
  /// Statements of one sort that are left out.
  struct LeftOut {
    std::int64_t count = 0;
    std::string word, where;  ///< of the first

    void add(std::string_view next, const Tokens& file) {
      if (count++ == 0) word = std::string(next), where = file.where();
    }
  };

  std::string where() const { return file_.where(); }

  void vertex() {
    glm::dvec3 point;
    point.x = file_.coordinate(file_.next_in_line(), "x");
    point.y = file_.coordinate(file_.next_in_line(), "y");
    point.z = file_.coordinate(file_.next_in_line(), "z");  // what may follow, w or a colour, does not move the point
    soup_.add_point(point, file_.line(), [&] { return where(); });
  }

  void face() {
    const std::int32_t line = file_.line();
    const std::int64_t count = soup_.points.size();
    for (std::string_view token = file_.next_in_line(); !token.empty(); token = file_.next_in_line()) {
      const std::string_view digits = token.substr(0, token.find('/'));
      const auto index = parse_integer(digits);
      if (!index)
        file_.fail(fmt::format("the corner {} is not an index", in_quotes(token)), "write i, i/t, i//n or i/t/n");
      if (*index == 0) file_.fail("a corner has the index 0", "indices count from 1");
      if (*index < -count)
        file_.fail(fmt::format("the index {} goes back beyond the first of {} vertices", *index, count),
                   "negative indices count back from the last vertex, which is -1");
      if (*index > most_points)
        file_.fail(fmt::format("there is no vertex {}", *index), "indices count from 1 to the number of vertices");
      if (*index > count && *index > furthest_) {
        furthest_ = *index;
        furthest_where_ = where();
      }
      soup_.add_corner(*index > 0 ? *index - 1 : count + *index, [&] { return where(); });
    }
    Look look;
    if (const auto found = looks_.find(material_); found != looks_.end()) look = found->second;
    soup_.close_outline(line, look.color, [&] { return where(); });
    if (look.material != Material{} || !soup_.materials.empty()) {
      soup_.materials.resize(soup_.outlines.size());
      soup_.materials.back() = look.material;
    }
  }

  void library() {
    // Names may hold blanks, and several names may stand in a line: first the whole, then the words.
    const std::string_view rest = file_.rest_of_line();
    if (add_library(std::string(rest))) return;
    bool found = false;
    Tokens words(rest, file_.name(), Tokens::Comments::none);
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line())
      found = (word != rest && add_library(std::string(word))) || found;
    if (!found && soup_.notes.size() < 8)
      soup_.notes.push_back(fmt::format(
          "{}: the material file {} is not in the mesh's folder; its colours are not known", where(), in_quotes(rest)));
  }
  bool add_library(const std::string& file_name) {
    if (library_bytes_ > most_library_bytes) file_.fail("the material files are too large", "remove unused ones");
    const auto text = files_(file_name);
    if (!text) return false;
    library_bytes_ += text->size();
    read_materials(Tokens(*text, sibling(file_name), Tokens::Comments::hash, Tokens::Joining::backslash), looks_);
    return true;
  }
  std::string sibling(const std::string& file_name) const {
    const std::size_t slash = file_.name().find_last_of("/\\");
    return slash == std::string::npos ? file_name : file_.name().substr(0, slash + 1) + file_name;
  }

  // A face may stand before its vertices, so positive indices are held against the count only at the end.
  void check_forward_references() const {
    const std::int64_t count = soup_.points.size();
    if (furthest_ > count)
      throw InputError(furthest_where_, fmt::format("there is no vertex {}: the file has {}", furthest_, count),
                       "correct the index, or get the file again if it was cut short");
  }

  static constexpr std::array<std::string_view, 10> free_form_{"parm", "trim", "hole", "scrv", "sp",
                                                               "end",  "res",  "bsp",  "bzp",  "cdc"};
  static constexpr std::size_t most_library_bytes = std::size_t{16} << 20;

  Tokens file_;
  const MaterialFiles& files_;
  PolygonSoup soup_;
  Looks looks_;
  std::string material_;
  std::int64_t furthest_ = 0;
  std::string furthest_where_;
  std::int64_t elements_passed_over_ = 0;
  LeftOut free_forms_, unknown_;
  std::size_t library_bytes_ = 0;
};

}  // namespace

PolygonSoup read_obj(std::string_view bytes, const std::string& name, const MaterialFiles& materials) {
  return Reader(bytes, name, materials).read();
}

}  // namespace zstep::scene
