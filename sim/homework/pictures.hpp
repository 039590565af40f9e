// Pictures and depths that a program printed instead of its steps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/homework/assess.hpp"

namespace zstep::homework {

/// The pictures of a scene that a submission has, a folder or a single file: SCENE.png and SCENE.npy of whole numbers
/// are the frame, SCENE.npy, SCENE.depth.npy and SCENE.pfm the depths.
std::vector<std::filesystem::path> pictures_of(const std::filesystem::path& submission, const Task& task);
/// The scene of which a file is a run or a picture: "crossing" of crossing.jsonl and of crossing.depth.npy.
std::string scene_of(const std::filesystem::path& file);

struct PictureGrade {
  std::vector<bool> expected, drawn;  ///< by pixel: by the reference, and in what was handed in
  grade::PixelsApart apart;
  bool keeps_depths = false;
  std::optional<FirstWrong> first;
  grade::PartCount count(const grade::Part& part) const {
    return grade::count_pixels(part, expected, drawn, apart, keeps_depths);
  }
};
/// Holds the frame or the depths, or both, against the reference's at its end, pixel by pixel. Throws InputError where
/// a file is no picture of this scene's size.
PictureGrade grade_pictures(const Trace& reference, const std::vector<std::filesystem::path>& files);

}  // namespace zstep::homework
