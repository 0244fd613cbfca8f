// SPDX-License-Identifier: BSD-3-Clause
#include "link.hpp"

#include <poll.h>
#include <sched.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "fulmar/quiet_thread.hpp"
#include "imu_signal.hpp"
#include "link_figures.hpp"
#include "outbox.hpp"
#include "port.hpp"
#include "spsc_queue.hpp"
#include "timesync.hpp"
#include "watch_list.hpp"

namespace fulmar::fcu {
namespace {

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

constexpr std::int64_t heartbeat_ns = 1'000'000'000, question_ns = 100'000'000;  // host time
constexpr int read_ms = 5, reopen_ms = 100;                                      // real time
constexpr std::size_t kept_for_events = 64;

}  // namespace

struct Link::Impl {
  explicit Impl(const LinkOptions& wanted) : options(wanted), watched(wanted.watched) {}

  // ---- either thread
  const LinkOptions options;
  const std::int64_t start_ns = monotonic_ns();
  std::atomic<bool> stop{false};
  std::atomic<std::uint8_t> sequence{0};
  std::atomic<int> descriptor{-1};
  std::atomic<pid_t> loop_thread{0};
  SpscQueue<Received, 4096> queue;
  ImuSignal imu;
  Outbox outbox;
  LinkFigures figures;  // written by the thread of the link

  // ---- thread of the loop
  std::uint32_t imu_taken = 0;

  // ---- thread of the link
  std::unique_ptr<Port> port;
  Parser parser;
  Dater dater;
  WatchList watched;
  std::int64_t next_heartbeat_ns = 0, next_question_ns = 0, last_arrival_ns = 0;
  int own_policy = SCHED_OTHER, own_priority = 0;
  cpu_set_t own_cpus{};
  std::uint32_t imu_put = 0;       ///< since the last signal to the loop
  std::uint8_t target_system = 1;  ///< parameter SYS_ID of the controller, which accepts no other
  std::thread thread;

  std::int64_t now_ns() const noexcept {
    const std::int64_t elapsed = monotonic_ns() - start_ns;
    return options.time_scale == 1 ? elapsed
                                   : std::llround(static_cast<double>(elapsed) * options.time_scale);
  }
  std::int64_t on_the_wall(std::int64_t host_ns) const noexcept {
    return start_ns + (options.time_scale == 1
                           ? host_ns
                           : std::llround(static_cast<double>(host_ns) / options.time_scale));
  }

