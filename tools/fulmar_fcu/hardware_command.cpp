// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/calibrate.hpp"
#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/outputs.hpp"
#include "tools/fulmar_fcu/preflight.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

/// Clock of the newest inertial sample; it restarts at each boot.
std::uint64_t clock_us(const Client& client) {
  const auto imu = client.last<SmallImu>();
  return imu ? imu->time_boot_us : 0;
}

/// True once the clock has gone back. A device that disappears meanwhile, as with USB, is opened again.
bool came_back(Client& client, std::uint64_t before_us, std::int64_t limit_ns) {
  const auto back = [&] { return clock_us(client) + 10000 < before_us; };
  try {
    return client.wait(limit_ns, back);
  } catch (const PortError&) {
    client.reopen(limit_ns);
    return client.wait(limit_ns, back);
  }
}

/// Shows the progress. Values that a failure loses are listed in the form of `params set`.
Calibrated calibrated(Client& client, const Calibration& calibration) {
  const std::string name = calibration.name;
  try {
    return calibrate(client, calibration, [&](double elapsed_s) {
      show_progress("calibrating " + name + ": " + fixed(elapsed_s, 0) + " s, usually " +
                    std::to_string(calibration.usual_s) + " s");
    });
  } catch (const BiasesLost& lost) {
    show_progress("");
    std::printf("Before this calibration:\n");
    for (const Param& p : lost.former) std::printf("%-16s %s\n", p.name.c_str(), p.text().c_str());
    std::printf(
        "Set them by 'fulmar fcu params set', or power-cycle the controller: what was written is kept.\n");
    throw;
  }
}

nlohmann::json json_of(const Mixer& m) {
  static constexpr std::array<const char*, 4> kinds{"none", "servo", "motor", "gpio"};
  nlohmann::json out{{"primary", m.choice},
                     {"secondary", m.secondary_choice},
                     {"faults", mixer_faults(m)},
                     {"notes", mixer_remarks(m)}};
  for (int j = 0; j < 10; ++j) {
    const auto at = static_cast<std::size_t>(j);
    out["outputs"].push_back({{"output", j},
                              {"type", kinds[static_cast<std::size_t>(m.kind[at])]},
                              {"rate_hz", m.rate_hz[at]},
                              {"follows", output_words(m, j)}});
  }
  out["primary_matrix"] = m.primary;
  out["secondary_matrix"] = m.secondary;
  return out;
}

}  // namespace

int calibrate_command(Client& client, const Options& options, const HardwareOptions& what) {
  if (what.what == "mag") return calibrate_mag(client, options, what);
  const Calibration& calibration = *find_calibration(what.what);
  client.refuse_armed("the " + what.what + " calibration");
  std::printf("%s\n", calibration.prepare);
  std::fflush(stdout);
  const Calibrated result = calibrated(client, calibration);
  show_progress("");
  for (std::size_t i = 0; i < result.after.size(); ++i)
    std::printf("%-16s %s -> %s\n", result.after[i].name.c_str(), result.before[i].text().c_str(),
                result.after[i].text().c_str());
  const auto same = [&](std::size_t i) { return result.before[i].bits == result.after[i].bits; };
  if (what.what == "rc" && same(0) && same(1) && same(2))
    std::printf("The sticks were in the middle: there was no trim to take over.\n");
  else if (what.what == "rc")
    std::printf(
        "Now put the transmitter's trims back to the middle: the controller adds these from now on.\n");
  std::printf("Calibrated, and read back.\n");
  if (what.write)
    write_flash(client);
  else
    std::printf(
        "It is in the controller's memory and gone after a power cycle: 'fulmar fcu params write' keeps "
        "it.\n");
  return 0;
}

int reboot_command(Client& client, const Options&) {
  client.refuse_armed("a reboot");
  client.wait(second, [&] { return client.count<SmallImu>() > 0; });
  const std::uint64_t before_us = clock_us(client);
  if (before_us == 0) throw Error(fcu_messages::inertial_samples_missing(client.name()));
  bool answered = true;
  try {
    const std::optional<bool> answer = client.command(Command::reboot, 1, second);
    if (answer && !*answer) throw Error(fcu_messages::reboot_refused());
    answered = answer.has_value();
  } catch (const PortError&) {
    client.reopen(10 * second);
  }
  if (!came_back(client, before_us, 10 * second))
    throw Error(answered ? fcu_messages::reboot_not_done() : fcu_messages::reboot_unanswered(client.name()));
  std::printf(
      "Rebooted. Barometer and airspeed are being zeroed for 12 s: keep it still, and the pitot tube "
      "covered.\n");
  return 0;
}

int mixer_command(Client& client, const Options& options) {
  const Mixer mixer = mixer_of(read_params(client));
  std::printf("%s%s", options.json ? json_of(mixer).dump(1).c_str() : mixer_text(mixer).c_str(),
              options.json ? "\n" : "");
  return 0;
}

int check_command(Client& client, const Options& options, const HardwareOptions& what) {
  std::optional<Airframe> airframe;
  if (!what.airframe.empty()) airframe = read_airframe(what.airframe);
  Facts facts = gather(client, options.baud);
  facts.airframe = airframe;
  const std::vector<Item> items = judge(facts);
  bool good = true;
  nlohmann::json list = nlohmann::json::array();
  static constexpr std::array<const char*, 4> words{"OK", "note", "WARN", "FAIL"};
  for (const Item& item : items) {
    good = good && item.verdict != Verdict::fail;
    list.push_back({{"verdict", words[static_cast<std::size_t>(item.verdict)]},
                    {"item", item.name},
                    {"text", item.text}});
  }
  std::printf("%s%s", options.json ? list.dump(1).c_str() : items_text(items).c_str(),
              options.json ? "\n" : "");
  return good ? 0 : 1;
}

int outputs_command(Client& client, const Options&, const HardwareOptions& what) {
  client.refuse_armed("moving its surfaces");
  std::printf(
      "Aileron, elevator and rudder will move to half their throw, positive side first. The motor gets no "
      "command.\n");
  if (!confirmed("Is the propeller OFF, and are all hands away?", what.propeller_off,
                 "--propeller-off, once it is"))
    return 1;
  const Mixer mixer = mixer_of(read_params(client));
  take_outputs(client);
  for (const Surface& surface : surfaces()) {
    if (mixer.outputs_of(surface.command).empty()) {
      std::printf("%-9s no output follows it\n", surface.name);
      continue;
    }
    std::printf("%-9s first %s\n", surface.name, surface.positive);
    std::fflush(stdout);
    for (const Moved& m : move_surface(client, mixer, surface.command, 0.5, 4 * second))
      std::printf("          %s\n",
                  fcu_messages::output_moved(m.output, fixed(m.first, 2), fixed(m.then, 2)).text.c_str());
  }
  std::printf(
      "The pilot has the surfaces again. One that went the other way first: set its REV_ parameter, or "
      "`reversed` in the airframe file, "
      "not both.\n");
  return 0;
}

}  // namespace fulmar::fcu
