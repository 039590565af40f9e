#include "sim/cost/modes.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/interpolation/interpolation.hpp"
#include "traces/error.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/oracle/errors.hpp"

namespace zstep::compare {

namespace {

const Method& z_buffer_method() { return method("z-buffer"); }

Trace trace_of(const Scene& scene, const Conventions& conventions) {
  TraceRecorder recorder(header_for(z_buffer_method(), conventions), scene);
  z_buffer_method().record(scene, conventions, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), scene.name);
}

}  // namespace

std::vector<Mode> modes_of(const Scene& scene, const Conventions& conventions,
                           const std::vector<std::pair<std::string, std::vector<std::string>>>& words,
                           std::vector<std::string>& left_out) {
  std::vector<Mode> modes{{"", conventions}};
  for (const auto& [key, values] : words) {
    std::vector<Mode> finer;
    for (const Mode& mode : modes)
      for (const std::string& value : values) {
        Mode one = mode;
        ConventionChoices{{{key, value}}}.apply(one.conventions);
        std::string word = value;
        std::replace(word.begin(), word.end(), '_', '-');
        one.text += (one.text.empty() ? "" : ", ") + word;
        finer.push_back(std::move(one));
      }
    modes = std::move(finer);
  }
  std::erase_if(modes, [&](const Mode& mode) {
    try {
      check_run(z_buffer_method(), scene, mode.conventions);
      return false;
    } catch (const InputError& error) {
      left_out.push_back(mode.text + ": " + error.what());
      return true;
    }
  });
  return modes;
}

ModeErrors errors_of_mode(const Scene& scene, const Mode& mode) {
  const Trace trace = trace_of(scene, mode.conventions);
  const oracle::Errors from_formula = oracle::errors_of(trace),
                       from_surface = oracle::errors_of(trace, nullptr, oracle::Truth::surface);
  ModeErrors errors;
  errors.depths = from_surface.all.depths;
  errors.largest = from_surface.all.largest_view;
  errors.rms = from_surface.all.root_mean_square_view();
  errors.rounding = from_formula.all.largest;
  errors.wrong_pixels = from_surface.wrong_pixels;
  errors.fighting_pixels = from_formula.fighting_pixels;
  for (std::size_t pixel = 0; pixel < from_surface.fighting.size(); ++pixel)
    errors.bent_pixels += from_surface.fighting[pixel] && !from_formula.fighting[pixel];
  errors.least_gap = from_surface.least_gap;
  errors.gap_at = from_surface.gap_at;
  if (errors.least_gap) errors.unit_at_gap = formulas::resolution(scene, mode.conventions, errors.gap_at);
  errors.operations = operations_of(trace);
  const interpolation::Bounds bounds = interpolation::bounds_of(scene, mode.conventions);
  for (std::size_t pixel = 0; pixel < bounds.of_pixel.size(); ++pixel) {
    const double off = std::abs(from_formula.depth_error_of_pixel[pixel]);
    if (std::isnan(off)) continue;
    errors.bound = std::max(errors.bound, bounds.of_pixel[pixel]);
    errors.rounding_depth = std::max(errors.rounding_depth, off);
    if (off > bounds.of_pixel[pixel]) errors.within_bounds = false;
  }
  if (bounds.of_attribute.empty()) return errors;
  errors.attribute = oracle::attribute_errors_of(trace);
  errors.attribute_operations = attribute_operations_of(trace);
  for (std::size_t pixel = 0; pixel < bounds.of_attribute.size(); ++pixel) {
    const double off = errors.attribute.rounding_of_pixel[pixel];
    if (std::isnan(off)) continue;
    errors.attribute_bound = std::max(errors.attribute_bound, bounds.of_attribute[pixel]);
    if (off > bounds.of_attribute[pixel]) errors.attributes_within_bounds = false;
  }
  return errors;
}

}  // namespace zstep::compare
