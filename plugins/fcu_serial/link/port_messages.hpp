// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::port_messages {

inline constexpr MessageText baud_out_of_range{
    "port.baud_out_of_range",
    {"baud"},
    "{baud} baud is outside the range of a serial port, 50 to 50000000; the usual rate is 921600"};
inline constexpr MessageText baud_unsupported{
    "port.baud_unsupported",
    {"device", "baud"},
    "{device} does not support {baud} baud: give a rate of its hardware, by default 921600"};
inline constexpr MessageText device_access_denied{
    "port.device_access_denied",
    {"device", "group"},
    "the permissions of {device} do not allow access. Join its group with 'sudo usermod -aG {group} $USER' "
    "and log in again, or install the udev rule of docs/hardware.md"};
inline constexpr MessageText device_lost{
    "port.device_lost", {"device"}, "{device} has disappeared: plug it in again, and start again"};
inline constexpr MessageText device_missing{
    "port.device_missing",
    {"device", "candidates"},
    "the device {device} does not exist ({candidates}): plug in the flight controller, or name its port"};
inline constexpr MessageText device_not_openable{
    "port.device_not_openable",
    {"device", "reason"},
    "cannot open {device}: {reason}. Reconnect it, or name another port"};
inline constexpr MessageText device_not_serial{
    "port.device_not_serial",
    {"device"},
    "{device} is not a serial port: name one, such as /dev/ttyACM0, or udp:ADDRESS:PORT"};
inline constexpr MessageText format_setup_failed{
    "port.format_setup_failed",
    {"device", "reason"},
    "cannot set {device} to 8 bits without parity: {reason}. Reconnect it, or name another port"};
inline constexpr MessageText ip_address_invalid{
    "port.ip_address_invalid",
    {"host", "address"},
    "'{host}' in '{address}' is not a numeric IPv4 address: write it as in udp:127.0.0.1:14525"};
inline constexpr MessageText path_not_port{
    "port.path_not_port",
    {"path", "file_kind"},
    "{path}{file_kind}, not a serial port. Name a device such as /dev/ttyACM0, or udp:ADDRESS:PORT."};
inline constexpr MessageText port_in_use{
    "port.port_in_use", {"port", "by"}, "{port} is in use by {by}: end it first, or give another port"};
inline constexpr MessageText port_missing{
    "port.port_missing", "the port is empty: name a device, such as /dev/ttyACM0, or udp:ADDRESS:PORT"};
inline constexpr MessageText port_setup_failed{
    "port.port_setup_failed",
    {"device", "reason"},
    "cannot set up {device}: {reason}. Reconnect it, or name another port"};
inline constexpr MessageText udp_address_invalid{
    "port.udp_address_invalid",
    {"address"},
    "'{address}' is not a UDP address: write udp:ADDRESS:PORT or udp:ADDRESS:PORT:LOCAL_PORT, for example "
    "udp:127.0.0.1:14525"};
inline constexpr MessageText udp_port_in_use{
    "port.udp_port_in_use",
    {"local_port", "host", "remote_port"},
    "another program uses UDP port {local_port}: end that program, or choose another port with "
    "udp:{host}:{remote_port}:LOCAL_PORT"};
inline constexpr MessageText usb_device_missing{"port.usb_device_missing",
                                                "no USB serial device is plugged in"};

}  // namespace fulmar::port_messages
