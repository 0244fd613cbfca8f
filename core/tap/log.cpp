// SPDX-License-Identifier: BSD-3-Clause
// See log.hpp. One thread beside the loop's takes records from the ring, encodes them straight into the open chunk and writes chunks.
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
#include "core/tap/element.hpp"
#include "core/tap/mcap.hpp"
#include "core/tap/ring.hpp"
#include "core/tap/wire.hpp"

namespace fulmar::core {
namespace {

/// Numeric form: the only one that Humble reads, and later distributions do too. Reliable, volatile, keep last 10.
constexpr const char* qos_profiles =
    "- history: 1\n  depth: 10\n  reliability: 1\n  durability: 2\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false\n";

constexpr std::chrono::milliseconds nap{2};  // of the log's thread when the ring is empty; the loop never pays for waking it

/// The bytes of a message that carry something: all, or up to the last item of a list at its end.
struct Extent {
  std::uint32_t size = 0, count_at = 0, first_item = 0, stride = 0, capacity = 0;  // stride 0: no list at the end

  explicit Extent(const Type& type) : size(type.size) {
    const auto last =
        std::max_element(type.fields.begin(), type.fields.end(), [](const Field& a, const Field& b) { return a.offset < b.offset; });
    if (last == type.fields.end() || last->shape != FULMAR_LIST) return;
    count_at = last->offset;
    first_item = last->offset + last->items;
    stride = last->stride;
    capacity = last->count;
  }
  std::size_t of(const std::byte* data) const noexcept {
    if (stride == 0) return size;
    return first_item + std::size_t{stride} * std::min(load<std::uint32_t>(data + count_at), capacity);
  }
};

struct Extra {  // an attachment, or metadata when there is no media type
  std::string name, media_type, content;
  Pairs pairs;
};

}  // namespace

struct Log::Impl {
  struct Channel {
    Extent extent;
    std::uint64_t sequence = 0;  // counts dropped messages too: a reader sees the gap
  };
  struct Sink {
    CdrEncoder encoder;
    std::uint16_t id = 0;
  };

  Options options;
  std::vector<Channel> channels;  // the loop's
  std::vector<Sink> sinks;        // the log thread's
  std::size_t max_message = 0;
  std::unique_ptr<Ring> ring;
  std::unique_ptr<McapWriter> writer;
  bool begun = false;          // the loop has written
  std::int64_t waited_ns = 0;  // the loop's
  bool head_stored = false;    // the log thread has written what comes first
  std::mutex mutex;
  std::vector<Extra> head, tail;  // guarded
  std::atomic<std::uint64_t> ring_drops{0};
  std::atomic<bool> stop{false}, broken{false};
  std::uint64_t unstored = 0;  // the log thread's: messages that the writer was not even given
  McapWriter::Result result;
  std::thread thread;

  Impl(const Options& o, const std::vector<LogChannel>& list) : options(o) {
    std::size_t largest = 0;
    for (const LogChannel& c : list) {
      channels.push_back({Extent(*c.type)});
      sinks.push_back({CdrEncoder(*c.type)});
      largest = std::max<std::size_t>(largest, c.type->size);
      max_message = std::max(max_message, sinks.back().encoder.max_size());
    }
    ring = std::make_unique<Ring>(options.ring_bytes, largest);
    writer = std::make_unique<McapWriter>(McapWriter::Options{
        .file = options.file, .zstd_level = options.zstd_level, .max_message_bytes = max_message, .sync = !options.wait});
    add_channels(list);
    start();
  }

  void add_channels(const std::vector<LogChannel>& list) {
    std::map<std::pair<std::string, std::string>, std::uint16_t> schemas;  // by name and text
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Type& type = *list[i].type;
      const auto [at, is_new] = schemas.try_emplace({ros_name(type), ros_definition(type)});
      if (is_new) at->second = writer->add_schema(at->first.first, "ros2msg", at->first.second);
      sinks[i].id = writer->add_channel(at->second, list[i].topic, "cdr",
                                        {{"offered_qos_profiles", qos_profiles}, {"topic_type_hash", ros_type_hash(type)}});
    }
  }

