#include "tests/embree/embree.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "algorithms/scene/builder.hpp"
#include "tests/embree/intersect.hpp"

namespace zstep::test {

namespace {

struct Device {
  RTCDevice handle = rtcNewDevice("threads=1");
  Device() {
    if (!handle) throw std::runtime_error("Embree gives no device");
  }
  ~Device() { rtcReleaseDevice(handle); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void check() const {
    if (rtcGetDeviceError(handle) != RTC_ERROR_NONE) throw std::runtime_error("Embree reports an error");
  }
};

struct Triangles {
  std::vector<std::int32_t> corners;   // three a triangle
  std::vector<std::int32_t> polygons;  // one a triangle
};

Triangles triangles_of(const Scene& scene) {
  Triangles all;
  scene::EarClipper clipper;
  for (const Facet& facet : scene.facets) {
    const auto corners =
        std::span(scene.corners)
            .subspan(static_cast<std::size_t>(facet.first_corner), static_cast<std::size_t>(facet.corner_count));
    if (!clipper.cut(scene.points, corners, all.corners)) throw std::runtime_error("too many corners");
    all.polygons.resize(all.corners.size() / 3, facet.polygon);
  }
  return all;
}

class World {
 public:
  // In view coordinates, where the eye is the origin and a ray's parameter can be z_v itself.
  World(const Device& device, const Scene& scene, const Triangles& triangles) : handle_(rtcNewScene(device.handle)) {
    rtcSetSceneFlags(handle_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry mesh = rtcNewGeometry(device.handle, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), scene.points.size()));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), triangles.polygons.size()));
    if (!points || !corners) throw std::runtime_error("Embree gives no memory");
    for (const glm::dvec3& point : scene.points) {
      const glm::dvec4 view = scene.camera.view * glm::dvec4(point, 1);
      for (int axis = 0; axis < 3; ++axis) *points++ = static_cast<float>(view[axis]);
    }
    for (const std::int32_t corner : triangles.corners) *corners++ = static_cast<unsigned>(corner);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(handle_, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(handle_);
    device.check();
  }
  ~World() { rtcReleaseScene(handle_); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // The triangle met first, -1 if there is none; `z` becomes its parameter on the ray.
  std::int64_t first_on(glm::dvec3 from, glm::dvec3 along, double near, double far, double& z) const {
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(from.x), ray.ray.org_y = static_cast<float>(from.y);
    ray.ray.org_z = static_cast<float>(from.z);
    ray.ray.dir_x = static_cast<float>(along.x), ray.ray.dir_y = static_cast<float>(along.y);
    ray.ray.dir_z = static_cast<float>(along.z);
    ray.ray.tnear = static_cast<float>(near), ray.ray.tfar = static_cast<float>(far);
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(handle_, ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return -1;
    z = static_cast<double>(ray.ray.tfar);
    return ray.hit.primID;
  }

 private:
  RTCScene handle_;
};

}  // namespace

Picture cast_with_embree(const Scene& scene) {
  const Camera& camera = scene.camera;
  const Raster& raster = scene.raster;
  const Device device;
  const Triangles triangles = triangles_of(scene);
  const World world(device, scene, triangles);

  Picture picture(raster.width, raster.height);
  const double half_y = camera.window, half_x = camera.window * raster.width / raster.height;
  const bool perspective = camera.kind == Camera::Kind::perspective;
  for (std::int32_t y = 0; y < raster.height; ++y) {
    for (std::int32_t x = 0; x < raster.width; ++x) {
      const double x_p = ((x + 0.5) / raster.width * 2 - 1) * half_x,
                   y_p = (1 - (y + 0.5) / raster.height * 2) * half_y;
      const glm::dvec3 from = perspective ? glm::dvec3(0) : glm::dvec3(x_p, y_p, 0);
      const glm::dvec3 along = perspective ? glm::dvec3(x_p / camera.d, y_p / camera.d, 1) : glm::dvec3(0, 0, 1);
      double z = 0;
      const std::int64_t triangle = world.first_on(from, along, camera.near, camera.far, z);
      if (triangle < 0) continue;
      picture.polygon[picture.at(x, y)] = triangles.polygons.at(static_cast<std::size_t>(triangle));
      picture.depth[picture.at(x, y)] = z;
    }
  }
  return picture;
}

std::string embree_version() {
  const Device device;
  const auto number = [&](RTCDeviceProperty what) { return std::to_string(rtcGetDeviceProperty(device.handle, what)); };
  return "Embree " + number(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + number(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." +
         number(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

}  // namespace zstep::test
