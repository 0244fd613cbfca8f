// SPDX-License-Identifier: BSD-3-Clause
// Faults of a device, each with its message, and the properties of an open one.
#include "plugins/fcu_serial/link/port.hpp"

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <grp.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "pty.hpp"

namespace port_test {

using namespace fulmar::fcu;
using fulmar::fcu::testing::Pty;

namespace {

std::string fault_of(const std::string& where, std::int64_t baud = 921600) {
  try {
    Port::open(where, baud);
  } catch (const PortError& e) {
    return e.what();
  }
  return "opened";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A child that does something and then waits to be ended.
class Child {
 public:
  explicit Child(const std::function<void()>& act) {
    int done[2];
    REQUIRE(pipe(done) == 0);
    pid_ = fork();
    if (pid_ == 0) {
      act();
      if (::write(done[1], "x", 1) != 1) _exit(1);
      for (;;) pause();
    }
    char c;
    REQUIRE(::read(done[0], &c, 1) == 1);
    close(done[0]);
    close(done[1]);
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
};

/// The message for another user.
std::string fault_as_nobody(const std::string& where) {
  int out[2];
  REQUIRE(pipe(out) == 0);
  const pid_t pid = fork();
  if (pid == 0) {
    if (setegid(65534) != 0 || seteuid(65534) != 0) _exit(1);
    const std::string fault = fault_of(where);
    _exit(::write(out[1], fault.data(), fault.size()) == static_cast<ssize_t>(fault.size()) ? 0 : 1);
  }
  close(out[1]);
  std::string text(1000, '\0');
  const ssize_t n = ::read(out[0], text.data(), text.size());
  close(out[0]);
  waitpid(pid, nullptr, 0);
  text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  return text;
}

class UdpPeer {
 public:
  UdpPeer() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(bind(fd_, reinterpret_cast<sockaddr*>(&any), sizeof any) == 0);
  }
  ~UdpPeer() { close(fd_); }
  UdpPeer(const UdpPeer&) = delete;
  UdpPeer& operator=(const UdpPeer&) = delete;
  int fd() const { return fd_; }
  int number() const {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    getsockname(fd_, reinterpret_cast<sockaddr*>(&own), &size);
    return ntohs(own.sin_port);
  }

 private:
  int fd_;
};

/// The kernel's struct termios2, which TCGETS2 fills.
struct Rates {
  std::uint32_t modes[4];
  std::uint8_t line_and_characters[20];
  std::uint32_t in, out;
};

int free_port() { return UdpPeer().number(); }

}  // namespace

TEST_CASE("a device that is not there is named, with those that are or that none is") {
  const std::string text = fault_of("/dev/ttyACM_no_such");
  CHECK(has(text, "port.device_missing(/dev/ttyACM_no_such, "));
  CHECK((has(text, "port.usb_device_missing") ||
         has(text, "port.device_missing(/dev/ttyACM_no_such, there is /dev/tty")));
}

TEST_CASE("a folder, a file and a device without a line are no serial ports") {
  CHECK(has(fault_of("/tmp"), "port.path_not_port(/tmp,  is a folder)"));
  const std::string file =
      std::filesystem::temp_directory_path() / ("fulmar_port_" + std::to_string(getpid()));
  std::ofstream(file) << "x";
  CHECK(has(fault_of(file), "port.path_not_port(" + file + ",  is a file)"));
  std::filesystem::remove(file);
  CHECK(has(fault_of("/dev/null"), "port.device_not_serial(/dev/null)"));
  CHECK(has(fault_of(""), "port.port_missing"));
}

TEST_CASE("an impossible rate is refused with what is possible") {
  const Pty pty;
  for (const std::int64_t baud :
       {std::int64_t{0}, std::int64_t{-9600}, std::int64_t{49}, std::int64_t{1} << 40}) {
    CHECK(has(fault_of(pty.name(), baud), "port.baud_out_of_range(" + std::to_string(baud) + ")"));
  }
}

TEST_CASE("without permission the sentence names the group and the rule") {
  if (geteuid() != 0) {
    MESSAGE("skipped: only root can become somebody else");
    return;
  }
  const Pty pty;
  REQUIRE(chmod(pty.device().c_str(), 0600) == 0);
  const std::string text = fault_as_nobody(pty.device());
  struct stat device {};
  REQUIRE(stat(pty.device().c_str(), &device) == 0);
  const group* owner = device.st_gid != 0 ? getgrgid(device.st_gid) : nullptr;
  const std::string to_join = owner != nullptr ? owner->gr_name : "dialout";
  CHECK(has(text, "port.device_access_denied(" + pty.device() + ", " + to_join + ")"));
}

TEST_CASE("a port that another program holds says so, and who it is") {
  const Pty pty;
  const Child other([&] {
    const int fd = open(pty.device().c_str(), O_RDWR | O_NOCTTY);
    if (fd < 0 || flock(fd, LOCK_EX) != 0) _exit(1);
  });
  const std::string text = fault_of(pty.name());
  CHECK(has(text, "port.port_in_use(" + pty.name() + ", another program, "));
  CHECK(has(text, "(pid " + std::to_string(other.pid()) + ")"));
}

TEST_CASE("a port is held against a second opening, by root, too, and free again afterwards") {
  const Pty pty;
  {
    const auto port = Port::open(pty.name());
    CHECK(has(fault_of(pty.name()), "port.port_in_use(" + pty.name() + ", this program)"));
    if (geteuid() == 0) {
      REQUIRE(chmod(pty.device().c_str(), 0666) == 0);
      CHECK(has(fault_as_nobody(pty.device()), "port.port_in_use(" + pty.device() + ", "));
    }
  }
  CHECK(fault_of(pty.name()) == "opened");
  if (geteuid() == 0) CHECK(fault_as_nobody(pty.device()) == "opened");
}

TEST_CASE(
    "an opened line is raw with 8 data bits, at any rate, and closing it leaves the modem lines alone") {
  for (const std::int64_t baud :
       {std::int64_t{921600}, std::int64_t{9600}, std::int64_t{250000}, std::int64_t{1234567}}) {
    CAPTURE(baud);
    const Pty pty;
    const auto port = Port::open(pty.name(), baud);
    termios settings{};
    REQUIRE(tcgetattr(port->descriptor(), &settings) == 0);
    CHECK((settings.c_cflag & CSIZE) == CS8);
    CHECK((settings.c_cflag & (PARENB | CSTOPB | CRTSCTS | HUPCL)) == 0);
    CHECK((settings.c_lflag & (ICANON | ECHO | ISIG)) == 0);
    CHECK((settings.c_oflag & OPOST) == 0);
    CHECK((settings.c_iflag & (IXON | IXOFF | ICRNL | ISTRIP)) == 0);
    CHECK((fcntl(port->descriptor(), F_GETFD) & FD_CLOEXEC) != 0);
    Rates rates{};
    REQUIRE(ioctl(port->descriptor(), _IOR('T', 0x2A, Rates), &rates) == 0);
    CHECK(rates.out == baud);
    CHECK(rates.in == baud);
  }
}

TEST_CASE("bytes of every value pass both ways unchanged, and what waited before the opening does not") {
  const Pty pty;
  REQUIRE(pty.write(std::vector<std::uint8_t>{1, 2, 3}));
  const auto port = Port::open(pty.name());
  std::vector<std::uint8_t> all(256), got(300);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  CHECK(port->read(got, 0) == 0);
  REQUIRE(pty.write(all));
  std::size_t n = 0;
  for (int tries = 0; n < all.size() && tries < 100; ++tries) n += port->read(std::span(got).subspan(n), 100);
  CHECK(n == all.size());
  CHECK(std::equal(all.begin(), all.end(), got.begin()));
  CHECK(port->write(all));
  for (n = 0; n < all.size();) {
    const std::size_t more = pty.read(std::span(got).subspan(n), 1000);
    REQUIRE(more > 0);
    n += more;
  }
  CHECK(std::equal(all.begin(), all.end(), got.begin()));
}

TEST_CASE("a line that takes no more loses whole frames, never parts of one") {
  const Pty pty;
  const auto port = Port::open(pty.name());
  // Each frame is a count and 49 bytes of it.
  std::vector<std::uint8_t> frame(50), came, room(4096);
  std::vector<std::uint8_t> sent;
  int refused = 0;
  for (int i = 0; refused < 10 && i < 100'000; ++i) {
    std::fill(frame.begin(), frame.end(), static_cast<std::uint8_t>(i));
    if (port->write(frame))
      sent.push_back(static_cast<std::uint8_t>(i));
    else
      ++refused;
  }
  REQUIRE(refused == 10);
  const auto drain = [&] {
    while (const std::size_t n = pty.read(room, 50))
      came.insert(came.end(), room.begin(), room.begin() + static_cast<std::ptrdiff_t>(n));
  };
  drain();
  std::fill(frame.begin(), frame.end(), std::uint8_t{0xaa});
  REQUIRE(port->write(frame));
  sent.push_back(0xaa);
  drain();
  REQUIRE(came.size() == sent.size() * frame.size());
  bool whole = true;
  for (std::size_t i = 0; i < came.size(); ++i) whole = whole && came[i] == sent[i / frame.size()];
  CHECK(whole);
}

TEST_CASE("a device that goes throws from read, refuses writes, and its name may come back elsewhere") {
  Pty pty;
  auto port = Port::open(pty.name());
  std::vector<std::uint8_t> room(10);
  CHECK(port->read(room, 0) == 0);
  pty.pull();
  CHECK_THROWS_AS(port->read(room, 100), PortError);
  CHECK_FALSE(port->write(room));
  CHECK(has(fault_of(pty.name()), "port.device_missing(" + pty.name() + ", "));
  port.reset();
  pty.plug();
  CHECK(fault_of(pty.name()) == "opened");
}

TEST_CASE("an address that is none is refused with an example") {
  for (const char* where : {"udp:", "udp:127.0.0.1", "udp:127.0.0.1:", "udp:127.0.0.1:x", "udp:127.0.0.1:0",
                            "udp:127.0.0.1:70000", "udp::14525",
                            "udp:127.0.0.1:14525:", "udp:127.0.0.1:14525:14520:1", "udp:127.0.0.1:145 25"}) {
    CAPTURE(where);
    CHECK(has(fault_of(where), std::string("port.udp_address_invalid(") + where + ")"));
  }
  CHECK(has(fault_of("udp:autopilot.local:14525"),
            "port.ip_address_invalid(autopilot.local, udp:autopilot.local:14525)"));
  CHECK(fault_of("udp:localhost:14525:" + std::to_string(free_port())) == "opened");
}

TEST_CASE("a UDP port that is taken is refused, with a way out") {
  const UdpPeer taken;
  const std::string text = fault_of("udp:127.0.0.1:14525:" + std::to_string(taken.number()));
  CHECK(has(text, "port.udp_port_in_use(" + std::to_string(taken.number()) + ", 127.0.0.1, 14525)"));
}

TEST_CASE("datagrams pass both ways; nobody there is no fault; strangers are not heard") {
  const int local = free_port();
  UdpPeer peer;
  const auto port =
      Port::open("udp:127.0.0.1:" + std::to_string(peer.number()) + ":" + std::to_string(local));
  const std::vector<std::uint8_t> message{1, 2, 3, 0, 255};
  std::vector<std::uint8_t> room(100);
  CHECK(port->write(message));
  REQUIRE(recv(peer.fd(), room.data(), room.size(), 0) == 5);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(static_cast<std::uint16_t>(local));
  const UdpPeer stranger;
  const auto send_from = [&](int fd) {
    return sendto(fd, message.data(), message.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to);
  };
  REQUIRE(send_from(stranger.fd()) == 5);
  CHECK(port->read(room, 50) == 0);
  REQUIRE(send_from(peer.fd()) == 5);
  CHECK(port->read(room, 1000) == 5);
  CHECK(std::equal(message.begin(), message.end(), room.begin()));

  const auto alone =
      Port::open("udp:127.0.0.1:" + std::to_string(free_port()) + ":" + std::to_string(free_port()));
  for (int i = 0; i < 5; ++i) {
    CHECK(alone->write(message));
    CHECK(alone->read(room, 1) == 0);
  }
}

TEST_CASE("opening a port leaves the process's signals as they were") {
  struct sigaction before {};
  before.sa_handler = SIG_DFL;
  REQUIRE(sigaction(SIGPIPE, &before, nullptr) == 0);
  const Pty pty;
  const auto port = Port::open(pty.name());
  struct sigaction after {};
  sigaction(SIGPIPE, nullptr, &after);
  CHECK((after.sa_handler == SIG_DFL));
}

}  // namespace port_test
