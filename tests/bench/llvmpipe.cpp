#include "tests/bench/llvmpipe.hpp"

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
#include <GL/glext.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

namespace zstep::bench {

namespace {

struct GlVertex {
  float position[3];
  std::uint8_t color[4];
};

// From view to OpenGL's clip coordinates.
glm::dmat4 clip_matrix(const Camera& camera, const Raster& raster) {
  const double window_x = camera.window * raster.width / raster.height, near = camera.near, far = camera.far;
  glm::dmat4 matrix(0.0);
  matrix[0][0] = camera.d / window_x;
  matrix[1][1] = camera.d / camera.window;
  matrix[2][2] = (far + near) / (far - near);
  matrix[3][2] = -2 * far * near / (far - near);
  matrix[2][3] = 1;
  return matrix;
}

template <class Element>
void fill_buffer(GLenum target, const std::vector<Element>& elements) {
  GLuint name = 0;
  glGenBuffers(1, &name);
  glBindBuffer(target, name);
  glBufferData(target, static_cast<GLsizeiptr>(elements.size() * sizeof(Element)), elements.data(), GL_STATIC_DRAW);
}

}  // namespace

struct Llvmpipe::Context {
  std::vector<std::uint32_t> rgba;
  OSMesaContext mesa = nullptr;
  GLsizei indices = 0;

  Context(std::int32_t width, std::int32_t height)
      : rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", "0", 1);  // 0: it rasterises in the thread that calls; 1 would be a second thread
    const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, 0};
    mesa = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!mesa || !OSMesaMakeCurrent(mesa, rgba.data(), GL_UNSIGNED_BYTE, width, height)) {
      throw std::runtime_error("OSMesa gives no context");
    }
  }
  ~Context() { OSMesaDestroyContext(mesa); }
};

Llvmpipe::Llvmpipe(const Scene& scene, bool cull)
    : context_(std::make_unique<Context>(scene.raster.width, scene.raster.height)) {
  if (name().find("llvmpipe") == std::string::npos)
    throw std::runtime_error("this Mesa has no llvmpipe, but " + name());

  std::vector<GlVertex> vertices;
  for (const glm::dvec3& point : scene.points) {
    const auto n = static_cast<std::uint32_t>(vertices.size());
    const auto shade = [&](int shift) { return static_cast<std::uint8_t>(n >> shift | 1); };
    vertices.push_back({{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)},
                        {shade(0), shade(8), shade(16), 255}});
  }
  std::vector<std::uint32_t> indices;
  for (const Facet& facet : scene.facets) {
    const auto corner = [&](std::int32_t i) {
      return static_cast<std::uint32_t>(scene.corners[static_cast<std::size_t>(facet.first_corner + i)]);
    };
    for (std::int32_t i = 1; i + 1 < facet.corner_count; ++i) {
      indices.insert(indices.end(), {corner(0), corner(i), corner(i + 1)});
    }
  }
  context_->indices = static_cast<GLsizei>(indices.size());
  fill_buffer(GL_ARRAY_BUFFER, vertices);
  fill_buffer(GL_ELEMENT_ARRAY_BUFFER, indices);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(3, GL_FLOAT, sizeof(GlVertex), nullptr);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(GlVertex), reinterpret_cast<const void*>(offsetof(GlVertex, color)));

  glViewport(0, 0, scene.raster.width, scene.raster.height);
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(glm::value_ptr(clip_matrix(scene.camera, scene.raster)));
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixd(glm::value_ptr(scene.camera.view));
  glDisable(GL_DITHER);
  glShadeModel(GL_FLAT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  if (cull) glEnable(GL_CULL_FACE);
  glClearColor(0, 0, 0, 0);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL reports an error");
}

Llvmpipe::~Llvmpipe() = default;

void Llvmpipe::draw_frame() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, context_->indices, GL_UNSIGNED_INT, nullptr);
  glFinish();
}

int Llvmpipe::pixels_drawn() const {
  return static_cast<int>(context_->rgba.size()) -
         static_cast<int>(std::count(context_->rgba.begin(), context_->rgba.end(), 0U));
}

std::string Llvmpipe::name() const { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

}  // namespace zstep::bench
