#include "traces/codec/foretell.hpp"

namespace zstep::codec {

void Foreteller::forget() {
  whole_.fill(0);
  real_.fill(0);
  facing_ = Facing::front;
  keeps_all_ = false;
  begin_polygon({});
  last_inserted_ = -1;
  divider_ = {};
  planes_in_world_ = false;
  held_ = -1;
  sides_ = 0;
  cuts_.clear();
  extents_.clear(), followers_.clear();
  pair_ = {-1, -1};
  next_axis_ = Axis::x;
  areas_.clear();
  painted_ = -1;
  sweep_.clear();
  begin_depths(false, {}, 0);
  ray_from_ = ray_along_ = glm::dvec3(0);
}

}  // namespace zstep::codec
