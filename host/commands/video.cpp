// SPDX-License-Identifier: MIT
// Makes a video of a trial from its trace.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "core/trace/trace_reader.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/commands/trial_trace.hpp"
#include "host/errors/input_error.hpp"
#include "host/video/encoder.hpp"
#include "host/video/trial_picture.hpp"

namespace dmrp::host {
namespace {

struct VideoOptions {
  std::filesystem::path run_directory;
  std::uint64_t trial = 0;
  std::filesystem::path out;  // its ending is the format
};

constexpr int width_px = 960;
constexpr int height_px = 720;
constexpr std::int64_t last_frame_ns = 1'000'000'000;  // how long the end is seen

// Shows each sample from its time until the next one.
std::size_t encode(core::TraceReader& trace, const std::filesystem::path& out, VideoFormat format) {
  TrialPicture picture(trace.world(), width_px, height_px);
  const std::int64_t frame_ns = 1'000'000'000 / frames_a_second(format);
  std::unique_ptr<VideoEncoder> encoder;
  std::size_t frames = 0;
  std::int64_t next_ns = 0;
  Canvas last(2, 2, {});
  while (const dmrp_sample* sample = trace.next_sample()) {
    picture.observe(*sample);
    const bool is_last = frames > 0 && trace.end() && sample->t_ns >= trace.end()->t_ns;
    if (sample->t_ns < next_ns && !is_last) continue;
    last = picture.draw(*sample);
    if (!encoder) encoder = std::make_unique<VideoEncoder>(out, format, last.width(), last.height());
    for (; next_ns <= sample->t_ns; next_ns += frame_ns, ++frames) encoder->add(last);
  }
  for (std::int64_t shown_ns = 0; shown_ns < last_frame_ns; shown_ns += frame_ns, ++frames) encoder->add(last);
  encoder->finish();
  return frames;
}

int video_command(const VideoOptions& options) {
  const std::optional<VideoFormat> format = video_format(options.out);
  if (!format) throw InputError(fmt::format("--out {}: ends in none of .mp4, .gif, .webm", options.out.string()));
  check_output_file("--out", options.out);
  core::TraceReader trace(core::TraceRecords(trace_of(options.run_directory, "--trial", options.trial)),
                          core::TraceExtent::samples);
  if (trace.sample_count() == 0)
    throw InputError(fmt::format("--trial {}: nothing moved, since there was no plan", options.trial));
  const std::size_t frames = encode(trace, options.out, *format);
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
  finish_command(command, "dmrp-host video runs/quickstart --trial 0 --out trial.mp4",
                 [options] { return video_command(*options); });
}

}  // namespace dmrp::host
