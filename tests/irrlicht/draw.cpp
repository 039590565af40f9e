// Draws triangles by Burning's Video, the software renderer of the Irrlicht engine, into a run that zstep checks.
//   draw TRIANGLES WIDTH HEIGHT RUN     TRIANGLES as scene.py writes them
// Its triangle renderer comes from the engine's source, with calls of zstep.hpp put in; see held_against.sh.
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <irrlicht.h>

#include <zstep.hpp>  // of `zstep emit cpp`, beside the build

int polygon_at_work = -1;  // of the triangle renderer's calls

int main(int, char** argv) {
  using namespace irr;
  SIrrlichtCreationParameters wanted;
  wanted.DeviceType = EIDT_CONSOLE, wanted.DriverType = video::EDT_BURNINGSVIDEO, wanted.LoggingLevel = ELL_NONE;
  wanted.WindowSize =
      core::dimension2d<u32>(static_cast<u32>(std::atoi(argv[2])), static_cast<u32>(std::atoi(argv[3])));
  IrrlichtDevice* device = createDeviceEx(wanted);
  std::ifstream in(argv[1]);
  zstep::out() = std::fopen(argv[4], "w");
  if (device == nullptr || !in || zstep::out() == nullptr) return 1;
  video::IVideoDriver* driver = device->getVideoDriver();
  driver->beginScene(true, true, video::SColor(255, 255, 255, 255));
  video::SMaterial material;
  material.Lighting = false, material.BackfaceCulling = false;
  driver->setMaterial(material);
  core::matrix4 projection;
  for (u32 row = 0; row < 4; ++row)
    for (u32 column = 0; column < 4; ++column) in >> projection[column * 4 + row];
  driver->setTransform(video::ETS_PROJECTION, projection);
  driver->setTransform(video::ETS_VIEW, core::matrix4());
  driver->setTransform(video::ETS_WORLD, core::matrix4());
  zstep::clear(0);
  video::S3DVertex vertices[3];
  const u16 corners[3] = {0, 1, 2};
  for (int i = 0;; ++i) {
    for (video::S3DVertex& vertex : vertices) in >> vertex.Pos.X >> vertex.Pos.Y >> vertex.Pos.Z;
    if (!in) break;
    zstep::polygon(polygon_at_work = i, i);
    driver->drawIndexedTriangleList(vertices, 3, corners, 1);
  }
  std::fclose(zstep::out());
  std::_Exit(0);  // before the device draws its picture on the terminal
}
