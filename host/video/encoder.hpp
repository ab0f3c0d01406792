// SPDX-License-Identifier: MIT
// encoder.hpp: frames into a video file, by ffmpeg.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "host/process/descriptor.hpp"

namespace dmrp::host {

// A video file by its ending; nothing for endings other than .mp4, .gif and .webm.
enum class VideoFormat { mp4, gif, webm };
std::optional<VideoFormat> video_format(const std::filesystem::path& file);

int frames_a_second(VideoFormat format);

// Writes to FILE.part, which finish() renames to FILE; a video that is not finished leaves nothing.
class VideoEncoder {
 public:
  // Starts the ffmpeg on the path. Throws MachineError if there is none.
  VideoEncoder(std::filesystem::path file, VideoFormat format, int width, int height);
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;
  ~VideoEncoder();

  // Rows from above, of blue, green, red and an unused byte for each pixel. Throws MachineError when ffmpeg has ended.
  void add(std::span<const std::uint8_t> frame);

  // Throws MachineError if ffmpeg fails; it has said why on standard error.
  void finish();

 private:
  bool wait();  // whether ffmpeg ended well

  std::filesystem::path file_;
  std::filesystem::path part_;
  pid_t child_ = -1;
  Descriptor frames_;
};

}  // namespace dmrp::host
