
#include "algorithms/scan_line/scan_line.hpp"

#include <algorithm>
#include <optional>

#include "algorithms/scan_conversion/spans.hpp"
#include "algorithms/scan_line/coverage.hpp"
#include "algorithms/scan_line/front.hpp"
#include "traces/error.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::scan_line {

namespace {

using scan_conversion::begin_scan_line;

bool resolves(const Conventions& conventions, Resolve how) {
  return choice_of<Resolve>(options, conventions, "resolve") == how;
}

Conventions standard_for_planes(Conventions conventions) {
  const Conventions standard;
  conventions.depth = standard.depth;
  conventions.interpolation = standard.interpolation;
  conventions.coverage = standard.coverage;
  return conventions;
}

template <Recorder R>
void paint(const pieces::Piece& polygon, const Visible& part, Picture& picture, R& record) {
  const auto row = static_cast<std::int32_t>(part.where.y);
  record(step::winner, SpanWinner{part.piece, part.where.first, part.where.last});
  for (std::int32_t x = part.where.first; x <= part.where.last; ++x) {
    const double z = polygon.plane.depth(x, row);
    picture.polygon[picture.at(x, row)] = polygon.polygon;
    picture.depth[picture.at(x, row)] = z;
    record(step::paint, PixelPaint{x, row, z, polygon.polygon});
  }
}

}  // namespace

void check(const Conventions& conventions, const std::string& who) {
  if (resolves(conventions, Resolve::planes)) {
    if (const std::string wanted = options_for_planes(conventions); !wanted.empty())
      throw InputError("--algorithm scan-line",
                       "compares planes: its depths are pseudodepths, directly computed at pixel centres",
                       "give " + wanted + ", or add --option resolve=line-buffer");
    return;
  }
  for (const char* option : {"coherence", "antialias"}) {
    if (is_on(options, conventions, option))
      throw InputError(who, std::string(option) + "=on needs the planes of the polygons, not a line buffer",
                       "leave out one of the two, or use resolve=planes");
  }
}

template <Recorder R>
Picture run(const Scene& scene, const Conventions& given, R& record) {
  const Raster& raster = scene.raster;
  const bool planes = resolves(given, Resolve::planes);
  const Conventions conventions = planes ? standard_for_planes(given) : given;
  const bool direct = conventions.interpolation == Conventions::Interpolation::direct;

  Picture picture(raster.width, raster.height);
  record(step::clear, BuffersClear{no_depth});

  Tables tables{pieces::gather(scene, conventions, record), {}, {}};
  fill_edge_table(tables, tables.polygons.vertices, raster, conventions.coverage, record);
  scan_conversion::ActiveEdges active;
  std::vector<double> line(raster.width);
  std::int32_t first_row = tables.edges.first_row, end_row = tables.edges.end_row;

  Coherence memory;
  Coherence* const coherence = is_on(options, conventions, "coherence") ? &memory : nullptr;
  std::optional<Coverage> coverage;
  if (planes && is_on(options, conventions, "antialias")) {
    picture.use_ink();
    coverage.emplace(tables.polygons, raster);
    const bool none = first_row >= end_row;
    first_row = none ? coverage->first_row() : std::min(first_row, coverage->first_row());
    end_row = std::max(end_row, coverage->end_row());
  }

  for (std::int32_t y = first_row; y < end_row; ++y) {
    begin_scan_line(active, tables.edges, y, direct, record);

    if (planes) {
      sweep(tables, active.edges, y, raster.width, Wanted::pixels, coherence, record,
            [&](const Visible& part) { paint(tables.polygons[part.piece], part, picture, record); });
    } else {
      draw_line(tables, active.edges, y, raster, conventions, line, picture, record);
    }
    if (coverage) coverage->mix_row(scene, y, picture, record);
  }
  end_polygon(active, record);
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

namespace {

template <Recorder R>
void fill_span(const scan_conversion::Span& span, std::int32_t polygon, bool direct, std::vector<double>& line,
               Picture& picture, R& record) {
  double z = 0;
  for (std::int32_t x = span.first, y = span.y; x <= span.last; ++x) {
    z = direct || x == span.first ? scan_conversion::depth_on(span, x) : z + span.dz_dx;
    record(step::interpolate_z, DepthInterpolate{x, y, z});

    double& stored = line[x];
    const bool is_nearer = z < stored;
    record(step::compare, DepthCompare{x, y, z, is_nearer});
    if (!is_nearer) continue;

    stored = z;
    picture.depth[picture.at(x, y)] = z;
    record(step::write_depth, DepthWrite{x, y, z});

    picture.polygon[picture.at(x, y)] = polygon;
    record(step::write_pixel, PixelWrite{x, y, polygon});
  }
}

}  // namespace

template <Recorder R>
void draw_line(const Tables& tables, const std::vector<std::int32_t>& active, std::int32_t y, const Raster& raster,
               const Conventions& conventions, std::vector<double>& line, Picture& picture, R& record) {
  const bool direct = conventions.interpolation == Conventions::Interpolation::direct;
  std::fill(line.begin(), line.end(), no_depth);

  std::vector<std::int32_t> edges = active;  // those of one polygon side by side, from left to right
  std::stable_sort(edges.begin(), edges.end(),
                   [&](std::int32_t one, std::int32_t other) { return tables.owner_of(one) < tables.owner_of(other); });
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {  // an even number each: inside between each pair
    const std::int32_t polygon = tables.polygons[tables.owner_of(edges[i])].polygon;
    const auto span =
        scan_conversion::begin_span(tables.edges, edges[i], edges[i + 1], y, raster, conventions.coverage, record);
    fill_span(span, polygon, direct, line, picture, record);
  }
}

#define INSTANTIATE(R)                                                                                     \
  template void draw_line<R>(const Tables&, const std::vector<std::int32_t>&, std::int32_t, const Raster&, \
                             const Conventions&, std::vector<double>&, Picture&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::scan_line
