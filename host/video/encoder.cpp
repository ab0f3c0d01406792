// SPDX-License-Identifier: MIT
#include "host/video/encoder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "host/errors/machine_error.hpp"
#include "host/files/atomic_file.hpp"
#include "host/files/read_file.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* no_encoder =
    "video: there is no ffmpeg on the path, which encodes the frames (Debian: apt-get install ffmpeg)";

std::vector<std::string> arguments_of(VideoFormat format, int width, int height, const fs::path& file) {
  std::vector<std::string> arguments = {"ffmpeg",    "-y",
                                        "-loglevel", "error",
                                        "-f",        "rawvideo",
                                        "-pix_fmt",  "bgr0",
                                        "-s",        fmt::format("{}x{}", width, height),
                                        "-r",        std::to_string(frames_a_second(format)),
                                        "-i",        "-"};
  const auto add = [&](const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  switch (format) {
    case VideoFormat::mp4:
      add({"-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"});
      break;
    case VideoFormat::gif:
      add({"-vf", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none", "-f", "gif"});
      break;
    case VideoFormat::webm:
      add({"-pix_fmt", "yuv420p", "-f", "webm"});
      break;
  }
  arguments.push_back(file.string());
  return arguments;
}

// The process that reads `input` as its standard input.
pid_t start(std::vector<std::string> arguments, int input) {
  std::vector<char*> list;
  for (std::string& argument : arguments) list.push_back(argument.data());
  list.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t pipe_signal;
  sigemptyset(&pipe_signal);
  sigaddset(&pipe_signal, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &pipe_signal);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t child = -1;
  const int error = posix_spawnp(&child, list[0], &actions, &attributes, list.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) throw MachineError(no_encoder);
  if (error != 0) throw MachineError("video: cannot start ffmpeg", error);
  return child;
}

}  // namespace

std::optional<VideoFormat> video_format(const fs::path& file) {
  const fs::path ending = file.extension();
  if (ending == ".mp4") return VideoFormat::mp4;
  if (ending == ".gif") return VideoFormat::gif;
  if (ending == ".webm") return VideoFormat::webm;
  return std::nullopt;
}

int frames_a_second(VideoFormat format) {
  return format == VideoFormat::gif ? 10 : 25;
}

VideoEncoder::VideoEncoder(fs::path file, VideoFormat format, int width, int height)
    : file_(std::move(file)), part_(file_.string() + ".part") {
  signal(SIGPIPE, SIG_IGN);  // writing fails instead, when ffmpeg has ended
  Pipe pipe = make_pipe();
  child_ = start(arguments_of(format, width, height, part_), pipe.read_end.number());
  frames_ = std::move(pipe.write_end);
}

VideoEncoder::~VideoEncoder() {
  if (child_ < 0) return;
  wait();
  std::error_code ignored;
  fs::remove(part_, ignored);
}

bool VideoEncoder::wait() {
  frames_.close();
  int status = 0;
  pid_t ended = -1;
  do ended = waitpid(child_, &status, 0);
  while (ended < 0 && errno == EINTR);
  child_ = -1;
  return ended >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void VideoEncoder::add(std::span<const std::uint8_t> frame) {
  if (!frames_.write({reinterpret_cast<const char*>(frame.data()), frame.size()}))
    throw MachineError("video: ffmpeg takes no more frames", errno);
}

void VideoEncoder::finish() {
  const bool is_whole = wait();
  if (is_whole) write_named_file(file_, read_file(part_, part_.string(), UINTMAX_MAX));
  std::error_code ignored;
  fs::remove(part_, ignored);
  if (!is_whole) throw MachineError("video: ffmpeg failed");
}

}  // namespace dmrp::host
