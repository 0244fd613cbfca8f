// SPDX-License-Identifier: BSD-3-Clause
// Clients, samples, status.
#include "links/live/hub.hpp"

#include <algorithm>
#include <random>

#include "links/live/hub_impl.hpp"
#include "links/live/messages.hpp"

namespace fulmar::core::live {
namespace {

using nlohmann::json;
using std::chrono::steady_clock;

constexpr std::size_t max_unanswered = 4096;
constexpr std::size_t max_refusals = 10;        // reported faults of one message
constexpr std::size_t samples_per_turn = 8192;  // then the messages of clients are read
constexpr std::chrono::milliseconds time_period{50};
constexpr std::chrono::seconds drops_period{1};
// A port that need not publish in every step but does: so many consecutive samples, each within this time
// after the previous one. No client needs each of them, so without subscribers the loop need not copy all.
constexpr std::size_t stream_samples = 400;
constexpr std::size_t owed_samples = 20;  // consecutive samples of a rare port
constexpr std::int64_t stream_gap_ns = 100'000'000;
// Without subscribers the loop copies a sample of a stream at a low rate: a paused simulation publishes
// nothing, and a client that connects then needs the present state. A sample older than `fresh_ns` is not the
// present state.
constexpr std::int64_t unseen_period_ns = 100'000'000, fresh_ns = 1'000'000'000;
constexpr char op_data = 1, op_time = 2;

std::shared_ptr<const std::string> shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

template <class T>
void put(char* to, T value) {
  std::memcpy(to, &value, sizeof value);
}

/// Distinguishes two runs on one port, so that a client that reconnects detects another flight.
std::string session_id() {
  std::random_device random;
  return std::to_string(random()) + std::to_string(random());
}

}  // namespace

Hub::Hub(Tap& tap, Control& control, Counters& counters) : tap_(tap), control_(control), counters_(counters) {
  begun_ = view();
  const FlightView& now = begun_;
  mission_ = now.mission;
  services_ = services_of(now);
  for (const std::string& name : parameter_names(now))
    if (find_parameter(now, name)->info.kind == FULMAR_STRING) parameters_.texts.insert(name);
  std::size_t largest = 0;
  for (const TapChannel& c : tap_.channels()) {
    channels_.push_back(
        {CdrEncoder(*c.type), {}, c.may_stay_silent || c.past > 0, std::max<std::size_t>(c.past, 1)});
    largest = std::max(largest, channels_.back().encoder.max_size());
  }
  feed_.scratch.resize(largest);
  const json info = {
      {"op", "serverInfo"},
      {"name", "Fulmar: " + now.mission},
      {"capabilities",
       {"clientPublish", "parameters", "parametersSubscribe", "services", "connectionGraph", "time"}},
      {"supportedEncodings", {"cdr", "json"}},
      {"metadata", {{"mission", now.mission}, {"io", now.io}, {"version", FULMAR_VERSION}}},
      {"sessionId", session_id()}};
  greeting_.info = shared(dumped(info));
  greeting_.advertisement = shared(dumped(advertise(tap_)));
  greeting_.service_list = shared(dumped(advertise_services(services_)));
}

Hub::~Hub() { close(); }

void Hub::begin(std::function<void()> wake) {
  mailbox_ = std::make_shared<Inbox<std::function<void()>>>(std::move(wake));
  feed_.cursor = std::make_unique<Tap::Cursor>(tap_);
  for (std::size_t i = 0; i < channels_.size(); ++i) want_unseen(i);
  control_.on_parameter([this, mailbox = mailbox_](const std::string& component, const std::string& param) {
    mailbox->put([this, name = component + "." + param] { parameters_.changed.insert(name); });
  });
}

void Hub::close() {
  if (mailbox_) mailbox_->close();
}

Hub::ClientId Hub::add(Peer& peer) {
  const ClientId id = next_id_++;
  Client& client = *clients_.emplace(id, std::make_unique<Client>()).first->second;
  client.id = id;
  client.peer = &peer;
  counters_.clients = clients_.size();
  if (clients_.size() == 1)
    for (std::size_t i = 0; i < channels_.size(); ++i) want_unseen(i);  // the clock, from now on
  for (const auto& message : {greeting_.info, greeting_.advertisement, greeting_.service_list})
    send_text(client, message);
  return id;
}

void Hub::remove(ClientId id) {
  Client* client = find(id);
  if (client == nullptr) return;
  while (!client->subscriptions.empty()) stop_listening(*client, client->subscriptions.begin()->first);
  clients_.erase(id);
  counters_.clients = clients_.size();
  if (clients_.empty())
    for (std::size_t i = 0; i < channels_.size(); ++i) want_unseen(i);
}

/// Requests the rate of a channel without subscribers.
void Hub::want_unseen(std::size_t index) {
  const Channel& channel = channels_[index];
  if (!channel.subscribers.empty()) return;
  const bool clock = tap_.channels()[index].topic == "/fulmar/ticks";  // every client needs the clock
  if (clock)
    feed_.cursor->want(index, clients_.empty() ? -1 : 0);
  else
    feed_.cursor->want(index, channel.seldom ? 0 : unseen_period_ns);
}

void Hub::stop_listening(Client& client, std::uint32_t subscription) {
  const auto at = client.subscriptions.find(subscription);
  Channel& channel = channels_[at->second];
  std::erase_if(channel.subscribers, [&](const auto& listener) { return listener.first == &client; });
  want_unseen(at->second);
  client.subscriptions.erase(at);
}

bool Hub::busy(ClientId id) const {
  const Client* client = find(id);
  return client != nullptr && client->unanswered >= max_unanswered;
}

Hub::Client* Hub::find(ClientId id) const {
  const auto at = clients_.find(id);
  return at == clients_.end() ? nullptr : at->second.get();
}

FlightView Hub::view() {
  FlightView now = control_.view();
  time_.epoch_ns = now.epoch_ns;
  return now;
}

// ---- from clients

template <class Work>
void Hub::guarded(ClientId id, const Work& work) {
  Client* client = find(id);
  if (client == nullptr) return;
  client->refusals = 0;
  try {
    work(*client);
    if (client->refusals > max_refusals) status(*client, 2, live_messages::more_refused());
  } catch (const Malformed& e) {
    refuse(*client, e.what());
    client->peer->close(1007, e.what());
  } catch (const json::exception& e) {
    std::string_view words = e.what();  // "[json.exception.type_error.302] type must be string"
    words.remove_prefix(std::min(words.find("] ") + 2, words.size()));
    refuse(*client, live_messages::op_form_invalid(words));
    client->peer->close(1007, "wrong types");
  } catch (const Error& e) {
    refuse(*client, e.what());
  } catch (const std::exception& e) {
    refuse(*client, e.what());
    client->peer->close(1011, "the server cannot go on with this client");
  }
}

void Hub::text(ClientId id, std::string_view message) {
  guarded(id, [&](Client& client) {
    if (json_too_deep(message)) throw Malformed("the JSON is nested too deeply");
    const json parsed = json::parse(message, nullptr, false);
    if (!parsed.is_object()) throw Malformed("a text message has to be a JSON object");
    const auto name = parsed.at("op").get<std::string>();
    const auto op = ops().find(name);
    if (op == ops().end()) {
      std::vector<std::string> words;
      for (const auto& [word, function] : ops()) words.push_back(word);
      throw Error(live_messages::op_unknown(name, choices_text(name, words)));
    }
    (this->*op->second)(client, parsed);
  });
}

void Hub::binary(ClientId id, std::string_view message) {
  guarded(id, [&](Client& client) {
    if (message.empty()) throw Malformed("a binary message is empty");
    switch (message[0]) {
      case 1: return client_data(client, message);
      case 2: return service_request(client, message);
      default: throw Error(live_messages::binary_op_unknown(static_cast<unsigned char>(message[0])));
    }
  });
}

// ---- to clients

void Hub::send_text(Client& client, std::shared_ptr<const std::string> text) {
  Message message;
  message.body = std::move(text);
  client.peer->send(std::move(message));
}

void Hub::send_json(Client& client, const json& message) { send_text(client, shared(dumped(message))); }

void Hub::status(Client& client, int level, const std::string& message) {
  send_json(client, {{"op", "status"}, {"level", level}, {"message", message}});
}

void Hub::refuse(Client& client, const std::string& why) {
  refuse(client, [&] { return why; });
}

void Hub::refuse(Client& client, const std::function<std::string()>& why) {
  ++counters_.refused;
  complain(client, why);
}

void Hub::complain(Client& client, const std::function<std::string()>& why) {
  if (++client.refusals <= max_refusals) status(client, 2, why());
}

bool Hub::reported_enough(const Client& client) { return client.refusals >= max_refusals; }

void Hub::answers() {
  for (const auto& task : mailbox_->take()) task();
}

bool Hub::tick() {
  answers();
  if (!feed_.cursor) return false;
  const bool more = drain();
  flush_parameters();
  warn_of_drops();
  return more;
}

bool Hub::drain() {
  Message message;
  std::size_t count = 0;
  const Tap::Sample* sample = nullptr;
  while (count < samples_per_turn && (sample = feed_.cursor->next()) != nullptr) {
    ++count;
    time_.newest_ns = sample->now_ns;
    time_.known = true;
    Channel& channel = channels_[sample->channel];
    if (!channel.subscribers.empty()) encode(channel, sample->data(), message);
    for (const auto& [client, subscription] : channel.subscribers)
      give(*client, message, subscription, sample->now_ns, owed(channel));
    keep(*sample);
  }
  counters_.lost += feed_.cursor->lost() - std::exchange(feed_.lost_before, feed_.cursor->lost());
  if (count > 0) send_time();
  return count == samples_per_turn;
}

/// Reads the ring up to the loop's position.
void Hub::catch_up() {
  const std::uint64_t here = tap_.written();
  while (feed_.cursor->read() < here && drain()) {
  }
}

bool Hub::owed(const Channel& channel) { return channel.seldom && channel.in_a_row < owed_samples; }

/// A slow client loses samples of a stream. A rare sample is always sent: a crash is published once.
void Hub::give(Client& client, Message& message, std::uint32_t subscription, std::int64_t now_ns, bool owed) {
  message.binary = true;
  message.head_size = message.head.size();
  message.head[0] = op_data;
  put(&message.head[1], subscription);
  put(&message.head[5], static_cast<std::uint64_t>(std::max<std::int64_t>(0, time_.epoch_ns + now_ns)));
  if (owed) client.peer->send(message);
  if (owed || client.peer->offer(message)) {
    ++counters_.sent;
  } else {
    ++client.dropped;
    ++counters_.dropped;
  }
}

void Hub::encode(Channel& channel, const std::byte* data, Message& message) {
  const std::size_t size = channel.encoder.encode(data, feed_.scratch.data());
  message.body = shared(std::string(reinterpret_cast<const char*>(feed_.scratch.data()), size));
}

void Hub::keep(const Tap::Sample& sample) {
  Channel& channel = channels_[sample.channel];
  const TapChannel& tapped = tap_.channels()[sample.channel];
  std::deque<Kept>& past = channel.past;
  const bool soon = !past.empty() && sample.now_ns - past.back().now_ns <= stream_gap_ns;
  channel.in_a_row = soon ? channel.in_a_row + 1 : 0;
  if (past.size() == channel.max_past) {
    past.push_back(std::move(past.front()));
    past.pop_front();
  } else
    past.emplace_back();
  past.back().now_ns = sample.now_ns;
  past.back().data.assign(sample.data(), sample.data() + tapped.type->size);
  if (!channel.seldom || tapped.past > 0 || channel.in_a_row < stream_samples) return;
  channel.seldom = false;
  want_unseen(sample.channel);
}

/// Sends stored samples to a new subscriber. A stream needs none, because its next sample comes soon, unless
/// the flight is paused.
void Hub::give_past(Client& client, std::size_t index, std::uint32_t subscription, bool paused) {
  Channel& channel = channels_[index];
  for (const Kept& kept : channel.past) {
    const bool holds = channel.seldom || (paused && time_.newest_ns - kept.now_ns <= fresh_ns);
    if (!holds) continue;
    Message sample;
    encode(channel, kept.data.data(), sample);
    give(client, sample, subscription, kept.now_ns, owed(channel));
  }
}

void Hub::send_time() {
  const auto now = steady_clock::now();
  if (!time_.known || now - time_.sent < time_period) return;
  time_.sent = now;
  Message message;
  message.binary = true;
  message.head_size = 9;
  message.head[0] = op_time;
  message.body = shared("");
  put(&message.head[1],
      static_cast<std::uint64_t>(std::max<std::int64_t>(0, time_.epoch_ns + time_.newest_ns)));
  for (const auto& [id, client] : clients_) client->peer->offer(message);
}

void Hub::warn_of_drops() {
  const auto now = steady_clock::now();
  if (now - feed_.loss_reported < drops_period) return;
  feed_.loss_reported = now;
  for (const auto& [id, client] : clients_) {
    if (client->dropped == client->reported) continue;
    status(*client, 1, live_messages::client_too_slow(client->dropped));
    client->reported = client->dropped;
  }
}

/// Sends current values to the clients that have set them, and to those that watch them.
void Hub::flush_parameters() {
  if (parameters_.replies.empty() && parameters_.changed.empty()) return;
  const FlightView now = view();
  for (const std::shared_ptr<Pending>& reply : std::exchange(parameters_.replies, {})) {
    Client* client = find(reply->client);
    if (client == nullptr) continue;
    json values = json::array();
    for (const std::string& name : reply->names) {
      const ParameterView* p = find_parameter(now, name);
      if (p == nullptr) continue;
      values.push_back(parameter_json(name, *p));
      if (p->overlaid) status(*client, 1, live_messages::parameter_overlaid(name, now.phase.now));
    }
    if (reply->id)
      send_json(*client, {{"op", "parameterValues"}, {"parameters", values}, {"id", *reply->id}});
  }
  const std::set<std::string> changed = std::exchange(parameters_.changed, {});
  for (const auto& [id, client] : clients_) {
    json values = json::array();
    for (const std::string& name : changed) {
      const ParameterView* p = client->watched.contains(name) ? find_parameter(now, name) : nullptr;
      if (p != nullptr) values.push_back(parameter_json(name, *p));
    }
    if (!values.empty()) send_json(*client, {{"op", "parameterValues"}, {"parameters", values}});
  }
}

}  // namespace fulmar::core::live
