// Large hostile files: within 10 s of processor time and 1 GiB of address space.
#include <doctest/doctest.h>

#if defined(__unix__) && !defined(__SANITIZE_ADDRESS__)
#if !defined(__has_feature)
#define __has_feature(x) 0
#endif
#if !__has_feature(address_sanitizer)  // which reserves terabytes of addresses

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "traces/error.hpp"

using namespace zstep;

namespace {

/// A file that is gone at the end.
class File {
 public:
  explicit File(const std::string& name)
      : path_((std::filesystem::temp_directory_path() / fmt::format("zstep_{}_{}", getpid(), name)).string()),
        stream_(std::fopen(path_.c_str(), "wb")) {}
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::print(stream_, format, std::forward<Args>(args)...);
  }
  void put_bytes(const std::string& bytes) { std::fwrite(bytes.data(), 1, bytes.size(), stream_); }
  const std::string& close() {
    std::fclose(stream_);
    return path_;
  }

 private:
  std::string path_;
  std::FILE* stream_;
};

enum Outcome : int { scene_loaded = 0, refused = 1, out_of_memory = 2, other_error = 3, out_of_time = 4, crashed = 5 };

Outcome load_within_bounds(const std::string& path) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit memory{std::size_t{1} << 30, std::size_t{1} << 30}, time{10, 10};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CPU, &time);
    try {
      load_scene(path);
      _exit(scene_loaded);
    } catch (const InputError&) {
      _exit(refused);
    } catch (const std::bad_alloc&) {
      _exit(out_of_memory);
    } catch (...) {
      _exit(other_error);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) return static_cast<Outcome>(WEXITSTATUS(status));
  return WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL) ? out_of_time : crashed;
}

void put_grid(File& file, int points) {
  for (int i = 0; i < points; ++i) file.put("v {} {} {}\n", i % 1000, i / 1000, i % 7 == 0 ? 1 : 0);
}

}  // namespace

TEST_SUITE("bounds of time and memory") {
  TEST_CASE("as many polygons as are read, half of them at odds with the others") {
    File file("strips.obj");
    for (int i = 0; i < 1'990'000; ++i) file.put("v {} {} 0\n", i % 1000, i / 1000);
    for (int i = 0; i < 1'490'000; ++i) {
      const int k = i % 990'000 + 1;
      file.put("f {} {} {} {}\n", k, k + 1, k + 1001, k + 1000);
    }
    CHECK(load_within_bounds(file.close()) == scene_loaded);
  }

  TEST_CASE("six hundred thousand triangles round one point") {
    File file("fan.obj");
    put_grid(file, 1'200'001);
    for (int i = 0; i < 600'000; ++i) file.put("f 1 {} {}\n", 2 * i + 2, 2 * i + 3);
    CHECK(load_within_bounds(file.close()) == scene_loaded);
  }

  TEST_CASE("polygons that are not planar, of very many corners") {
    File file("rough.obj");
    put_grid(file, 1'000'000);
    for (int first = 0; first < 1'000'000; first += 100'000) {
      file.put("f");
      for (int i = 1; i <= 100'000; ++i) file.put(" {}", first + i);
      file.put("\n");
    }
    CHECK(load_within_bounds(file.close()) == refused);
  }

  TEST_CASE("a triangle behind 200 MiB of blank lines") {
    File file("blank.obj");
    const std::string blank(1 << 20, '\r');
    for (int i = 0; i < 200; ++i) file.put_bytes(blank);
    file.put("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(load_within_bounds(file.close()) == scene_loaded);
  }

  TEST_CASE("200 million faces without corners, and as many values of an element that means nothing") {
    const std::string zeros(1 << 20, '\0');
    for (const char* element : {"element face 209715200\nproperty list uchar int vertex_indices\n",
                                "element junk 209715200\nproperty uchar a\n"}) {
      File file("zeros.ply");
      file.put("ply\nformat binary_little_endian 1.0\n{}end_header\n", element);
      for (int i = 0; i < 200; ++i) file.put_bytes(zeros);
      CHECK(load_within_bounds(file.close()) == refused);
    }
  }

  TEST_CASE("triangles that share no points") {
    File file("soup.stl");
    file.put("solid soup\n");
    for (int i = 0; i < 600'000; ++i)
      file.put("facet normal 0 0 0 outer loop vertex {0} 0 0 vertex {0} 1 0 vertex {0} 0 1 endloop endfacet\n", i);
    file.put("endsolid\n");
    CHECK(load_within_bounds(file.close()) == scene_loaded);
  }

  TEST_CASE("a scene file of nothing but brackets, and one of nothing but meshes") {
    File brackets("brackets.toml");
    brackets.put("x = [");
    for (int i = 0; i < 690'000; ++i) brackets.put("[],");
    brackets.put("]\n");
    CHECK(load_within_bounds(brackets.close()) == refused);
    File meshes("meshes.toml");
    for (int i = 0; i < 60'000; ++i) meshes.put("[[mesh]]\nbuiltin = \"teapot:64\"\n");
    CHECK(load_within_bounds(meshes.close()) == refused);
    File polygons("polygons.toml");
    for (int i = 0; i < 35'000; ++i) polygons.put("[[polygon]]\npoints = [[{0},0,0],[1,{0},0],[0,1,{0}]]\n", i);
    CHECK(load_within_bounds(polygons.close()) == scene_loaded);
  }
}

#endif
#endif
