#include "tests/mesa/mesa.hpp"

#include <GL/osmesa.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

namespace zstep::test {

namespace {

using Context = std::unique_ptr<osmesa_context, decltype(&OSMesaDestroyContext)>;

struct Canvas {
  std::vector<std::uint8_t> rgba;
  Context context{nullptr, &OSMesaDestroyContext};

  Canvas(std::int32_t width, std::int32_t height)
      : rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4) {
    const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 32, 0};
    context.reset(OSMesaCreateContextAttribs(attributes, nullptr));
    if (!context || !OSMesaMakeCurrent(context.get(), rgba.data(), GL_UNSIGNED_BYTE, width, height)) {
      throw std::runtime_error("OSMesa gives no context");
    }
  }
};

// From view to OpenGL's clip coordinates, made from the camera's description alone and not with zstep's own code: a
// frustum (or a box) around z_v, with z_v = near at -1 and z_v = far at +1.
glm::dmat4 clip_matrix(const Camera& camera, const Raster& raster) {
  const double window_x = camera.window * raster.width / raster.height, window_y = camera.window;
  const double near = camera.near, far = camera.far;
  glm::dmat4 matrix(0.0);
  if (camera.kind == Camera::Kind::orthographic) {
    matrix[0][0] = 1 / window_x;
    matrix[1][1] = 1 / window_y;
    matrix[2][2] = 2 / (far - near);
    matrix[3][2] = -(far + near) / (far - near);
    matrix[3][3] = 1;
  } else {
    matrix[0][0] = camera.d / window_x;
    matrix[1][1] = camera.d / window_y;
    matrix[2][2] = (far + near) / (far - near);
    matrix[3][2] = -2 * far * near / (far - near);
    matrix[2][3] = 1;
  }
  return matrix;
}

void draw_facet(const Scene& scene, const Facet& facet) {
  const auto id = static_cast<std::uint32_t>(facet.polygon + 1);  // 0 is the background
  glColor3ub(static_cast<GLubyte>(id), static_cast<GLubyte>(id >> 8), static_cast<GLubyte>(id >> 16));
  glBegin(GL_POLYGON);
  for (std::int32_t i = 0; i < facet.corner_count; ++i) {
    const std::int32_t corner = scene.corners[static_cast<std::size_t>(facet.first_corner + i)];
    glVertex3dv(glm::value_ptr(scene.points[static_cast<std::size_t>(corner)]));
  }
  glEnd();
}

Picture read_buffers(const Canvas& canvas, std::int32_t width, std::int32_t height) {
  glFinish();
  Picture picture(width, height);
  std::vector<std::uint32_t> depth(picture.polygon.size());
  glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, depth.data());
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL reports an error");
  for (std::size_t pixel = 0; pixel < picture.polygon.size(); ++pixel) {
    const std::uint8_t* rgba = &canvas.rgba[pixel * 4];
    picture.polygon[pixel] = (rgba[0] | rgba[1] << 8 | rgba[2] << 16) - 1;
    if (picture.polygon[pixel] != no_polygon) picture.depth[pixel] = depth[pixel] / 4294967295.0;
  }
  return picture;
}

// z_v from OpenGL's depth, 0 … 1 for near … far.
double linearised(const Camera& camera, double depth) {
  const double near = camera.near, far = camera.far;
  if (camera.kind == Camera::Kind::orthographic) return near + depth * (far - near);
  return near * far / (far - depth * (far - near));
}

}  // namespace

namespace {

void set_up(const Scene& scene, bool cull) {
  glViewport(0, 0, scene.raster.width, scene.raster.height);
  const Camera& camera = scene.camera;
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(glm::value_ptr(camera.matrices ? camera.matrices->projection : clip_matrix(camera, scene.raster)));
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixd(glm::value_ptr(camera.matrices ? camera.matrices->view : camera.view));
  glDisable(GL_DITHER);
  glShadeModel(GL_FLAT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  if (cull) glEnable(GL_CULL_FACE);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void use(const Texture& texture, bool mixed) {
  std::vector<std::uint8_t> upwards;  // the lowest row first
  for (std::int32_t row = texture.height; row-- > 0;)
    for (std::int32_t column = 0; column < texture.width; ++column) {
      const Color& texel = texture.texels[pixel_at(column, row, texture.width)];
      upwards.insert(upwards.end(), {texel.red, texel.green, texel.blue});
    }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, texture.width, texture.height, 0, GL_RGB, GL_UNSIGNED_BYTE, upwards.data());
  for (const GLenum when : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, when, mixed ? GL_LINEAR : GL_NEAREST);
  for (const GLenum along : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) glTexParameteri(GL_TEXTURE_2D, along, GL_REPEAT);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glEnable(GL_TEXTURE_2D);
}

}  // namespace

std::vector<Color> colors_by_opengl(const Scene& scene, bool cull, const Texture* texture, bool mixed) {
  const std::int32_t width = scene.raster.width, height = scene.raster.height;
  Canvas canvas(width, height);
  set_up(scene, cull);
  if (texture != nullptr) use(*texture, mixed);
  glShadeModel(GL_SMOOTH);
  const VertexAttribute& attribute = *attribute_named(scene, texture != nullptr ? uv_attribute : color_attribute);
  for (const Facet& facet : scene.facets) {
    glBegin(GL_POLYGON);
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      const std::int32_t corner = scene.corners[static_cast<std::size_t>(facet.first_corner + i)];
      const std::int32_t value = attribute.value_of(facet.polygon, corner);
      const double* const numbers = attribute.values.data() + std::ptrdiff_t{value} * attribute.components;
      if (texture != nullptr) glTexCoord2dv(numbers);
      else glColor3dv(numbers);
      glVertex3dv(glm::value_ptr(scene.points[static_cast<std::size_t>(corner)]));
    }
    glEnd();
  }
  glFinish();
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL reports an error");
  std::vector<Color> colors;
  for (std::int32_t y = height; y-- > 0;)
    for (std::int32_t x = 0; x < width; ++x) {
      const std::uint8_t* rgba = &canvas.rgba[pixel_at(x, y, width) * 4];
      colors.push_back({rgba[0], rgba[1], rgba[2]});
    }
  return colors;
}

Picture drawn_by_opengl(const Scene& scene, bool cull, const OnFacet& on_facet) {
  Canvas canvas(scene.raster.width, scene.raster.height);
  set_up(scene, cull);
  for (std::size_t facet = 0; facet < scene.facets.size(); ++facet) {
    draw_facet(scene, scene.facets[facet]);
    if (on_facet)
      on_facet(static_cast<std::int32_t>(facet), read_buffers(canvas, scene.raster.width, scene.raster.height));
  }
  return read_buffers(canvas, scene.raster.width, scene.raster.height);
}

Picture draw_with_mesa(const Scene& scene, bool cull) {
  const Picture upwards = drawn_by_opengl(scene, cull);
  Picture picture(upwards.width, upwards.height);
  for (std::int32_t y = 0; y < picture.height; ++y)
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const std::size_t from = picture.at(x, picture.height - 1 - y), to = picture.at(x, y);
      picture.polygon[to] = upwards.polygon[from];
      if (picture.polygon[to] != no_polygon) picture.depth[to] = linearised(scene.camera, upwards.depth[from]);
    }
  return picture;
}

std::string mesa_version() {
  const Canvas canvas(4, 4);
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace zstep::test
