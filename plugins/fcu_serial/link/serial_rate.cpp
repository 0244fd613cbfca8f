// SPDX-License-Identifier: BSD-3-Clause
// A separate file: the kernel's termbits.h and the library's termios.h define the same names. Source:
// ioctl_tty(2), termios(3) on BOTHER.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace fulmar::fcu {

unsigned set_any_rate(int descriptor, unsigned baud);

unsigned set_any_rate(int descriptor, unsigned baud) {
  termios2 settings{};
  if (ioctl(descriptor, TCGETS2, &settings) != 0) return 0;
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | (CBAUD << IBSHIFT));
  settings.c_cflag |= BOTHER | (BOTHER << IBSHIFT);
  settings.c_ispeed = settings.c_ospeed = baud;
  if (ioctl(descriptor, TCSETS2, &settings) != 0 || ioctl(descriptor, TCGETS2, &settings) != 0) return 0;
  return settings.c_ospeed;
}

}  // namespace fulmar::fcu
