#include "sim/viewer/draw/fonts.hpp"

#include <cmath>
#include <cstdlib>
#include <map>

namespace zstep::viewer {
namespace {

namespace fs = std::filesystem;

/// In order of liking. All have tabular digits.
const std::vector<std::string> text_files{"DejaVuSans.ttf",
                                          "NotoSans-Regular.ttf",
                                          "LiberationSans-Regular.ttf",
                                          "OpenSans-Regular.ttf",
                                          "Ubuntu-R.ttf",
                                          "FreeSans.ttf",
                                          "segoeui.ttf",
                                          "Arial.ttf",
                                          "arial.ttf",
                                          "Verdana.ttf"};
const std::vector<std::string> bold_files{"DejaVuSans-Bold.ttf", "NotoSans-Bold.ttf", "LiberationSans-Bold.ttf",
                                          "OpenSans-Bold.ttf",   "Ubuntu-B.ttf",      "FreeSansBold.ttf",
                                          "segoeuib.ttf",        "Arial Bold.ttf",    "arialbd.ttf"};
const std::vector<std::string> mono_files{"DejaVuSansMono.ttf",
                                          "NotoSansMono-Regular.ttf",
                                          "LiberationMono-Regular.ttf",
                                          "UbuntuMono-R.ttf",
                                          "FreeMono.ttf",
                                          "consola.ttf",
                                          "Menlo.ttc",
                                          "Courier New.ttf",
                                          "cour.ttf"};
/// For what the chosen one lacks.
const std::vector<std::string> symbol_files{
    "DejaVuSans.ttf", "NotoSansMath-Regular.ttf", "NotoSansSymbols2-Regular.ttf",
    "seguisym.ttf",   "Arial Unicode.ttf",        "Symbola.ttf"};

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

ImFont* add(const fs::path& path, const fs::path& symbols, float pixels) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.OversampleH = config.OversampleV = 1;
  config.PixelSnapH = true;
  ImFont* font = nullptr;
  if (!path.empty()) font = atlas->AddFontFromFileTTF(path.string().c_str(), pixels, &config, ranges);
  if (!font) {
    config.SizePixels = std::max(13.0f, pixels);
    font = atlas->AddFontDefault(&config);
  }
  if (!symbols.empty() && symbols != path) {
    config.MergeMode = true;
    atlas->AddFontFromFileTTF(symbols.string().c_str(), pixels, &config, ranges);
  }
  return font;
}

}  // namespace

fs::path find_font(const std::vector<std::string>& file_names) {
  for (const std::string& name : file_names)
    if (const auto found = installed().find(name); found != installed().end()) return found->second;
  return {};
}

void Fonts::load(float pixels) {
  ImGui::GetIO().Fonts->Clear();
  ImGui::GetIO().Fonts->Flags |= ImFontAtlasFlags_NoBakedLines;
  const fs::path text_path = find_font(text_files), bold_path = find_font(bold_files),
                 mono_path = find_font(mono_files);
  const fs::path symbols = find_font(symbol_files);
  text = add(text_path, symbols, std::round(pixels));
  bold = bold_path.empty() ? text : add(bold_path, symbols, std::round(pixels));
  heading = add(bold_path.empty() ? text_path : bold_path, symbols, std::round(pixels * 1.25f));
  mono = add(mono_path, symbols, std::round(pixels * 0.92f));
  small = add(mono_path, symbols, std::max(std::min(13.0f, std::round(pixels * 0.84f)), std::round(pixels * 0.76f)));
  ImGui::GetIO().Fonts->Build();

  lacking.clear();
  if (text_path.empty()) lacking = "No system font was found: install fonts-dejavu-core for readable text.";
  else if (mono_path.empty()) lacking = "No monospaced font was found: install fonts-dejavu-core for aligned numbers.";
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
