// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::nmea_gnss_messages {

inline constexpr MessageText baud_not_valid{"nmea_gnss.baud_not_valid",
                                            {"baud"},
                                            "{baud} is not a bit rate of a serial port. Valid: 4800, 9600, "
                                            "19200, 38400, 57600, 115200, 230400, 460800, 921600"};
inline constexpr MessageText latency_too_long{
    "nmea_gnss.latency_too_long",
    {"latency", "rate", "limit"},
    "{latency} s is too long at a rate of {rate} Hz. Give at most {limit} s, or a lower rate"};
inline constexpr MessageText port_missing{"nmea_gnss.port_missing",
                                          "the serial port is not set. Name it, such as /dev/ttyUSB0"};
inline constexpr MessageText port_not_serial{
    "nmea_gnss.port_not_serial", {"path"}, "{path} is not a serial port. Name one, such as /dev/ttyUSB0"};

}  // namespace fulmar::nmea_gnss_messages
