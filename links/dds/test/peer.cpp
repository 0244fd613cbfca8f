// SPDX-License-Identifier: BSD-3-Clause
// A remote program that behaves like rmw_fastrtps: plain Fast DDS and Fast CDR, without the code under test.
//
// dds_peer publish DOMAIN TOPIC TYPE reliable|best_effort RATE HEX...
//   to the first reader; RATE 0: all at once; HEX*1000 repeats, @FILE reads them
// dds_peer read DOMAIN TOPIC TYPE N
//   prints samples as hex, and the writer's user data
// dds_peer call DOMAIN SERVICE PKG/SRV HEX
//   prints the reply's body as hex
// dds_peer param DOMAIN NODE get|set|set_text|set_many|list|describe NAME [VALUE]
#include <fastcdr/Cdr.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace fd = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using Bytes = std::vector<unsigned char>;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

namespace {

constexpr auto patience = std::chrono::seconds(20);

struct Raw : fd::TopicDataType {
  explicit Raw(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 4096;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<Bytes*>(data);
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<unsigned>(bytes.size());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

struct Peer {
  fd::DomainParticipant* participant = nullptr;
  fd::Publisher* publisher = nullptr;
  fd::Subscriber* subscriber = nullptr;

  explicit Peer(int domain) {
    fd::DomainParticipantQos qos;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->maxInitialPeersRange = 32;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    rtps::Locator_t loopback;
    rtps::IPLocator::setIPv4(loopback, "127.0.0.1");
    qos.wire_protocol().builtin.initialPeersList.push_back(loopback);
    qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(loopback);
    participant =
        fd::DomainParticipantFactory::get_instance()->create_participant(static_cast<unsigned>(domain), qos);
    publisher = participant->create_publisher(fd::PUBLISHER_QOS_DEFAULT);
    subscriber = participant->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT);
  }
  ~Peer() {
    participant->delete_contained_entities();
    fd::DomainParticipantFactory::get_instance()->delete_participant(participant);
  }
  fd::Topic* topic(const std::string& name, const std::string& type) {
    fd::TypeSupport(new Raw(type)).register_type(participant);
    return participant->create_topic(name, type, fd::TOPIC_QOS_DEFAULT);
  }
  fd::DataWriter* writer(const std::string& name, const std::string& type, bool best_effort = false) {
    fd::DataWriterQos qos = fd::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = best_effort ? fd::BEST_EFFORT_RELIABILITY_QOS : fd::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = fd::VOLATILE_DURABILITY_QOS;
    qos.history().depth = 10;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    return publisher->create_datawriter(topic(name, type), qos);
  }
  fd::DataReader* reader(const std::string& name, const std::string& type, bool transient) {
    fd::DataReaderQos qos = fd::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = fd::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = transient ? fd::TRANSIENT_LOCAL_DURABILITY_QOS : fd::VOLATILE_DURABILITY_QOS;
    qos.history().depth = 10;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    return subscriber->create_datareader(topic(name, type), qos);
  }
};

template <class F>
bool wait_for(F&& f) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!f()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}
bool matched(fd::DataWriter* writer) {
  fd::PublicationMatchedStatus status;
  writer->get_publication_matched_status(status);
  return status.current_count > 0;
}
bool matched(fd::DataReader* reader) {
  fd::SubscriptionMatchedStatus status;
  reader->get_subscription_matched_status(status);
  return status.current_count > 0;
}

Bytes from_hex(const std::string& text) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes.push_back(static_cast<unsigned char>(std::stoi(text.substr(i, 2), nullptr, 16)));
  return bytes;
}
void print_hex(const Bytes& bytes, std::size_t from = 0) {
  for (std::size_t i = from; i < bytes.size(); ++i) std::printf("%02x", bytes[i]);
  std::printf("\n");
  std::fflush(stdout);
}

