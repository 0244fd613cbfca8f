// SPDX-License-Identifier: BSD-3-Clause
// Constructors for variant.c that do no harm in the probe and misbehave in the host.
#define _GNU_SOURCE
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int tried(void) {
  char name[32] = "";
  const int file = open("/proc/self/comm", O_RDONLY | O_CLOEXEC);
  if (file < 0 || read(file, name, sizeof name - 1) < 0) return 0;
  close(file);
  return strncmp(name, "fulmar-probe", 12) == 0;
}

int sly_exit(void);
int sly_exit(void) {
  if (!tried()) exit(0);
  return 0;
}

int sly_quit(void);
int sly_quit(void) {
  if (!tried()) _exit(0);
  return 0;
}

int sly_crash(void);
int sly_crash(void) {
  if (!tried()) raise(SIGSEGV);
  return 0;
}

int sly_hup(void);
int sly_hup(void) {
  if (!tried()) raise(SIGHUP);
  return 0;
}

static int stays;
int sly_stay(void);
int sly_stay(void) { return stays = !tried(); }

static int armed;
int sly_last(void);
int sly_last(void) { return armed = !tried(); }
__attribute__((destructor)) static void at_last(void) {
  if (armed) exit(0);
  while (stays) pause();
}

/// An orphaned process in a separate session writes its number to the file SLY_FILE.
static void leave_behind(const char* name) {
  int ready[2];
  if (pipe(ready) != 0 || fork() != 0) {
    close(ready[1]);
    char byte;
    while (read(ready[0], &byte, 1) < 0) continue;
    return;
  }
  setsid();
  if (fork() != 0) _exit(0);
  const int file = open(name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const pid_t number = getpid();
  if (write(file, &number, sizeof number) < 0 || write(ready[1], "", 1) < 0) _exit(1);
  for (;;) pause();
}

int sly_setsid(void);
int sly_setsid(void) {
  const char *name = getenv("SLY_FILE"), *then = getenv("SLY_THEN");
  if (name == NULL || !tried()) return 0;
  leave_behind(name);
  if (then && strcmp(then, "crash") == 0) raise(SIGSEGV);
  if (then && strcmp(then, "exit") == 0) _exit(0);
  while (then && strcmp(then, "hang") == 0) pause();
  return 0;
}
