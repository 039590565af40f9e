#include "sim/viewer/draw/fonts.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <utility>

namespace zstep::viewer {
namespace {

namespace fs = std::filesystem;

/// A file of letters. Dear ImGui scales one by the height of its line, which each face gives itself as it likes. With
/// how high a line is, and how far its baseline is from its top, in ems, the letters of all are as large.
struct Face {
  const char* file;
  float line = 1.164f, baseline = 0.928f;
};
constexpr Face usual{""};

/// In order of liking: made to be read on a screen, then what systems have.
const std::vector<Face> text_faces{{"Inter-Regular.otf", 1.21f, 0.969f},
                                   {"DejaVuSans.ttf"},
                                   {"NotoSans-Regular.ttf"},
                                   {"LiberationSans-Regular.ttf"},
                                   {"OpenSans-Regular.ttf", 1.362f, 1.069f},
                                   {"Ubuntu-R.ttf"},
                                   {"FreeSans.ttf"},
                                   {"segoeui.ttf"},
                                   {"Arial.ttf"},
                                   {"arial.ttf"},
                                   {"Verdana.ttf"}};
const std::vector<Face> bold_faces{{"Inter-SemiBold.otf", 1.21f, 0.969f},
                                   {"DejaVuSans-Bold.ttf"},
                                   {"NotoSans-Bold.ttf"},
                                   {"LiberationSans-Bold.ttf"},
                                   {"OpenSans-Bold.ttf", 1.362f, 1.069f},
                                   {"Ubuntu-B.ttf"},
                                   {"FreeSansBold.ttf"},
                                   {"segoeuib.ttf"},
                                   {"Arial Bold.ttf"},
                                   {"arialbd.ttf"}};
const std::vector<Face> mono_faces{{"DejaVuSansMono.ttf"},
                                   {"NotoSansMono-Regular.ttf"},
                                   {"LiberationMono-Regular.ttf"},
                                   {"UbuntuMono-R.ttf"},
                                   {"FreeMono.ttf"},
                                   {"consola.ttf"},
                                   {"Menlo.ttc"},
                                   {"Courier New.ttf"},
                                   {"cour.ttf"}};
/// Variables of formulas lean. Their small letters are as high as those beside them.
const std::vector<Face> variable_faces{{"STIXGeneral-Italic.otf", 1.87f, 1.308f}};
/// For what the chosen one lacks.
const std::vector<Face> symbol_faces{{"DejaVuSans.ttf"}, {"NotoSansMath-Regular.ttf"}, {"NotoSansSymbols2-Regular.ttf"},
                                     {"seguisym.ttf"},   {"Arial Unicode.ttf"},        {"Symbola.ttf"}};

/// Latin, Greek, punctuation, super- and subscripts, arrows, mathematics, a branch of a tree, geometric shapes, a
/// gear, check marks.
const ImWchar ranges[] = {0x0020, 0x00ff, 0x0370, 0x03ff, 0x2010, 0x2030, 0x2070, 0x209c, 0x2190,
                          0x21ff, 0x2200, 0x22ff, 0x2308, 0x230b, 0x2500, 0x2500, 0x2514, 0x2514,
                          0x25a0, 0x25ff, 0x2605, 0x2606, 0x2699, 0x2699, 0x2713, 0x2717, 0};

struct Substitute {
  ImWchar code;
  const char* utf8;
  const char* ascii;
};
const Substitute substitutes[] = {
    {0x2212, "\u2212", "-"},     {0x221e, "\u221e", "inf"},   {0x00b7, "\u00b7", "*"},        {0x00d7, "\u00d7", "x"},
    {0x2264, "\u2264", "<="},    {0x2265, "\u2265", ">="},    {0x2192, "\u2192", "->"},       {0x2190, "\u2190", "<-"},
    {0x2191, "\u2191", "^"},     {0x2193, "\u2193", "v"},     {0x25b6, "\u25b6", ">"},        {0x25c0, "\u25c0", "<"},
    {0x25b2, "\u25b2", "^"},     {0x25bc, "\u25bc", "v"},     {0x25cf, "\u25cf", "*"},        {0x25c6, "\u25c6", "*"},
    {0x2026, "\u2026", "..."},   {0x2013, "\u2013", "-"},     {0x2014, "\u2014", "-"},        {0x2019, "\u2019", "'"},
    {0x201c, "\u201c", "\""},    {0x201d, "\u201d", "\""},    {0x2022, "\u2022", "*"},        {0x2713, "\u2713", "ok"},
    {0x2717, "\u2717", "x"},     {0x03b8, "\u03b8", "theta"}, {0x03c6, "\u03c6", "phi"},      {0x03c1, "\u03c1", "rho"},
    {0x03b1, "\u03b1", "alpha"}, {0x0394, "\u0394", "D"},     {0x2080, "\u2080", "_0"},       {0x2081, "\u2081", "_1"},
    {0x2082, "\u2082", "_2"},    {0x2083, "\u2083", "_3"},    {0x2084, "\u2084", "_4"},       {0x2093, "\u2093", "_x"},
    {0x00b2, "\u00b2", "^2"},    {0x221a, "\u221a", "sqrt"},  {0x2208, "\u2208", "in"},       {0x2260, "\u2260", "!="},
    {0x00b0, "\u00b0", "deg"},   {0x00bd, "\u00bd", "1/2"},   {0x00a0, "\u00a0", " "},        {0x2032, "\u2032", "'"},
    {0x2308, "\u2308", "["},     {0x2309, "\u2309", "]"},     {0x230a, "\u230a", "["},        {0x230b, "\u230b", "]"},
    {0x2261, "\u2261", "="},     {0x25a0, "\u25a0", "#"},     {0x25a1, "\u25a1", "#"},        {0x21e4, "\u21e4", "|<"},
    {0x21e5, "\u21e5", ">|"},    {0x21b3, "\u21b3", ">"},     {0x2699, "\u2699", "Settings"}, {0x21c4, "\u21c4", "<>"},
    {0x2261, "\u2261", "="},     {0x2248, "\u2248", "~"},     {0x2514, "\u2514", "`"},        {0x2500, "\u2500", "-"},
};

std::vector<fs::path> font_folders() {
  if (const char* only = std::getenv("ZSTEP_FONTS")) return {only};
  std::vector<fs::path> folders;
  if (const char* home = std::getenv("HOME"))
    for (const char* folder : {".local/share/fonts", ".fonts", "Library/Fonts"})
      folders.push_back(fs::path(home) / folder);
  for (const char* folder :
       {"/usr/local/share/fonts", "/usr/share/fonts", "/Library/Fonts", "/System/Library/Fonts", "C:/Windows/Fonts"})
    folders.emplace_back(folder);
  return folders;
}

/// Every font file by name, found once. Some systems hold thousands of fonts: only names are kept.
const std::map<std::string, fs::path>& installed() {
  static const std::map<std::string, fs::path> found = [] {
    std::map<std::string, fs::path> files;
    std::error_code error;
    for (const fs::path& folder : font_folders())
      for (auto it = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
           !error && it != fs::recursive_directory_iterator(); it.increment(error))
        files.emplace(it->path().filename().string(), it->path());
    return files;
  }();
  return found;
}

struct Found {
  fs::path path;
  Face face = usual;
};
Found find_face(const std::vector<Face>& faces) {
  for (const Face& face : faces)
    if (const auto found = installed().find(face.file); found != installed().end()) return {found->second, face};
  return {};
}

/// Rows from the top of a line of this height to where its letters stand.
float baseline_of(const Face& face, float size) { return std::floor(face.baseline / face.line * size); }

ImFont* add(const Found& letters, const Found& symbols, float pixels) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.OversampleH = config.OversampleV = 1;
  config.PixelSnapH = true;
  // Whole pixels: Dear ImGui from 1.90 on cuts off what is beyond them.
  const float size = std::round(pixels / usual.line * letters.face.line);
  config.GlyphOffset.y = baseline_of(usual, pixels) - baseline_of(letters.face, size);
  ImFont* font = nullptr;
  if (!letters.path.empty()) font = atlas->AddFontFromFileTTF(letters.path.string().c_str(), size, &config, ranges);
  if (!font) {
    config.SizePixels = std::max(13.0f, pixels);
    font = atlas->AddFontDefault(&config);
  }
  if (!symbols.path.empty() && symbols.path != letters.path) {
    config.MergeMode = true;
    atlas->AddFontFromFileTTF(symbols.path.string().c_str(), pixels, &config, ranges);
  }
  return font;
}

/// All digits as wide as the widest, each in the middle of its room.
void make_tabular(ImFont& font) {
  float widest = 0;
  for (ImWchar digit = '0'; digit <= '9'; ++digit) widest = std::max(widest, font.GetCharAdvance(digit));
  for (ImFontGlyph& glyph : font.Glyphs) {
    if (glyph.Codepoint < '0' || glyph.Codepoint > '9') continue;
    const float moved = std::round((widest - glyph.AdvanceX) / 2);
    glyph.X0 += moved, glyph.X1 += moved;
    glyph.AdvanceX = widest;
  }
  font.BuildLookupTable();
}

}  // namespace

