// Wavefront OBJ, as in appendix B1 of the Advanced Visualizer manual (Wavefront Technologies, 1989–1995), polygons
// only.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::scene {

namespace {

struct Look {
  std::optional<Color> color;
  Material material;
  bool opacity_known = false;  ///< d said it
  std::string invisible_at;    ///< the place of a Tr that hides it
};
using Looks = std::map<std::string, Look, std::less<>>;

constexpr std::array<std::string_view, 22> passed_over{
    "vp",         "g",         "o",   "s",    "mg",   "bevel",  "c_interp", "d_interp", "lod",  "maplib", "usemap",
    "shadow_obj", "trace_obj", "deg", "bmat", "step", "cstype", "ctech",    "stech",    "call", "csh",    "con"};

template <std::size_t N>
bool one_of(const std::array<std::string_view, N>& words, std::string_view word) {
  for (const std::string_view w : words)
    if (w == word) return true;
  return false;
}

/// A material file. A fault in it is a note, and what the statement would have set stays as it was.
class MaterialReader {
 public:
  MaterialReader(const MaterialFile& file, Looks& looks, PolygonSoup& soup)
      : file_(file.text, file.path, Tokens::Comments::hash, Tokens::Joining::backslash), looks_(looks), soup_(soup) {}

  void read() {
    do {
      const std::string_view word = file_.next_in_line();
      if (word == "newmtl") material();
      else if (look_ != nullptr && same_word(word, "map_kd")) texture();
      else if (is_texture(word)) soup_.losses.textures.add([&] { return file_.where(); });
      else if (look_ != nullptr && word == "Kd") color();
      else if (look_ != nullptr && (word == "d" || word == "Tr")) opacity(word);
      else if (look_ != nullptr && word == "Ni") refraction();
    } while (file_.next_line());
    if (faults_ == 1) soup_.notes.push_back(first_fault_ + "; this line is left out");
    if (faults_ > 1) soup_.notes.push_back(fmt::format("{}; {} such lines are left out", first_fault_, faults_));
  }

 private:
  void material() {
    const std::string_view name = file_.rest_of_line();
    look_ = name.empty() ? nullptr : &looks_[std::string(name)];
  }

  void color() {
    const std::string_view red = file_.next_in_line();
    const auto r = number(red, "red of Kd");
    const std::string_view green = file_.next_in_line();  // one number alone is a grey
    const auto g = green.empty() ? r : number(green, "green of Kd");
    const auto b = green.empty() ? r : number(file_.next_in_line(), "blue of Kd");
    if (r && g && b) look_->color = soup_.color_of(255.0 * glm::dvec3(*r, *g, *b), [&] { return file_.where(); });
  }

  /// Options stand before the name, which may hold blanks.
  void texture() {
    std::string_view name = file_.rest_of_line();
    if (name.starts_with('-')) name = name.substr(std::min(name.size(), name.find_last_of(" \t") + 1));
    if (!name.empty()) look_->material.texture = soup_.texture(name, file_.where());
  }

  void opacity(std::string_view word) {
    std::string_view token = file_.next_in_line();
    if (token == "-halo") token = file_.next_in_line();
    const auto written = number(token, word);
    if (!written) return;
    const bool transparency = word == "Tr";
    if (transparency && look_->opacity_known) return;  // programs differ in what Tr means, but not in d
    const double value = std::fmin(1, std::fmax(0, *written));
    look_->material.opacity = transparency ? 1 - value : value;
    look_->opacity_known = !transparency;
    look_->invisible_at = transparency && value == 1 ? file_.where() : "";
  }

  void refraction() {
    const auto value = number(file_.next_in_line(), "Ni");  // programs write 0 for "not set"
    if (value) look_->material.refraction = *value >= least_refraction && *value <= most_refraction ? *value : 1;
  }

  std::optional<double> number(std::string_view token, std::string_view what) {
    const auto value = parse_number(token);
    if (value && std::isfinite(*value)) return value;
    if (faults_++ > 0) return std::nullopt;
    try {
      file_.coordinate(token, what);
    } catch (const InputError& error) {
      first_fault_ = error.what();
    }
    return std::nullopt;
  }

