/* SPDX-License-Identifier: MIT */
/* Preloaded by network_file_system.sh: what lies below PRETENDED_FOLDER seems to be on NFS. */
#define _GNU_SOURCE
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/vfs.h>
#include <unistd.h>

int statfs(const char* path, struct statfs* facts) {
  const char* folder = getenv("PRETENDED_FOLDER");
  char real[PATH_MAX];
  const int status = (int)syscall(SYS_statfs, path, facts);
  if (status == 0 && folder && realpath(path, real) && strncmp(real, folder, strlen(folder)) == 0)
    facts->f_type = 0x6969;
  return status;
}
