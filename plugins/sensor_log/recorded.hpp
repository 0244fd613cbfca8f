// SPDX-License-Identifier: BSD-3-Clause
// The vehicle: samples of a recorded flight at their recorded times. Commands have no effect.
#pragma once
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/notice.hpp>
#include <fulmar/msg/rc.hpp>
#include <fulmar/msg/vehicle_status.hpp>
#include <fulmar/plugin.hpp>
#include <map>

#include "refusals.hpp"
#include "schedule.hpp"

namespace fulmar::sensor_log {

/// Progress of the recording, and number of its rows that are no samples.
struct Recording {
  bool ended = false;              ///< true at the last tick
  double left_s = 0;               ///< time left
  std::uint64_t not_finite = 0;    ///< number of skipped rows with an empty, NaN or infinite cell
  std::uint64_t out_of_range = 0;  ///< number of skipped rows with impossible values
  std::uint64_t out_of_order = 0;  ///< number of skipped rows with a stamp not after the previous ones
  std::uint64_t withheld = 0;      ///< number of samples in the windows of `withhold`
};

struct Recorded {
  static constexpr const char* doc = "A recorded flight: its sensors from files, at the recorded times.";
  struct Inputs {
    Optional<Actuators> actuators;
  };
  struct Outputs {
    Out<Imu> imu;
    Out<Gnss> gnss;
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Rc rc;
    VehicleStatus status;
    Recording recording;
    OutQueue<Notice, 10> notices;
  };
  struct Params {
    Record<Description> log{"assignment of the columns of the files to the sensors", required};
    TextParam<256> folder{"", "folder of the files, relative to the current directory"};
  };

  void configure(const Params& p) {
    d_ = *p.log;
    counts_ = {};
    notices_.clear();
    ticks_.clear();
    next_ = 0;
    refuse_description(d_);
    if (p.folder.view().empty()) refuse("folder", sensor_log_messages::folder_missing(files_of(d_)));
    read_files(std::string(p.folder.view()));
    begin_at_zero();
    plan();
  }

  Status read(Tick& tick, const Params&, Outputs& out) {
    if (next_ == ticks_.size()) throw std::runtime_error(sensor_log_messages::recording_ended().line());
    const PlannedTick& now = ticks_[next_++];
    tick.now_ns = now.now_ns;
    show(out.gnss, gnss_, now, Sensor::gnss);
    show(out.mag, mag_, now, Sensor::mag);
    show(out.baro, baro_, now, Sensor::baro);
    show(out.pitot, pitot_, now, Sensor::pitot);
    show(out.imu, imu_, now, Sensor::imu);
    out.rc = Rc{};
    out.status = status(now.now_ns);
    out.recording = counts_;
    out.recording.left_s = 1e-9 * static_cast<double>(ticks_.back().now_ns - now.now_ns);
    out.recording.ended = next_ == ticks_.size();
    if (next_ == 1)
      for (const Notice& notice : notices_) out.notices.push(notice, now.now_ns);
    return Status::ok;
  }

  Status write(const Tick&, const Inputs&, const Params&) { return Status::ok; }

 private:
  void read_files(const std::string& folder) {
    Files files(folder);
    const auto fill = [&](auto& series, const auto& log, auto read_log) {
      series = {};
      if (used(log)) series = read_log(log, files);
    };
    fill(imu_, d_.imu, read_imu);
    fill(gnss_, d_.gnss, read_gnss);
    fill(mag_, d_.mag, read_mag);
    fill(baro_, d_.baro, read_baro);
    fill(pitot_, d_.pitot, read_pitot);
    Meeting meeting;
    each([&](const auto& series) { meeting.with(series); });
  }

  template <class Use>
  void each(Use use) {
    use(imu_);
    use(gnss_);
    use(mag_);
    use(baro_);
    use(pitot_);
  }

  /// Flight time starts at the first sample of all sensors.
  void begin_at_zero() {
    std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
    each([&](const auto& s) {
      if (!s.at_ns.empty()) first_ns = std::min(first_ns, s.at_ns.front());
    });
    each([&](auto& s) {
      for (std::int64_t& at_ns : s.at_ns) at_ns -= first_ns;
      if (s.at_ns.empty()) return;
      refuse_early_end(s, d_.use);
      count(s.left_out, words_of(s));
    });
    report_cuts();
    if (d_.utc_at_zero_s == 0) return;
    for (std::size_t i = 0; i < gnss_.samples.size(); ++i)
      gnss_.samples[i].utc_ns = ns_of(d_.utc_at_zero_s) + gnss_.at_ns[i] - gnss_.delay_ns;
  }

  /// Reports each file that is cut off, with its last complete sample.
  void report_cuts() {
    std::map<std::string, std::pair<std::size_t, std::int64_t>> cuts;
    each([&](const auto& s) {
      if (s.cut_at == 0) return;
      auto& [at, last_ns] = cuts[s.path];
      at = s.cut_at;
      last_ns = std::max(last_ns, s.at_ns.back());
    });
    for (const auto& [path, cut] : cuts)
      notices_.push_back({{cut_words(path, cut.first, cut.second)}, Severity::warning});
  }

  void count(const LeftOut& left_out, const std::string& words) {
    counts_.not_finite += left_out.not_finite;
    counts_.out_of_range += left_out.out_of_range;
    counts_.out_of_order += left_out.out_of_order;
    if (left_out.all() > 0) notices_.push_back({{words}, Severity::warning});
  }

  void plan() {
    std::vector<Event> events;
    add(events, Sensor::imu, imu_, d_.imu.withhold);
    add(events, Sensor::gnss, gnss_, d_.gnss.withhold);
    add(events, Sensor::mag, mag_, d_.mag.withhold);
    add(events, Sensor::baro, baro_, d_.baro.withhold);
    add(events, Sensor::pitot, pitot_, d_.pitot.withhold);
    ticks_ = Planner().plan(std::move(events));
    if (ticks_.empty()) refuse("log.use", sensor_log_messages::use_empty());
  }

  template <class M, class Windows>
  void add(std::vector<Event>& events, Sensor sensor, const Series<M>& series, const Windows& withhold) {
    for (std::size_t i = 0; i < series.at_ns.size(); ++i) {
      const std::int64_t at_ns = series.at_ns[i];
      if (!within(std::array{d_.use}, at_ns)) continue;
      const bool withheld = within(withhold, at_ns);
      counts_.withheld += withheld ? 1 : 0;
      if (!withheld || sensor == Sensor::imu)
        events.push_back({at_ns, sensor, static_cast<std::uint32_t>(i), withheld});
    }
  }

  template <class M>
  static void show(Out<M>& out, const Series<M>& series, const PlannedTick& now, Sensor sensor) {
    const std::uint32_t i = now.sample[static_cast<std::size_t>(sensor)];
    if (i != nothing) out.publish(series.samples[i], series.at_ns[i] - series.delay_ns);
  }

  VehicleStatus status(std::int64_t now_ns) const {
    VehicleStatus s;
    s.armed = within(std::array{d_.armed}, now_ns);
    s.on_ground = !within(std::array{d_.airborne}, now_ns);
    s.override = true;
    return s;
  }

  Description d_;
  Series<Imu> imu_;
  Series<Gnss> gnss_;
  Series<Mag> mag_;
  Series<Baro> baro_;
  Series<Pitot> pitot_;
  std::vector<PlannedTick> ticks_;
  std::size_t next_ = 0;
  Recording counts_;
  std::vector<Notice> notices_;
};

}  // namespace fulmar::sensor_log