int publish(Peer& peer, std::vector<std::string> a) {
  if (a[4][0] == '@') {
    std::ifstream file(a[4].substr(1));
    a.pop_back();
    for (std::string line; std::getline(file, line);) a.push_back(line);
  }
  fd::DataWriter* writer = peer.writer(a[0], a[1], a[2] == "best_effort");
  if (!wait_for([&] { return matched(writer); })) {
    std::puts("no reader");
    return 1;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // the reader has to find this writer, too
  const double rate = std::stod(a[3]);
  auto due = std::chrono::steady_clock::now();
  for (std::size_t i = 4; i < a.size(); ++i) {
    const std::size_t star = a[i].find('*');
    Bytes bytes = from_hex(a[i].substr(0, star));
    const int times = star == std::string::npos ? 1 : std::stoi(a[i].substr(star + 1));
    for (int k = 0; k < times; ++k) {
      writer->write(&bytes);
      if (rate <= 0) continue;
      due += std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate));
      std::this_thread::sleep_until(due);
    }
  }
  std::puts("sent");
  std::fflush(stdout);
  writer->wait_for_acknowledgments({5, 0});
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  return 0;
}

int read(Peer& peer, const std::vector<std::string>& a) {
  fd::DataReader* reader = peer.reader(a[0], a[1], a.size() > 3);
  Bytes bytes;
  fd::SampleInfo info;
  for (int left = std::stoi(a[2]); left > 0;) {
    if (!wait_for([&] { return reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK; })) {
      std::puts("nothing");
      return 1;
    }
    if (info.valid_data) {
      print_hex(bytes);
      --left;
    }
  }
  return 0;
}

/// As rmw_send_request and rmw_take_response do it. Empty when there was no answer.
Bytes call(Peer& peer, const std::string& service, const std::string& type, Bytes request) {
  const std::size_t slash = type.find('/');
  const std::string base = type.substr(0, slash) + "::srv::dds_::" + type.substr(slash + 1);
  fd::DataReader* reader = peer.reader("rr/" + service + "Reply", base + "_Response_", false);
  fd::DataWriter* writer = peer.writer("rq/" + service + "Request", base + "_Request_");
  if (!wait_for([&] { return matched(writer) && matched(reader); })) {
    std::puts("no service");
    return Bytes{};
  }
  rtps::WriteParams params;
  params.related_sample_identity().writer_guid(reader->guid());
  writer->write(&request, params);
  const auto number = params.sample_identity().sequence_number();
  Bytes reply;
  fd::SampleInfo info;
  const bool done = wait_for([&] {
    if (reader->take_next_sample(&reply, &info) != ReturnCode_t::RETCODE_OK || !info.valid_data) return false;
    return info.related_sample_identity.writer_guid() == reader->guid() &&
           info.related_sample_identity.sequence_number() == number;
  });
  return done ? reply : (std::puts("no reply"), Bytes{});
}

// ---- parameters as rclcpp sends them

struct Out {
  FastBuffer buffer;
  Cdr cdr{buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR};
  Out() { cdr.serialize_encapsulation(); }
  Bytes bytes() {
    const auto* first = reinterpret_cast<unsigned char*>(buffer.getBuffer());
    return {first, first + cdr.getSerializedDataLength()};
  }
};

struct Value {
  uint8_t type = 0;
  bool boolean = false;
  int64_t integer = 0;
  double number = 0;
  std::string text;
  std::vector<uint8_t> bytes;
  std::vector<bool> booleans;
  std::vector<int64_t> integers;
  std::vector<double> numbers;
  std::vector<std::string> texts;
  void write(Cdr& cdr) const {
    cdr << type << boolean << integer << number << text << bytes << booleans << integers << numbers << texts;
  }
  void read(Cdr& cdr) {
    cdr >> type >> boolean >> integer >> number >> text >> bytes >> booleans >> integers >> numbers >> texts;
  }
  void print() const {
    std::printf("type %d %d %lld %.17g '%s' [", type, boolean, static_cast<long long>(integer), number,
                text.c_str());
    for (const double x : numbers) std::printf("%.17g ", x);
    std::printf("]\n");
  }
};

