// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/mag_fit.hpp"
#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/param_file.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

constexpr double microtesla = 1e-6;
const std::array<const char*, 12> correction_names{"MAG_CAL_A00", "MAG_CAL_A01", "MAG_CAL_A02", "MAG_CAL_A10",
                                                   "MAG_CAL_A11", "MAG_CAL_A12", "MAG_CAL_A20", "MAG_CAL_A21",
                                                   "MAG_CAL_A22", "MAG_X_BIAS",  "MAG_Y_BIAS",  "MAG_Z_BIAS"};

struct Correction {
  Matrix3 A = identity3;
  Vector3 b{};
};

Correction correction_of(const std::vector<Param>& params) {
  Correction c;
  for (std::size_t i = 0; i < 9; ++i) c.A[i / 3][i % 3] = params[i].number();
  for (std::size_t i = 0; i < 3; ++i) c.b[i] = params[9 + i].number();
  return c;
}

std::string text_of(const EllipsoidFit& fit, std::size_t samples) {
  std::string out = std::to_string(samples) + " samples. Field " + fixed(fit.field / microtesla, 1) +
                    " uT, hard iron " + fixed(fit.bias[0] / microtesla, 1) + " " +
                    fixed(fit.bias[1] / microtesla, 1) + " " + fixed(fit.bias[2] / microtesla, 1) +
                    " uT, axes differ by a factor of " + fixed(fit.stretch_ratio, 2) + ",\nscatter " +
                    fixed(100 * fit.residual_ratio, 1) + " %, covered " + fixed(100 * fit.coverage_ratio, 0) +
                    " % of all directions, known to " + fixed(100 * fit.uncertainty_ratio, 1) + " %.\n";
  return out;
}

EllipsoidFit judged(const std::vector<Vector3>& samples) {
  const EllipsoidFit fit = fit_ellipsoid(samples);
  if (fit.ok()) std::printf("%s", text_of(fit, samples.size()).c_str());
  if (const std::string fault = objection(fit, microtesla); !fault.empty()) throw Error(fault);
  return fit;
}

/// Collects samples until all six sides are complete.
std::vector<Vector3> collect(Client& client, const Correction& old) {
  MagGuide guide;
  std::int64_t progress_ns = client.now_ns();
  std::size_t kept = 0;
  std::uint64_t imu_us = 0;
  client.on_packet = [&](const Packet& packet) {
    if (packet.is<SmallImu>()) {
      const auto m = packet.as<SmallImu>();
      const double dt_s =
          imu_us == 0 ? 0 : (static_cast<double>(m.time_boot_us) - static_cast<double>(imu_us)) * 1e-6;
      imu_us = m.time_boot_us;
      guide.turn({m.xacc, m.yacc, m.zacc}, {m.xgyro, m.ygyro, m.zgyro}, dt_s);
    } else if (packet.is<SmallMag>()) {
      const auto m = packet.as<SmallMag>();
      guide.take(uncorrected({m.xmag, m.ymag, m.zmag}, old.A, old.b));
    }
  };
  std::string shown;
  while (!guide.done()) {
    client.pump(200 * ms);
    if (guide.samples().size() > kept) progress_ns = client.now_ns();
    kept = guide.samples().size();
    if (client.age_s<SmallMag>() > 3) throw Error(fcu_messages::magnetometer_silent());
    if (client.now_ns() - progress_ns > 120 * second) throw Error(fcu_messages::sampling_timeout());
    if (guide.text() != shown) show_progress(shown = guide.text());
  }
  client.on_packet = nullptr;
  show_progress("");
  return guide.samples();
}

void set_all(Client& client, const std::vector<Param>& before, const EllipsoidFit& fit) {
  std::array<double, 12> values{};
  for (std::size_t i = 0; i < 9; ++i) values[i] = fit.shape[i / 3][i % 3];
  for (std::size_t i = 0; i < 3; ++i) values[9 + i] = fit.bias[i];
  for (std::size_t i = 0; i < before.size(); ++i) {
    client.refuse_armed("changing its parameters");
    set_param(client, before[i], std::bit_cast<std::uint32_t>(static_cast<float>(values[i])));
  }
  const std::vector<Param> after = read_some(client, {correction_names.begin(), correction_names.end()});
  for (std::size_t i = 0; i < after.size(); ++i)
    if (after[i].bits != std::bit_cast<std::uint32_t>(static_cast<float>(values[i])))
      throw Error(fcu_messages::value_not_taken(after[i].name));
  if (after.size() != correction_names.size()) throw Error(fcu_messages::readback_failed(client.name()));
}

}  // namespace

int try_mag_file(const Options&, const HardwareOptions& what) {
  judged(read_samples(what.file));
  std::printf("Good. Nothing was set.\n");
  return 0;
}

int calibrate_mag(Client& client, const Options& options, const HardwareOptions& what) {
  client.refuse_armed("the magnetometer calibration");
  const std::vector<Param> before = read_some(client, {correction_names.begin(), correction_names.end()});
  if (before.size() != correction_names.size())
    throw Error(fcu_messages::mag_parameters_not_reported(client.name()));
  const Correction old = correction_of(before);
  if (what.file.empty() && !(std::fabs(determinant(old.A)) > 1e-6))
    throw Error(fcu_messages::mag_matrix_invalid());
  if (what.file.empty() && !on_terminal()) throw Error(fcu_messages::terminal_required());
  if (what.file.empty())
    std::printf(
        "Take the aircraft outside, away from iron. Lay it on each of six sides, and turn it once around the "
        "vertical on each.\n");
  const std::vector<Vector3> samples = what.file.empty() ? collect(client, old) : read_samples(what.file);
  if (!what.record.empty()) write_param_file(what.record, samples_text(samples), false);
  const EllipsoidFit fit = judged(samples);
  if (what.dry_run) {
    std::printf("Good. Nothing was set.\n");
    return 0;
  }
  if (!confirmed("Set the twelve parameters?", options.yes, "--yes")) return 1;
  set_all(client, before, fit);
  std::printf("Calibrated, and read back.\n");
  if (what.write)
    write_flash(client);
  else
    std::printf(
        "It is in the controller's memory and gone after a power cycle: 'fulmar fcu params write' keeps "
        "it.\n");
  return 0;
}

}  // namespace fulmar::fcu
