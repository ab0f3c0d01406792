// SPDX-License-Identifier: MIT
// file.hpp: files in folders where plugins and strangers can write, too. Nothing here follows a link that they planted, or
// waits for the other end of a pipe.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>

namespace dmrp::core {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// Creates a file, in place of what has its name, to write and to read again. Throws std::system_error.
File create_file(const std::filesystem::path& path);

enum class Links { followed, refused };

// Opens a regular file to read. Throws std::system_error, also for what is no regular file.
File open_file(const std::filesystem::path& path, Links links);

// Throws std::system_error with errno (EIO if it is 0) and the path, for a file that the machine fails to read or write.
[[noreturn]] void throw_file_error(const std::filesystem::path& path);

}  // namespace dmrp::core