  Tokens file_;
  Looks& looks_;
  PolygonSoup& soup_;
  Look* look_ = nullptr;
  std::int64_t faults_ = 0;
  std::string first_fault_;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name, const MaterialFiles& files)
      : file_(bytes, name, Tokens::Comments::hash, Tokens::Joining::backslash), files_(files) {}

  PolygonSoup read() {
    do {
      const std::string_view word = file_.next_in_line();
      if (word.empty()) continue;
      if (word == "v") vertex();
      else if (word == "vt") value(texture_);
      else if (word == "vn") value(normal_);
      else if (word == "f" || word == "fo") face();  // fo: an old spelling of f
      else if (word == "usemtl") material_ = std::string(file_.rest_of_line());
      else if (word == "mtllib") library();
      else if (word == "p" || word == "l") points_and_lines_.add([&] { return where(); });
      else if (word == "curv" || word == "curv2" || word == "surf") free_forms_.add([&] { return where(); });
      else if (!one_of(passed_over, word) && !one_of(free_form_, word)) unknown(word);
    } while (file_.next_line());
    check_forward_references();
    for (OfCorners* of : {&texture_, &normal_}) give_to_corners(*of);
    // Beside polygons they are left out; without any the file is another one than was meant.
    if (soup_.outlines.empty() && free_forms_.count > 0)
      throw InputError(free_forms_.where, "free-form curves and surfaces are not read", "export the mesh as polygons");
    if (soup_.outlines.empty() && unknown_.count > 0) refuse_unknown();
    note_left_out();
    return finish_soup(std::move(soup_), file_.name());
  }

 private:
  std::string where() const { return file_.where(); }

  void unknown(std::string_view word) {
    if (unknown_.count == 0) unknown_word_ = std::string(word);
    unknown_.add([&] { return where(); });
  }
  [[noreturn]] void refuse_unknown() const {
    const std::string small = lower_case(unknown_word_);
    throw InputError(
        unknown_.where, fmt::format("{} is no statement of an OBJ file", in_quotes(unknown_word_)),
        small == "v" || small == "f" ? "write statements in small letters" : "is this an OBJ file, and is it whole?");
  }

  void note_left_out() {
    soup_.note(points_and_lines_, "point or line (p, l) is", "points and lines (p, l) are", " not drawn");
    soup_.note(free_forms_, "free-form curve or surface (curv, curv2, surf) is",
               "free-form curves and surfaces (curv, curv2, surf) are", " left out");
    if (unknown_.count > 0)
      soup_.notes.push_back(fmt::format("{}: {} is no statement of an OBJ file; {} such line{} left out",
                                        unknown_.where, in_quotes(unknown_word_), unknown_.count,
                                        unknown_.count == 1 ? " was" : "s were"));
    PassedOver invisible;
    for (const auto& named : looks_)
      if (const Look& look = named.second; !look.invisible_at.empty()) invisible.add([&] { return look.invisible_at; });
    soup_.note(invisible, "material is", "materials are",
               " invisible by Tr 1 to methods that follow light; write d 1 where it should be opaque");
  }

  void vertex() {
    glm::dvec3 point;
    point.x = file_.coordinate_or_nan(file_.next_in_line(), "x");
    const std::int32_t line = file_.line();
    point.y = file_.coordinate_or_nan(file_.next_in_line(), "y");
    point.z = file_.coordinate_or_nan(file_.next_in_line(), "z");
    const std::vector<double> more = numbers();  // w or a colour, which do not move the point
    soup_.add_point(point, line, [&] { return where(); });
    if (more.size() < 3) return;
    if (VertexAttribute* colors = soup_.attribute(color_attribute, 3, [&] { return where(); }))
      soup_.add_value_of_point(*colors, more, line, [&] { return where(); });
  }

  /// What is left of the line; nan for what is no number.
  std::vector<double> numbers() {
    std::vector<double> all;
    for (std::string_view token = file_.next_in_line(); !token.empty(); token = file_.next_in_line())
      all.push_back(parse_number(token).value_or(std::nan("")));
    return all;
  }