  /// The thread takes no signal: they are for the main thread, and one for a file at its size limit comes back as an error of write.
  void start() {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread = std::thread([this] { run(); });
    pthread_setname_np(thread.native_handle(), "fulmar-log");
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  std::uint64_t time(std::int64_t flight_ns) const {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, options.epoch_ns + flight_ns));
  }

  void store_extras(std::vector<Extra>& list) {
    const std::lock_guard lock(mutex);
    for (const Extra& e : list) {
      if (e.media_type.empty()) {
        writer->metadata(e.name, e.pairs);
      } else {
        writer->attach(e.name, e.media_type, e.content, time(0));
      }
    }
    list.clear();
  }

  void store(const Ring::Record& record) {
    if (!head_stored) {
      head_stored = true;
      store_extras(head);
    }
    const Sink& sink = sinks[record.channel];
    std::byte* room =
        writer->begin_message(sink.id, static_cast<std::uint32_t>(record.sequence), time(record.log_ns), time(record.valid_ns));
    writer->end_message(sink.encoder.encode(record.data(), room));
  }

  /// Takes all that is in the ring. Whatever happens here, the ring is emptied: the flight goes on.
  void drain() noexcept {
    while (const Ring::Record* record = ring->next()) {
      if (writer->failed() || !guarded([&] { store(*record); })) ++unstored;
      ring->release();
    }
    if (writer->failed()) broken.store(true, std::memory_order_relaxed);
  }

  void run() noexcept {
    for (;;) {
      const bool last = stop.load(std::memory_order_acquire);
      drain();
      if (last) break;
      std::this_thread::sleep_for(nap);
    }
    guarded([this] {
      store_extras(head);
      store_extras(tail);
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
      writer->fail(std::string("the log ends early: ") + e.what());
      return false;
    }
  }
};

Log::Log(const Options& options, const std::vector<LogChannel>& channels) : impl_(std::make_unique<Impl>(options, channels)) {}

Log::~Log() {
  if (impl_->thread.joinable()) close();
}

void Log::attach(const std::string& name, const std::string& media_type, const std::string& content) {
  const std::lock_guard lock(impl_->mutex);
  (impl_->begun ? impl_->tail : impl_->head).push_back({name, media_type.empty() ? "application/octet-stream" : media_type, content, {}});
}

void Log::metadata(const std::string& name, const std::vector<std::pair<std::string, std::string>>& pairs) {
  const std::lock_guard lock(impl_->mutex);
  (impl_->begun ? impl_->tail : impl_->head).push_back({name, "", "", pairs});
}

void Log::write(std::size_t channel, std::int64_t log_ns, std::int64_t valid_ns, const std::byte* data) noexcept {
  Impl& log = *impl_;
  Impl::Channel& c = log.channels[channel];
  log.begun = true;
  const Ring::Record record{0, static_cast<std::uint32_t>(channel), c.sequence++, log_ns, valid_ns};
  const std::size_t size = c.extent.of(data);
  while (!log.ring->push(record, data, size)) {
    if (!log.options.wait) {
      log.ring_drops.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    log.ring->wait_for_room();
    log.waited_ns += std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin).count();
  }
}

std::int64_t Log::take_wait_ns() noexcept { return std::exchange(impl_->waited_ns, 0); }

std::uint64_t Log::dropped() const noexcept { return impl_->ring_drops.load(std::memory_order_relaxed); }

bool Log::failed() const noexcept { return impl_->broken.load(std::memory_order_relaxed); }

LogResult Log::close() {
  Impl& log = *impl_;
  log.stop.store(true, std::memory_order_release);
  log.thread.join();
  const McapWriter::Result& r = log.result;
  const std::uint64_t dropped = log.ring_drops.load() + log.unstored + r.lost;
  return {r.file, r.sha256, r.messages, r.bytes, dropped, r.error};
}

}  // namespace fulmar::core
