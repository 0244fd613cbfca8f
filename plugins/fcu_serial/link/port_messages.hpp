// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::port_messages {

inline constexpr MessageText baud_out_of_range{
    "port.baud_out_of_range",
    {"baud"},
    "{baud} baud is no rate of a serial port: 921600 is usual, and 50 to 50000000 are possible"};
inline constexpr MessageText baud_unsupported{
    "port.baud_unsupported",
    {"device", "baud"},
    "{device} cannot run at {baud} baud: name a rate of its hardware, 921600 unless changed"};
inline constexpr MessageText device_access_denied{
    "port.device_access_denied",
    {"device", "group"},
    "no permission to open {device}: join its group with 'sudo usermod -aG {group} $USER' and log in again, "
    "or install the udev rule of docs/hardware.md"};
inline constexpr MessageText device_lost{
    "port.device_lost", {"device"}, "{device} has gone: is it still plugged in?"};
inline constexpr MessageText device_missing{
    "port.device_missing",
    {"device", "candidates"},
    "there is no device {device} ({candidates}): plug the flight controller in, or name its port"};
inline constexpr MessageText device_not_openable{
    "port.device_not_openable", {"device", "reason"}, "cannot open {device}: {reason}"};
inline constexpr MessageText device_not_serial{
    "port.device_not_serial",
    {"device"},
    "{device} is no serial port: name one, as /dev/ttyACM0, or udp:ADDRESS:PORT"};
inline constexpr MessageText format_setup_failed{"port.format_setup_failed",
                                                 {"device", "reason"},
                                                 "cannot set {device} to 8 bits without parity: {reason}"};
inline constexpr MessageText ip_address_invalid{
    "port.ip_address_invalid",
    {"host", "address"},
    "'{host}' in '{address}' is no IPv4 number: write it as udp:127.0.0.1:14525"};
inline constexpr MessageText path_not_port{
    "port.path_not_port",
    {"path", "file_kind"},
    "{path}{file_kind}, no serial port: name a device, as /dev/ttyACM0, or udp:ADDRESS:PORT"};
inline constexpr MessageText port_in_use{
    "port.port_in_use", {"port", "by"}, "{port} is held by {by}: end that first, or name another port"};
inline constexpr MessageText port_missing{
    "port.port_missing", "no port is named: write a device, as /dev/ttyACM0, or udp:ADDRESS:PORT"};
inline constexpr MessageText port_setup_failed{
    "port.port_setup_failed", {"device", "reason"}, "cannot set up {device}: {reason}"};
inline constexpr MessageText udp_address_invalid{"port.udp_address_invalid",
                                                 {"address"},
                                                 "'{address}' is no address: write udp:ADDRESS:PORT or "
                                                 "udp:ADDRESS:PORT:LOCAL_PORT, as udp:127.0.0.1:14525"};
inline constexpr MessageText udp_port_in_use{"port.udp_port_in_use",
                                             {"local_port", "host", "remote_port"},
                                             "UDP port {local_port} is held by another program: end that "
                                             "first, or choose one with udp:{host}:{remote_port}:LOCAL_PORT"};
inline constexpr MessageText usb_device_missing{"port.usb_device_missing",
                                                "no USB serial device is plugged in"};

}  // namespace fulmar::port_messages
