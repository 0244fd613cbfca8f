// SPDX-License-Identifier: BSD-3-Clause
// The live protocol without sockets: subscriptions, requests and messages of clients. Source: the Foxglove
// WebSocket protocol, version 1. One thread, except for the answers of the control, which come through a
// mailbox.
#pragma once
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/inbox.hpp"
#include "core/tap/control.hpp"
#include "core/tap/tap.hpp"
#include "core/types/wire.hpp"
#include "links/live/describe.hpp"
#include "links/live/saving.hpp"
#include "links/live/stats.hpp"

namespace fulmar::core::live {

/// One message to a client: its own head, and bytes that all clients share.
struct Message {
  std::array<char, 13> head{};
  std::size_t head_size = 0;
  std::shared_ptr<const std::string> body;
  bool binary = false;
  std::size_t size() const { return head_size + body->size(); }
};

/// A client's connection. None of these functions calls the hub.
class Peer {
 public:
  virtual ~Peer() = default;
  /// Data. Returns false when the client is behind; the message is then dropped.
  virtual bool offer(const Message& message) = 0;
  /// Any other message, and rare data. A client that is too far behind is closed.
  virtual void send(Message message) = 0;
  virtual void close(std::uint16_t code, const std::string& why) = 0;
};

struct Counters {
  std::atomic<std::uint64_t> clients{0}, sent{0}, dropped{0}, lost{0}, refused{0}, wrong_tokens{0};
};

class Hub {
 public:
  Hub(Tap& tap, Control& control, Counters& counters);
  ~Hub();
  /// Call once, before the first client. Threads of the control call `wake` when there is something for
  /// `answers`.
  void begin(std::function<void()> wake);
  /// `wake` is not called after this.
  void close();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  using ClientId = std::uint64_t;
  ClientId add(Peer& peer);
  void remove(ClientId id);
  std::size_t clients() const { return clients_.size(); }
  void text(ClientId id, std::string_view message);
  void binary(ClientId id, std::string_view message);
  /// Whether the client has too many unanswered requests to read more from it.
  bool busy(ClientId id) const;

  /// Handles the content of the mailbox.
  void answers();
  /// Sends samples and changed parameters. Call it every few ms while there are clients, else at a low rate.
  /// Returns true when there is more to send.
  bool tick();

  const std::string& mission() const { return mission_; }

 private:
  struct Client;
  struct Import;
  struct Pending;
  struct Kept {
    std::int64_t now_ns;
    std::vector<std::byte> data;  // a struct of the channel's type
  };
  struct Channel {
    CdrEncoder encoder;
    std::vector<std::pair<Client*, std::uint32_t>> subscribers;  // clients and their subscriptions
    bool seldom = false;       // rarely published: every sample must be delivered, and the last one stays
                               // valid
    std::size_t max_past = 1;  // number of last samples that are kept for later subscribers
    std::size_t in_a_row = 0;  // samples that followed the previous one closely
    std::deque<Kept> past{};   // oldest first
  };
  using json = nlohmann::json;
  using Op = void (Hub::*)(Client&, const json&);
  static const std::map<std::string, Op, std::less<>>& ops();

  // operations of clients
  void subscribe(Client& client, const json& message);
  void unsubscribe(Client& client, const json& message);
  void client_advertise(Client& client, const json& message);
  void client_unadvertise(Client& client, const json& message);
  void get_parameters(Client& client, const json& message);
  void set_parameters(Client& client, const json& message);
  void subscribe_parameters(Client& client, const json& message);
  void unsubscribe_parameters(Client& client, const json& message);
  void subscribe_graph(Client& client, const json& message);
  void unsubscribe_graph(Client& client, const json& message);
  void client_data(Client& client, std::string_view message);
  void service_request(Client& client, std::string_view message);

  void import_channel(Client& client, const json& channel);
  void call(Client& client, const Service& service, std::uint32_t service_id, std::uint32_t call_id,
            bool as_json, std::string_view payload);
  void call_request(const Service& service, bool as_json, std::string_view payload, Control::Answer answer);
  void call_save(Client& client, const std::vector<std::string>& texts,
                 std::function<void(const std::string&)> reply, bool as_json);
  void call_record(Client& client, const std::vector<std::string>& texts,
                   const std::function<void(const std::string&)>& reply, bool as_json);
  void call_host(const Service& service, const std::vector<std::string>& texts, Control::Answer answer);
  void set_one(Client& asker, const std::shared_ptr<Pending>& pending, const json& parameter);

  FlightView view();
  void stop_listening(Client& client, std::uint32_t subscription);
  bool drain();
  void catch_up();
  void keep(const Tap::Sample& sample);
  void give_past(Client& client, std::size_t index, std::uint32_t subscription, bool paused);
  void encode(Channel& channel, const std::byte* data, Message& message);
  static bool owed(const Channel& channel);
  void give(Client& client, Message& message, std::uint32_t subscription, std::int64_t now_ns, bool owed);
  void send_time();
  void want_unseen(std::size_t index);
  void flush_parameters();
  void warn_of_drops();

  Client* find(ClientId id) const;
  void send_text(Client& client, std::shared_ptr<const std::string> text);
  void send_json(Client& client, const json& message);
  void status(Client& client, int level, const std::string& message);
  /// Reports a fault to the client, followed by `hint()`. At most ten faults of one message are reported:
  /// further ones do not help, and hints cost time of the other clients.
  void complain(Client& client, const std::function<std::string()>& why);
  /// The same; counts as a violation of the rules.
  void refuse(Client& client, const std::string& why);
  /// `why` is evaluated only for faults that are sent.
  void refuse(Client& client, const std::function<std::string()>& why);
  void refuse_parameter(Client& client, const std::string& name, const std::vector<std::string>& known);
  static bool reported_enough(const Client& client);
  template <class Work>
  void guarded(ClientId id, const Work& work);

  Tap& tap_;
  Control& control_;
  Counters& counters_;
  std::shared_ptr<Inbox<std::function<void()>>> mailbox_;  // from other threads to the hub's thread
  std::string mission_;
  FlightView begun_;  // the flight's state at its start
  struct {
    std::int64_t epoch_ns = 0, newest_ns = 0;
    bool known = false;
    std::chrono::steady_clock::time_point sent{};
  } time_;
  std::vector<Service> services_;
  struct {
    std::set<std::string> texts;  // parameters whose value is a text: "40 deg" is no number for them
    std::set<std::string> changed;
    std::vector<std::shared_ptr<Pending>> replies;  // completed setParameters operations
  } parameters_;
  std::vector<Channel> channels_;
  struct {
    std::shared_ptr<const std::string> info, advertisement, service_list;
  } greeting_;  // for a new client
  struct {
    // open from `begin` on: rare samples are kept before there is a client
    std::unique_ptr<Tap::Cursor> cursor;
    std::uint64_t lost_before = 0;  // losses of the cursor that the counters already include
    std::chrono::steady_clock::time_point loss_reported{};
    std::vector<std::byte> scratch;
  } feed_;
  std::map<ClientId, std::unique_ptr<Client>> clients_;
  ClientId next_id_ = 1;
  Saving saving_;
};

}  // namespace fulmar::core::live