  /// Values that corners name by their numbers: vt, vn.
  struct OfCorners {
    VertexAttribute attribute;
    std::vector<std::int64_t> named = {};  ///< by corner, from 0; no_value where it names none
  };
  void value(OfCorners& of) {
    const std::int32_t line = file_.line();
    const std::vector<double> all = numbers();
    soup_.add_value(of.attribute, all, line, [&] { return where(); });
    if (std::ssize(all) > of.attribute.components && all[of.attribute.components] != 0)
      soup_.losses.components.add([&] { return where(); });
  }
  /// The value that a corner names, in the part of its token behind so many slashes.
  void name_value(OfCorners& of, std::string_view token, int slashes) {
    for (; slashes > 0 && !token.empty(); --slashes)
      token = token.substr(std::min(token.size(), token.find('/') == token.npos ? token.size() : token.find('/') + 1));
    const std::string_view digits = token.substr(0, token.find('/'));
    std::int64_t number = no_value;
    const std::int64_t count = std::ssize(of.attribute.values) / of.attribute.components;
    if (!digits.empty()) {
      const auto index = parse_integer(digits).value_or(0);
      number = index > 0 ? index - 1 : index < 0 ? count + index : no_value;
      if (index == 0 || number < 0) number = no_value, soup_.losses.values.add([&] { return where(); });
    }
    of.named.push_back(number);
  }
  /// A face may stand before its values, too.
  void give_to_corners(OfCorners& of) {
    const std::int64_t count = std::ssize(of.attribute.values) / of.attribute.components;
    std::vector<std::int32_t> values;
    for (const std::int64_t number : of.named) {
      if (number >= count) soup_.losses.values.add([&] { return file_.name(); });
      values.push_back(number >= count ? no_value : static_cast<std::int32_t>(number));
    }
    soup_.give_to_corners(of.attribute, values);
    if (count > 0 && std::ssize(soup_.attributes) < most_attributes)
      soup_.attributes.push_back(std::move(of.attribute));
  }

  void face() {
    const std::int32_t line = file_.line();
    const std::int64_t count = soup_.points.size();
    bool is_first = true;
    for (std::string_view token = file_.next_in_line(); !token.empty(); token = file_.next_in_line()) {
      if (token.front() == '/' && !is_first) continue;  // of the corner before, behind a blank
      is_first = false;
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
      name_value(texture_, token, 1), name_value(normal_, token, 2);
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
    if (add_library(rest)) return;
    bool found = false;
    Tokens words(rest, file_.name(), Tokens::Comments::none);
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line())
      found = (word != rest && add_library(word)) || found;
    if (!found && soup_.notes.size() < 8)
      soup_.notes.push_back(fmt::format(
          "{}: the material file {} is not in the mesh's folder; its colours are not known", where(), in_quotes(rest)));
  }
  /// Whether there is one of this name; each is looked for and read once.
  bool add_library(std::string_view named) {
    if (named.size() > longest_name) return false;
    const auto [library, is_new] = libraries_.try_emplace(std::string(named), false);
    if (!is_new) return library->second;
    if (libraries_.size() > most_libraries) file_.fail("too many material files are named", "remove unused ones");
    if (library_bytes_ > most_library_bytes) file_.fail("the material files are too large", "remove unused ones");
    try {
      const auto file = files_(named);
      if (!file) return false;
      library_bytes_ += file->text.size();
      MaterialReader(*file, looks_, soup_).read();
    } catch (const InputError& error) {
      soup_.notes.push_back(fmt::format("{}; its colours are not known", error.what()));
    }
    return library->second = true;
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
  static constexpr std::size_t most_library_bytes = std::size_t{16} << 20, most_libraries = 256, longest_name = 1000;

  Tokens file_;
  const MaterialFiles& files_;
  PolygonSoup soup_;
  Looks looks_;
  OfCorners texture_{{uv_attribute, 2, {}, {}, {}, {}}}, normal_{{normal_attribute, 3, {}, {}, {}, {}}};
  std::string material_;
  std::int64_t furthest_ = 0;
  std::string furthest_where_;
  PassedOver points_and_lines_, free_forms_, unknown_;
  std::string unknown_word_;                            // the first
  std::map<std::string, bool, std::less<>> libraries_;  // by the names that were looked for: whether it was found
  std::size_t library_bytes_ = 0;
};

}  // namespace

PolygonSoup read_obj(std::string_view bytes, const std::string& name, const MaterialFiles& materials) {
  return Reader(bytes, name, materials).read();
}

}  // namespace zstep::scene