void Fonts::load(float pixels) {
  ImGui::GetIO().Fonts->Clear();
  ImGui::GetIO().Fonts->Flags |= ImFontAtlasFlags_NoBakedLines;
  const Found letters = find_face(text_faces), even = find_face(mono_faces), symbols = find_face(symbol_faces),
              leaning = find_face(variable_faces);
  Found thick = find_face(bold_faces);
  if (thick.path.empty()) thick = letters;
  std::vector<std::pair<ImFont*, float>> heights;
  const auto with = [&](const Found& found, float size) {
    ImFont* font = add(found, symbols, std::round(size));
    if (!found.path.empty()) heights.emplace_back(font, std::round(size));
    return font;
  };
  text = with(letters, pixels);
  bold = with(thick, pixels);
  heading = with(thick, pixels * 1.25f);
  variable = leaning.path.empty() ? text : with(leaning, pixels);
  mono = with(even, pixels * 0.92f);
  small = with(even, std::max(std::min(13.0f, std::round(pixels * 0.84f)), pixels * 0.76f));
  ImGui::GetIO().Fonts->Build();
  for (const auto& [font, height] : heights) font->FontSize = height;
  for (ImFont* font : {text, bold, heading}) make_tabular(*font);

  lacking.clear();
  if (letters.path.empty())
    lacking = "No system font was found: install fonts-inter and fonts-dejavu-core for readable text.";
  else if (even.path.empty()) lacking = "No monospaced font was found: install fonts-dejavu-core for aligned numbers.";
  replace_.clear();
  for (const Substitute& s : substitutes)
    for (const ImFont* font : {text, bold, heading, mono, small})
      if (!font->FindGlyphNoFallback(s.code)) {
        replace_.emplace_back(s.utf8, s.ascii);
        break;
      }
}

std::string Fonts::drawable(const std::string& given) const {
  if (replace_.empty()) return given;
  std::string out = given;
  for (const auto& [utf8, ascii] : replace_)
    for (std::size_t at = out.find(utf8); at != std::string::npos; at = out.find(utf8, at + ascii.size()))
      out.replace(at, utf8.size(), ascii);
  return out;
}

}  // namespace zstep::viewer