  void begin();
  void stay_with_loop() noexcept;
  void run();
  void serve();
  void reopen();
  void connected();
  void take_bytes(std::span<const std::uint8_t> bytes);
  void take(const Packet& packet, std::int64_t arrived_ns);
  std::int64_t date(const Packet& packet, std::int64_t arrived_ns);
  void time_answered(const Timesync& answer, std::int64_t arrived_ns);
  void rebooted(std::int64_t now);
  void put_event(LinkEvent event, std::int64_t now);
  void do_duties(std::int64_t now);
  template <class M>
  bool send(const M& message) {
    return outbox.send_own(encode(message, sequence.fetch_add(1, std::memory_order_relaxed)));
  }
};

// ---- thread of the link

void Link::Impl::begin() {
  thread = quiet_thread("fulmar-fcu", [this] { run(); });
}

void Link::Impl::run() {
  sched_getaffinity(0, sizeof own_cpus, &own_cpus);
  while (!stop.load(std::memory_order_relaxed)) {
    if (port == nullptr) {
      reopen();
      continue;
    }
    try {
      serve();
    } catch (const PortError&) {
      descriptor.store(-1);
      outbox.attach(nullptr);
      port.reset();
      put_event(LinkEvent::disconnected, now_ns());
    }
  }
}

void Link::Impl::serve() {
  std::array<std::uint8_t, 4096> room;
  while (!stop.load(std::memory_order_relaxed)) {
    if (const std::size_t n = port->read(room, read_ms); n > 0) take_bytes({room.data(), n});
    do_duties(now_ns());
  }
}

void Link::Impl::reopen() {
  for (int waited = 0; waited < reopen_ms && !stop.load(std::memory_order_relaxed); waited += 10)
    poll(nullptr, 0, 10);
  if (stop.load(std::memory_order_relaxed)) return;
  try {
    port = Port::open(options.port, options.baud);
  } catch (const PortError&) {
    return;  // not yet
  }
  connected();
}

void Link::Impl::connected() {
  const std::int64_t now = now_ns();
  parser.restart();
  dater.clock.forget_questions();
  watched.restart();
  next_heartbeat_ns = next_question_ns = now;
  outbox.attach(port.get());
  descriptor.store(port->descriptor());
  figures.connected();
  put_event(LinkEvent::connected, now);
}

void Link::Impl::take_bytes(std::span<const std::uint8_t> came) {
  const std::int64_t now = now_ns();
  parser.feed(came, [&](const Packet& packet) { take(packet, now); });
  figures.came(came);
  figures.counted(parser.counts(), dater.undated());
  // once per read: the loop then finds all samples that arrived together
  if (imu_put > 0) imu.raise(imu_put);
  imu_put = 0;
}

void Link::Impl::take(const Packet& packet, std::int64_t arrived_ns) {
  arrived_ns = last_arrival_ns = std::max(arrived_ns, last_arrival_ns + 1);
  figures.heard(arrived_ns);
  if (packet.is<SmallImu>() || packet.is<Heartbeat>())
    target_system = packet.system;  // ids of other packets are not reliable
  if (packet.is<SmallImu>() && dater.started_anew(packet.as<SmallImu>().time_boot_us)) {
    dater.clock.restart();
    rebooted(arrived_ns);
  }
  if (packet.is<Timesync>()) time_answered(packet.as<Timesync>(), arrived_ns);
  if (packet.is<ParamValue>()) watched.answered(text(packet.as<ParamValue>().param_id));
  const Received received{LinkEvent::packet, arrived_ns, date(packet, arrived_ns), packet};
  if (!queue.push(received, kept_for_events))
    figures.lost();
  else if (packet.is<SmallImu>())
    ++imu_put;
}

/// ATTITUDE, OUTPUT_RAW and RC have stamps of 1 ms. A packet without a stamp gets its time of arrival.
std::int64_t Link::Impl::date(const Packet& packet, std::int64_t arrived_ns) {
  switch (packet.id) {
    case SmallImu::id: return dater.date_imu(packet.as<SmallImu>().time_boot_us, arrived_ns);
    case AttitudeQuaternion::id:
      return dater.date_ms32(packet.as<AttitudeQuaternion>().time_boot_ms, arrived_ns);
    case RcChannels::id: return dater.date_ms32(packet.as<RcChannels>().time_boot_ms, arrived_ns);
    case RosflightOutputRaw::id: return dater.date_ms(packet.as<RosflightOutputRaw>().stamp, arrived_ns);
    case RosflightGnss::id: return dater.date_us(packet.as<RosflightGnss>().rosflight_timestamp, arrived_ns);
    default: return arrived_ns;
  }
}

void Link::Impl::time_answered(const Timesync& answer, std::int64_t arrived_ns) {
  if (dater.answered(answer.ts1, answer.tc1, arrived_ns) == ClockSync::Verdict::jumped) rebooted(arrived_ns);
  if (dater.clock.synchronised()) figures.timed(dater.clock, arrived_ns);
}

void Link::Impl::rebooted(std::int64_t now) {
  figures.rebooted(dater.clock.synchronised());
  watched.restart();
  next_heartbeat_ns = next_question_ns = now;  // the controller keeps its texts until it receives a heartbeat
  put_event(LinkEvent::rebooted, now);
}

void Link::Impl::put_event(LinkEvent event, std::int64_t now) {
  Received received;
  received.event = event;
  received.arrived_ns = received.valid_at_ns = last_arrival_ns = std::max(now, last_arrival_ns + 1);
  if (!queue.push(received)) figures.lost();
}

void Link::Impl::do_duties(std::int64_t now) {
  if (now >= next_heartbeat_ns) {
    send(Heartbeat{});
    next_heartbeat_ns = now + heartbeat_ns;
  }
  if (now >= next_question_ns) {
    const std::int64_t asked = now_ns();
    dater.clock.asked(asked);
    send(Timesync{0, asked});
    next_question_ns = now + question_ns;
    stay_with_loop();
  }
  for (std::string_view name = watched.next(now); !name.empty(); name = watched.next(now)) {
    ParamRequestRead request;
    request.target_system = target_system;
    request.param_id = field<16>(name);
    send(request);
  }
}

/// The loop waits for this thread, so it gets the policy and priority of the loop. When the loop stays on one
/// CPU, it gets that CPU too: to hand a sample over is then a switch of threads, and no other CPU must wake
/// up. The policy is read from the kernel repeatedly, because a host may set it at any time and the thread
/// library caches the first value.
void Link::Impl::stay_with_loop() noexcept {
  const pid_t loop = loop_thread.load(std::memory_order_relaxed);
  sched_param priority{};
  const int policy = loop == 0 ? -1 : sched_getscheduler(loop);
  if (policy >= 0 && sched_getparam(loop, &priority) == 0 &&
      (policy != own_policy || priority.sched_priority != own_priority))
    if (sched_setscheduler(0, policy, &priority) == 0) {
      own_policy = policy;
      own_priority = priority.sched_priority;
    }
  cpu_set_t cpus;
  if (policy < 0 || sched_getaffinity(loop, sizeof cpus, &cpus) != 0 || CPU_EQUAL(&cpus, &own_cpus)) return;
  if (sched_setaffinity(0, sizeof cpus, &cpus) == 0) own_cpus = cpus;
}

// ---- thread of the loop

Link::Link(const LinkOptions& options) : impl_(std::make_unique<Impl>(options)) {
  impl_->port = Port::open(options.port, options.baud);
  impl_->connected();
  impl_->begin();
}

Link::~Link() {
  impl_->stop.store(true);
  impl_->thread.join();
}

bool Link::wait_imu(std::int64_t until_ns) noexcept {
  if (impl_->loop_thread.load(std::memory_order_relaxed) == 0)
    impl_->loop_thread.store(gettid(), std::memory_order_relaxed);
  return impl_->imu.wait(impl_->imu_taken, impl_->on_the_wall(until_ns));
}

bool Link::pop(Received& out) noexcept {
  if (!impl_->queue.pop(out)) return false;
  if (out.event == LinkEvent::packet && out.packet.is<SmallImu>()) ++impl_->imu_taken;
  return true;
}

bool Link::send_frame(const Frame& frame) noexcept { return impl_->outbox.send(frame); }
std::uint8_t Link::next_sequence() noexcept {
  return impl_->sequence.fetch_add(1, std::memory_order_relaxed);
}
std::int64_t Link::now_ns() const noexcept { return impl_->now_ns(); }
int Link::descriptor() const noexcept { return impl_->descriptor.load(); }

LinkState Link::state() const noexcept {
  LinkState s = impl_->figures.read();
  s.open = impl_->descriptor.load() >= 0;
  return s;
}

}  // namespace fulmar::fcu
