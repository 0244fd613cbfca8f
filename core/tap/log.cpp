// SPDX-License-Identifier: BSD-3-Clause
// The log's thread takes samples from the tap, encodes them straight into the open chunk and writes chunks.
#include "core/tap/log.hpp"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/log/mcap.hpp"
#include "core/tap/messages.hpp"
#include "core/tap/tap.hpp"
#include "core/types/wire.hpp"
#include "fulmar/quiet_thread.hpp"

namespace fulmar::core {
namespace {

/// Numeric form: the only one that Humble reads, and later distributions also accept. Reliable, volatile,
/// keep last 10.
constexpr const char* qos_profiles =
    "- history: 1\n  depth: 10\n  reliability: 1\n  durability: 2\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false\n";

constexpr std::chrono::milliseconds nap{
    2};  // sleep of the log's thread when the ring is empty; the loop never has the cost of a wake-up

struct Extra {  // an attachment, or metadata when there is no media type
  std::string name, media_type, content;
  Pairs pairs;
};

}  // namespace

struct Log::Impl {
  struct Channel {
    CdrEncoder encoder;
    std::uint16_t id = 0;
    bool stored = true;
    std::uint64_t expected = 0;  // the sequence of its next sample: a gap counts lost samples
  };

  Options options;
  const Tap& tap;
  const std::uint64_t begin;  // bytes written to the tap before this log began
  Tap::Cursor cursor;
  std::vector<Channel> channels;
  std::size_t max_message = 0;
  std::unique_ptr<McapWriter> writer;
  bool head_stored = false;  // the log thread has written `head`
  struct {
    std::mutex mutex;
    std::vector<Extra> head, tail;  // guarded by the mutex
  } extras;
  std::atomic<bool> stop{false}, broken{false};
  std::string trouble;  // written once, before `broken` is set
  struct {
    std::uint64_t unstored = 0;  // not passed to the writer
    std::uint64_t missed = 0;    // overwritten before they were read
  } lost;                        // messages
  McapWriter::Result result;
  std::thread thread;

  Impl(const Options& o, Tap& from)
      : options(o), tap(from), begin(tap.written()), cursor(from, true, o.wait) {
    for (std::size_t i = 0; i < tap.channels().size(); ++i) {
      channels.push_back(
          {CdrEncoder(*tap.channels()[i].type), 0, options.channels.empty() || options.channels[i]});
      if (channels.back().stored) max_message = std::max(max_message, channels.back().encoder.max_size());
    }
    writer = std::make_unique<McapWriter>(McapWriter::Options{.file = options.file,
                                                              .held = options.held,
                                                              .zstd_level = options.zstd_level,
                                                              .max_message_bytes = max_message,
                                                              .sync = !options.wait});
    add_channels(tap.channels());
    start();
  }

  bool begun() const { return tap.written() != begin; }

  void add_channels(const std::vector<TapChannel>& list) {
    std::map<std::pair<std::string, std::string>, std::uint16_t> schemas;  // by name and text
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!channels[i].stored) continue;
      const Type& type = *list[i].type;
      const auto [at, is_new] = schemas.try_emplace({ros_name(type), ros_definition(type)});
      if (is_new) at->second = writer->add_schema(at->first.first, "ros2msg", at->first.second);
      channels[i].id = writer->add_channel(
          at->second, list[i].topic, "cdr",
          {{"offered_qos_profiles", qos_profiles}, {"topic_type_hash", ros_type_hash(type)}});
    }
  }

  void start() {
    thread = quiet_thread("fulmar-log", [this] { run(); });
  }

  std::uint64_t time(std::int64_t flight_ns) const {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, options.epoch_ns + flight_ns));
  }

  void store_extras(std::vector<Extra>& list) {
    const std::lock_guard lock(extras.mutex);
    for (const Extra& e : list) {
      if (e.media_type.empty()) {
        writer->metadata(e.name, e.pairs);
      } else {
        writer->attach(e.name, e.media_type, e.content, time(0));
      }
    }
    list.clear();
  }

  void store(const Tap::Sample& sample) {
    if (!head_stored) {
      head_stored = true;
      store_extras(extras.head);
    }
    const Channel& channel = channels[sample.channel];
    std::byte* room = writer->begin_message(channel.id, static_cast<std::uint32_t>(sample.sequence),
                                            time(sample.now_ns), time(sample.valid_ns));
    writer->end_message(channel.encoder.encode(sample.data(), room));
  }

  /// Takes all available samples. Continues after every fault: an unpaced flight waits for it.
  void drain() noexcept {
    while (const Tap::Sample* sample = cursor.next()) {
      Channel& channel = channels[sample->channel];
      if (!sample->for_log || !channel.stored) continue;
      lost.missed += sample->sequence - channel.expected;
      channel.expected = sample->sequence + 1;
      if (writer->failed() || !guarded([&] { store(*sample); })) ++lost.unstored;
    }
    if (!writer->failed() || broken.load(std::memory_order_relaxed)) return;
    guarded([this] { trouble = writer->error(); });
    broken.store(true, std::memory_order_release);
  }

  void run() noexcept {
    for (;;) {
      const bool last = stop.load(std::memory_order_acquire);
      drain();
      if (last) break;
      std::this_thread::sleep_for(nap);
    }
    guarded([this] {
      store_extras(extras.head);
      store_extras(extras.tail);
    });
    result.error = "the log could not be ended";
    guarded([this] { result = writer->close(); });
  }

  template <class F>
  bool guarded(F&& f) noexcept {
    try {
      f();
      return true;
    } catch (const std::exception& e) {
      writer->fail(tap_messages::log_ends_early(e.what()));
      return false;
    }
  }
};

Log::Log(const Options& options, Tap& tap) : impl_(std::make_unique<Impl>(options, tap)) {}

Log::~Log() {
  if (impl_->thread.joinable()) close();
}

void Log::attach(const std::string& name, const std::string& media_type, const std::string& content) {
  const std::lock_guard lock(impl_->extras.mutex);
  (impl_->begun() ? impl_->extras.tail : impl_->extras.head)
      .push_back({name, media_type.empty() ? "application/octet-stream" : media_type, content, {}});
}

void Log::metadata(const std::string& name, const std::vector<std::pair<std::string, std::string>>& pairs) {
  const std::lock_guard lock(impl_->extras.mutex);
  (impl_->begun() ? impl_->extras.tail : impl_->extras.head).push_back({name, "", "", pairs});
}

bool Log::failed() const noexcept { return impl_->broken.load(std::memory_order_acquire); }

const std::string& Log::error() const noexcept { return impl_->trouble; }

LogResult Log::close() {
  Impl& log = *impl_;
  log.stop.store(true, std::memory_order_release);
  log.thread.join();
  const McapWriter::Result& r = log.result;
  const std::uint64_t dropped = log.lost.missed + log.lost.unstored + r.lost;
  return {r.file, r.sha256, r.messages, r.bytes, dropped, r.error};
}

}  // namespace fulmar::core
