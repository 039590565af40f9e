// The plot of the slice: where depths and columns lie in it, its lines, dots and markers, and the names beside them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "sim/viewer/model/slice.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// Where depths and columns lie in the plot. Depths grow upwards; what is empty has a band of its own at its far end.
struct SlicePlot {
  int width = 0, height = 0;
  double x_first = 0, x_last = 1, low = 0, high = 1;
  float top = 0, bottom = 1, band = 0;  ///< band: the middle of the empty one
  bool view = false;                    ///< depths are z_v
  double unit = 0, least = 0;           ///< unit > 0: depths are shown as whole numbers of it, counted from `least`

  double column() const { return width / (x_last - x_first); }
  float x(double column_) const { return static_cast<float>((column_ - x_first) / (x_last - x_first) * width); }
  float y(double z) const { return bottom - static_cast<float>((z - low) / (high - low)) * (bottom - top); }
  /// The same for what the depth buffer holds.
  float y_stored(double z, double empty) const { return z == empty || !std::isfinite(z) ? band : y(z); }
  /// A depth as it is written: in units, or as it is.
  double shown(double z) const { return unit > 0 ? std::round((z - least) / unit * 1e6) / 1e6 : z; }
};

/// What is painted: one run's line, or two.
struct SlicePicture {
  std::vector<Slice> runs;
  SlicePlot plot;
};

/// In fixed point: as many columns and whole numbers around the step's depths as show single units. Not where the step
/// has no depth. `exact`: depths without rounding, of which those in its column are to be seen.
void see_units(SlicePlot& plot, Slice& slice, const Scene& scene, const Conventions& conventions,
               const std::vector<SliceSample>& exact);

/// The same in z_v, a span in short pieces: only pseudodepth is straight on the picture. Of the span at work nothing
/// but the ends where `ends_only`.
Slice in_view_depth(Slice slice, const Camera& camera, const Conventions& conventions, bool ends_only);

void take(Fingerprint& print, const SlicePicture& picture);
/// All but the markers.
void paint_slice(Canvas& canvas, const SlicePicture& picture, const Scene& scene, const Theme& c, const float& thin);

/// A depth that is held against another: filled where it wins, hollow where it does not.
struct SliceMarker {
  float x, y;
  int shape;  ///< as Canvas::mark has them
  std::optional<bool> wins;
  std::string text;
};

/// `run`: whose they are, where there are two ("A: ").
std::vector<SliceMarker> markers_of(Ui& ui, const SlicePlot& plot, const Slice& slice, const std::string& run);
void paint_markers(Ui& ui, Canvas& canvas, const std::vector<SliceMarker>& markers);

/// What the markers are, then each polygon's name at its line, as far as there is room. The plot is at `origin`.
void write_names(Ui& ui, const SlicePlot& plot, ImVec2 origin, const Slice& slice,
                 const std::vector<SliceMarker>& markers);

}  // namespace zstep::viewer