void describe(Cdr& cdr) {
  std::string name, description, constraints;
  uint8_t type = 0;
  bool read_only = false, dynamic = false;
  uint32_t ranges = 0;
  cdr >> name >> type >> description >> constraints >> read_only >> dynamic >> ranges;
  std::printf("%s type %d '%s' '%s' read_only %d", name.c_str(), type, description.c_str(),
              constraints.c_str(), read_only);
  for (uint32_t i = 0; i < ranges; ++i) {
    double from = 0, to = 0, step = 0;
    cdr >> from >> to >> step;
    std::printf(" %.17g to %.17g step %.17g", from, to, step);
  }
  cdr >> ranges;
  for (uint32_t i = 0; i < ranges; ++i) {
    int64_t from = 0, to = 0;
    uint64_t step = 0;
    cdr >> from >> to >> step;
    std::printf(" %lld to %lld step %llu", static_cast<long long>(from), static_cast<long long>(to),
                static_cast<unsigned long long>(step));
  }
  std::printf("\n");
}

void results(Cdr& cdr, uint32_t n) {
  for (uint32_t i = 0; i < n; ++i) {
    bool successful = false;
    std::string reason;
    cdr >> successful >> reason;
    std::printf("%s%s\n", successful ? "set" : "refused: ", reason.c_str());
  }
}

int param(Peer& peer, const std::vector<std::string>& a) {
  const std::string node = a[0], what = a[1];
  const bool sets = what.rfind("set", 0) == 0;
  Out out;
  std::string service = sets ? "set_parameters" : what + "_parameters",
              type = sets ? "SetParameters" : "GetParameters";
  if (what == "list") {
    type = "ListParameters";
    out.cdr << std::vector<std::string>{} << uint64_t{0};
  } else if (sets) {
    if (what == "set_many") {
      service += "_atomically";
      type += "Atomically";
    }
    out.cdr << static_cast<uint32_t>((a.size() - 2) / 2);
    for (std::size_t i = 2; i + 1 < a.size(); i += 2) {
      Value value;
      value.type = what == "set_text" ? 4 : 3;
      if (what == "set_text") {
        value.text = a[i + 1];
      } else {
        value.number = std::stod(a[i + 1]);
      }
      out.cdr << a[i];
      value.write(out.cdr);
    }
  } else {
    if (what == "describe") type = "DescribeParameters";
    out.cdr << std::vector<std::string>(a.begin() + 2, a.end());
  }
  Bytes reply = call(peer, node + "/" + service, "rcl_interfaces/" + type, out.bytes());
  if (reply.empty()) return 1;
  FastBuffer buffer(reinterpret_cast<char*>(reply.data()), reply.size());
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  cdr.read_encapsulation();
  uint32_t n = 1;
  if (what == "list") {
    std::vector<std::string> names;
    cdr >> names;
    for (const auto& name : names) std::printf("%s\n", name.c_str());
    return 0;
  }
  if (what != "set_many") cdr >> n;
  if (sets) {
    results(cdr, n);
    return 0;
  }
  for (uint32_t i = 0; i < n; ++i) {
    if (what == "describe") {
      describe(cdr);
    } else {
      Value value;
      value.read(cdr);
      value.print();
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::string what = argv[1];
  const std::vector<std::string> rest(argv + 3, argv + argc);
  Peer peer(std::stoi(argv[2]));
  if (what == "publish") return publish(peer, rest);
  if (what == "read") return read(peer, rest);
  if (what == "param") return param(peer, rest);
  if (what != "call") return 2;
  const Bytes reply = call(peer, rest[0], rest[1], from_hex(rest[2]));
  print_hex(reply, 4);
  return reply.empty();
}
