// SPDX-License-Identifier: BSD-3-Clause
// A satellite receiver on a serial port of the companion computer. Runs in a separate thread: `run: driver`.
#pragma once
#include <sys/stat.h>

#include <stdexcept>
#include <string>

#include "epochs.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/plugin.hpp"
#include "messages.hpp"
#include "serial_port.hpp"

namespace fulmar::nmea {

struct Receiver {
  static constexpr const char* doc =
      "NMEA 0183 from a serial port: one sample per epoch. Needs `run: driver`.";
  struct Inputs {};
  struct Outputs {
    OutQueue<Gnss, 16> gnss;
    Probe bad_lines_ratio;  // lines dropped since the start: garbled, cut, without a right checksum
  };
  struct Params {
    TextParam<128> port{"", "serial port, such as /dev/ttyUSB0"};
    Count baud{9600, 4800, 921600, "bit rate", setup};
    Param range_std{3, "m", 0.01, 100, "standard deviation of one range, for receivers without GST", setup};
  };

  void configure(const Params& p) {
    path_ = p.port.view();
    if (path_.empty()) throw std::runtime_error(located("port", nmea_gnss_messages::port_missing()).line());
    struct stat found {};
    if (stat(path_.c_str(), &found) == 0 && !S_ISCHR(found.st_mode))
      throw std::runtime_error(located("port", nmea_gnss_messages::port_not_serial(path_)).line());
    const auto code = baud_code(p.baud);
    if (!code) {
      throw std::runtime_error(located("baud", nmea_gnss_messages::baud_not_valid(p.baud.value)).line());
    }
    baud_ = *code;
    lines_ = {};
    bad_reported_ = 0;
    epochs_ = Epochs(p.range_std);
    port_.close();
  }

  /// Waits at most 50 ms for bytes. `degraded` without a device; it is tried ten times a second.
  Status step(const Tick&, const Inputs&, const Params&, Outputs& out) {
    const auto emit = [&](const Gnss& sample) { out.gnss.push(sample, on_arrival); };
    if (!port_.is_open()) {
      if (!port_.open(path_, baud_)) {
        pause_ms(100);
        return Status::degraded;
      }
      lines_.reset();
      epochs_.reset();
    }
    std::array<char, 512> bytes;
    const std::size_t n = port_.read(bytes, 50);
    for (std::size_t i = 0; i < n; ++i) {
      if (const Sentence* sentence = lines_.push(bytes[i])) epochs_.take(*sentence, emit);
    }
    if (n == 0) epochs_.flush(emit);
    if (lines_.bad() != bad_reported_)
      out.bad_lines_ratio = static_cast<double>(bad_reported_ = lines_.bad());
    return port_.is_open() ? Status::ok : Status::degraded;
  }

 private:
  std::string path_;
  speed_t baud_ = B9600;
  SerialPort port_;
  Lines lines_;
  Epochs epochs_;
  std::uint64_t bad_reported_ = 0;
};

}  // namespace fulmar::nmea
