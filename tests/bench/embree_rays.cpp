#include "tests/bench/embree_rays.hpp"

#include <stdexcept>

#include "algorithms/ray_casting/geometry.hpp"

namespace zstep::bench {

EmbreeRays::EmbreeRays(const Scene& scene)
    : scene_(scene), device_(rtcNewDevice("threads=1")), embree_(rtcNewScene(device_)) {
  std::vector<std::int32_t> corners;
  for (const Facet& facet : scene.facets) {
    const auto corner = [&](std::int32_t i) { return scene.corners[static_cast<std::size_t>(facet.first_corner + i)]; };
    for (std::int32_t i = 1; i + 1 < facet.corner_count; ++i) {
      corners.insert(corners.end(), {corner(0), corner(i), corner(i + 1)});
      polygons_.push_back(facet.polygon);
    }
  }
  RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), scene.points.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), polygons_.size()));
  if (!points || !indices) throw std::runtime_error("Embree gives no memory");
  for (const glm::dvec3& point : scene.points) {
    for (int axis = 0; axis < 3; ++axis) *points++ = static_cast<float>(point[axis]);
  }
  for (const std::int32_t corner : corners) *indices++ = static_cast<unsigned>(corner);
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(embree_, mesh);
  rtcReleaseGeometry(mesh);
  rtcSetSceneBuildQuality(embree_, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(embree_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree reports an error");
}

EmbreeRays::~EmbreeRays() {
  rtcReleaseScene(embree_);
  rtcReleaseDevice(device_);
}

void EmbreeRays::cast(Picture& picture) const {
  const ray_casting::EyeRays rays(scene_, Conventions::Depth::pseudodepth);
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const ray_casting::Ray ray = rays.through(x, y);
      RTCRayHit query;
      query.ray.org_x = static_cast<float>(ray.from.x), query.ray.dir_x = static_cast<float>(ray.along.x);
      query.ray.org_y = static_cast<float>(ray.from.y), query.ray.dir_y = static_cast<float>(ray.along.y);
      query.ray.org_z = static_cast<float>(ray.from.z), query.ray.dir_z = static_cast<float>(ray.along.z);
      query.ray.tnear = static_cast<float>(ray.t_least), query.ray.tfar = static_cast<float>(ray.t_most);
      query.ray.time = 0, query.ray.mask = ~0u, query.ray.flags = 0;
      query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      test::intersect(embree_, query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      const std::size_t pixel = picture.at(x, y);
      picture.polygon[pixel] = polygons_[query.hit.primID];
      picture.depth[pixel] = rays.depth(static_cast<double>(query.ray.tfar));
    }
  }
}

std::string embree_name() {
  RTCDevice device = rtcNewDevice("threads=1");
  const auto number = [&](RTCDeviceProperty what) { return std::to_string(rtcGetDeviceProperty(device, what)); };
  const std::string name = "Embree " + number(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." +
                           number(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." + number(RTC_DEVICE_PROPERTY_VERSION_PATCH);
  rtcReleaseDevice(device);
  return name;
}

}  // namespace zstep::bench
