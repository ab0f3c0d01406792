// SPDX-License-Identifier: MIT
// Makes a video of a trial from its trace.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/picture/trial_picture.hpp"
#include "core/trace/trace_reader.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/commands/trial_trace.hpp"
#include "host/errors/input_error.hpp"
#include "host/video/encoder.hpp"

namespace dmrp::host {
namespace {

struct VideoOptions {
  std::filesystem::path run_directory;
  std::uint64_t trial = 0;
  std::filesystem::path out;  // its ending is the format
  std::string title;          // empty: the names of run, scenario and plugins
  double speed = 1.0;         // seconds of the trial in one of the video
  double from_s = 0.0;
  std::optional<double> to_s;  // nothing: the end
};

struct FrameSize {
  int width;
  int height;
};

FrameSize size_of(VideoFormat format) {
  return format == VideoFormat::gif ? FrameSize{960, 540} : FrameSize{1920, 1080};
}

constexpr std::int64_t last_frame_ns = 1'000'000'000;  // how long the end is seen

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

// Shows each sample from its time until the next one.
std::size_t encode(core::TraceReader& trace, const VideoOptions& options, const std::string& title,
                   VideoFormat format) {
  const FrameSize size = size_of(format);
  const std::int64_t shown_ns = 1'000'000'000 / frames_a_second(format);
  const std::int64_t frame_ns = std::max<std::int64_t>(1, std::llround(options.speed * static_cast<double>(shown_ns)));
  const std::string pace = options.speed == 1.0 ? "" : fmt::format("  {}x", options.speed);
  std::int64_t to_ns = options.to_s ? nanoseconds(*options.to_s) : INT64_MAX;
  if (trace.end()) to_ns = std::min(to_ns, trace.end()->t_ns);
  core::TrialFrames picture(trace.world(), size.width, size.height, title);
  VideoEncoder encoder(options.out, format, size.width, size.height);
  std::size_t frames = 0;
  std::int64_t next_ns = nanoseconds(options.from_s);
  std::span<const std::uint8_t> last;
  while (const dmrp_sample* sample = trace.next_sample()) {
    picture.observe(*sample);
    const bool is_last = sample->t_ns >= to_ns;
    if (sample->t_ns < next_ns && !is_last) continue;
    last = picture.frame(*sample, fmt::format("{:.1f} s{}", static_cast<double>(sample->t_ns) * 1e-9, pace));
    for (; next_ns <= std::min(sample->t_ns, to_ns); next_ns += frame_ns, ++frames) encoder.add(last);
    if (is_last) break;
  }
  for (std::int64_t held_ns = 0; held_ns < last_frame_ns; held_ns += shown_ns, ++frames) encoder.add(last);
  encoder.finish();
  return frames;
}

void check_times(const VideoOptions& options, const core::TraceReader& trace) {
  if (options.to_s && *options.to_s <= options.from_s)
    throw InputError(fmt::format("--to {}: is not after --from {}", *options.to_s, options.from_s));
  const double end_s = trace.end() ? static_cast<double>(trace.end()->t_ns) * 1e-9 : INFINITY;
  if (options.from_s > end_s)
    throw InputError(fmt::format("--from {}: trial {} ends at {} s", options.from_s, options.trial, end_s));
}

int video_command(const VideoOptions& options) {
  const std::optional<VideoFormat> format = video_format(options.out);
  if (!format) throw InputError(fmt::format("--out {}: ends in none of .mp4, .gif, .webm", options.out.string()));
  check_output_file("--out", options.out);
  const TrialTrace found = trace_of(options.run_directory, "--trial", options.trial);
  core::TraceReader trace(core::TraceRecords(found.file), core::TraceExtent::samples);
  if (trace.sample_count() == 0)
    throw InputError(fmt::format("--trial {}: nothing moved, since there was no plan", options.trial));
  check_times(options, trace);
  const std::size_t frames = encode(trace, options, options.title.empty() ? found.title : options.title, *format);
  fmt::print("{}: {} frames, {:.1f} s\n", options.out.string(), frames,
             static_cast<double>(frames) / frames_a_second(*format));
  return exit_status::done;
}

}  // namespace

void add_video(CLI::App& app) {
  const auto options = std::make_shared<VideoOptions>();
  CLI::App* command = app.add_subcommand("video", "make a video of a trial, by ffmpeg");
  command->add_option("run", options->run_directory, "run directory")->required()->type_name("RUN_DIR");
  command->add_option("--trial", options->trial, "trial with a recorded trace")->required()->type_name("TRIAL");
  command->add_option("--out", options->out, "output file: .mp4, .gif or .webm")->required()->type_name("FILE");
  command->add_option("--title", options->title, "above the picture (default: the names of run, scenario and plugins)")
      ->type_name("TEXT");
  command->add_option("--speed", options->speed, "seconds of the trial in one second of the video")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str()
      ->type_name("X");
  command->add_option("--from", options->from_s, "first second of the trial that is shown")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str()
      ->type_name("S");
  command->add_option("--to", options->to_s, "last second (default: the end)")
      ->check(CLI::Range(0.0, 1e6))
      ->type_name("S");
  finish_command(command, "dmrp-host video runs/quickstart --trial 0 --out trial.mp4",
                 [options] { return video_command(*options); });
}

}  // namespace dmrp::host
