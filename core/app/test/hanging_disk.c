// SPDX-License-Identifier: BSD-3-Clause
// A disk that hangs, for LD_PRELOAD: while the file in FULMAR_HANG exists, a write to a file that ends in
// .part blocks.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

static void hang(int fd) {
  const char* const marker = getenv("FULMAR_HANG");
  char link[64], file[4096];
  if (!marker || access(marker, F_OK) != 0) return;
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, file, sizeof file - 1);
  if (n < 5 || memcmp(file + n - 5, ".part", 5) != 0) return;
  while (access(marker, F_OK) == 0) {
    const struct timespec pause = {0, 10000000};
    nanosleep(&pause, NULL);
  }
}

ssize_t write(int fd, const void* data, size_t size) {
  static ssize_t (*real)(int, const void*, size_t);
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "write");
  hang(fd);
  return real(fd, data, size);
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
  static ssize_t (*real)(int, const void*, size_t, off_t);
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "pwrite");
  hang(fd);
  return real(fd, data, size, at);
}

ssize_t writev(int fd, const struct iovec* parts, int count) {
  static ssize_t (*real)(int, const struct iovec*, int);
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "writev");
  hang(fd);
  return real(fd, parts, count);
}
