// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/outputs.hpp"

#include <cmath>
#include <numbers>

#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

constexpr std::int64_t each = 20 * ms;  // far below OFFBOARD_TIMEOUT
// the throttle command is 0, so that its override has no effect
constexpr std::uint16_t pilot_has_surfaces =
    override_attitude_switch | override_stick_x | override_stick_y | override_stick_z;

void command(Client& client, int row, double value) {
  OffboardControl c;
  c.u[static_cast<std::size_t>(row)] = static_cast<float>(value);
  client.send(c);
}

void watch(Client& client) {
  const auto status = client.last<RosflightStatus>();
  if (status && status->armed != 0) throw Error(fcu_messages::armed_during_test());
  if (client.age_s<RosflightStatus>() > 1) throw Error(fcu_messages::status_lost_during_test(client.name()));
  if (client.age_s<RcChannels>() > 0.5) throw Error(fcu_messages::radio_frames_missing());
}

/// Records the first half of the movement, to the positive side, or the second one.
void note(const Client& client, bool positive, std::vector<Moved>& moved) {
  const auto raw = client.last<RosflightOutputRaw>();
  if (!raw || client.age_s<RosflightOutputRaw>() > 0.1) return;
  for (Moved& m : moved) {
    const double now = static_cast<double>(raw->values[static_cast<std::size_t>(m.output)]);
    if (m.rest < 0) m.rest = m.first = m.then = now;
    double& farthest = positive ? m.first : m.then;
    if (std::fabs(now - m.rest) > std::fabs(farthest - m.rest)) farthest = now;
  }
}

}  // namespace

const std::vector<Surface>& surfaces() {
  static const std::vector<Surface> list{
      {row_aileron, "aileron", "rolls right: right aileron up, left aileron down"},
      {row_elevator, "elevator", "nose down: trailing edge down"},
      {row_rudder, "rudder", "nose left: trailing edge left"}};
  return list;
}

void take_outputs(Client& client) {
  const std::int64_t until = client.now_ns() + 3 * second;
  const std::uint64_t before = client.count<RosflightStatus>();
  client.wait(second, [&] { return client.age_s<RcChannels>() < 0.5; });
  while (client.now_ns() < until) {
    command(client, row_aileron, 0);
    client.pump(each);
    watch(client);
    const auto status = client.last<RosflightStatus>();
    if (client.count<RosflightStatus>() > before + 2 && status->offboard != 0 &&
        (status->rc_override & (pilot_has_surfaces | 0x1c0)) == 0)
      return;
  }
  const auto status = client.last<RosflightStatus>();
  const auto pilots = override_words(static_cast<std::uint16_t>(status->rc_override & pilot_has_surfaces));
  if (pilots.empty()) throw Error(fcu_messages::commands_not_accepted());
  throw Error(fcu_messages::pilot_override_active(core::join(pilots)));
}

std::vector<Moved> move_surface(Client& client, const Mixer& mixer, int row, double size,
                                std::int64_t period_ns) {
  std::vector<Moved> moved;
  for (const int output : mixer.outputs_of(row)) moved.push_back({output});
  const std::int64_t began = client.now_ns();
  while (client.now_ns() - began < period_ns) {
    const double part = static_cast<double>(client.now_ns() - began) / static_cast<double>(period_ns);
    command(client, row, size * std::sin(2 * std::numbers::pi * part));
    client.pump(each);
    watch(client);
    if (const auto status = client.last<RosflightStatus>(); (status->rc_override & pilot_has_surfaces) != 0)
      throw Error(fcu_messages::pilot_took_over(
          core::join(override_words(static_cast<std::uint16_t>(status->rc_override & pilot_has_surfaces)))));
    note(client, part < 0.5, moved);
  }
  command(client, row, 0);
  client.pump(100 * ms);
  for (const Moved& m : moved)
    if (std::fabs(m.first - m.then) < 0.05)
      throw Error(fcu_messages::output_not_moved(m.output, fixed(m.rest, 2)));
  return moved;
}

}  // namespace fulmar::fcu
