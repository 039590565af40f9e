#include "algorithms/scan_line/coverage.hpp"

#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::scan_line {

using formulas::PixelShare;

namespace {

// A row spans y - 0.5 … y + 0.5; its lines lie in the middle of its quarters.
constexpr double line_of(double y) { return lines_in_a_row * (y + 0.5) - 0.5; }
constexpr double y_of(std::int32_t line) { return (line + 0.5) / lines_in_a_row - 0.5; }

constexpr double nothing = 1e-9;  // a share that is only rounding

}  // namespace

Coverage::Coverage(const pieces::Pieces& polygons, const Raster& raster)
    : width_(raster.width), shares_(static_cast<std::size_t>(raster.width)) {
  tables_.polygons = polygons;
  viewing::Vertices vertices = polygons.vertices;
  for (viewing::Vertex& vertex : vertices) vertex.raster.y = line_of(vertex.raster.y);
  NullRecorder nothing_recorded;
  fill_edge_table(tables_, vertices, {raster.width, raster.height * lines_in_a_row, false},
                  Conventions::Coverage::top_left, nothing_recorded);
}

void Coverage::add(std::int32_t polygon, double x_left, double x_right) {
  const auto first = floor_int(x_left + 0.5);
  for (std::int32_t x = std::max(0, first); x < width_ && x - 0.5 < x_right; ++x) {
    const double area = (std::min(x_right, x + 0.5) - std::max(x_left, x - 0.5)) / lines_in_a_row;
    std::vector<PixelShare>& shares = shares_[x];
    const auto known =
        std::find_if(shares.begin(), shares.end(), [&](const PixelShare& s) { return s.polygon == polygon; });
    if (known != shares.end()) known->share += area;
    else shares.push_back({polygon, area});
  }
}

template <Recorder R>
void Coverage::mix_row(const Scene& scene, std::int32_t y, Picture& picture, R& record) {
  for (std::vector<PixelShare>& shares : shares_) shares.clear();
  NullRecorder nothing_recorded;
  for (std::int32_t line = y * lines_in_a_row; line < (y + 1) * lines_in_a_row; ++line) {
    begin_scan_line(active_, tables_.edges, line, true, nothing_recorded);
    sweep(
        tables_, active_.edges, y_of(line), width_, Wanted::lengths, nullptr, nothing_recorded,
        [&](const Visible& part) { add(tables_.polygons[part.piece].polygon, part.where.x_left, part.where.x_right); });
  }

  for (std::int32_t x = 0; x < width_; ++x) {
    std::vector<PixelShare>& shares = shares_[x];
    const std::size_t pixel = picture.at(x, y);
    std::erase_if(shares, [](const PixelShare& share) { return share.share < nothing; });
    double uncovered = 1;
    for (const PixelShare& share : shares) uncovered -= share.share;
    if (uncovered > nothing) shares.push_back({no_polygon, uncovered});
    if (shares.size() == 1 && shares[0].polygon == picture.polygon[pixel]) continue;

    for (const PixelShare& share : shares) record(step::cover, CoverageAdd{x, y, share.polygon, share.share});
    const Color color = formulas::mixed(scene, shares);
    record(step::mix, ColorWrite{x, y, color.red, color.green, color.blue});
    picture.ink[pixel] = ink_of(color);
  }
}

#define INSTANTIATE(R) template void Coverage::mix_row<R>(const Scene&, std::int32_t, Picture&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::scan_line
