// SPDX-License-Identifier: BSD-3-Clause
// The only file that includes Fast DDS. Names and user data are those of rmw_fastrtps and rmw_dds_common.
#include "links/dds/participant.hpp"

#include <arpa/inet.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>
#include <ifaddrs.h>

#include <algorithm>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "links/dds/messages.hpp"

namespace fulmar::core::dds {
namespace {

namespace fd = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

// Range of participants on one host that are searched without multicast; equal to that of rmw_fastrtps.
constexpr std::uint32_t participants_per_host = 32;
constexpr std::size_t writers_remembered = 256;

Guid guid_of(const rtps::GUID_t& from) {
  Guid guid;
  std::copy_n(from.guidPrefix.value, 12, guid.begin());
  std::copy_n(from.entityId.value, 4, guid.begin() + 12);
  return guid;
}
rtps::GUID_t guid_of(const Guid& from) {
  rtps::GUID_t guid;
  std::copy_n(from.begin(), 12, guid.guidPrefix.value);
  std::copy_n(from.begin() + 12, 4, guid.entityId.value);
  return guid;
}

/// Samples are CDR bytes, header included: they are copied unchanged.
struct RawType : fd::TopicDataType {
  RawType(const std::string& name, std::size_t max_bytes) {
    setName(name.c_str());
    m_typeSize = static_cast<std::uint32_t>(max_bytes);
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const std::span<const std::byte>*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    const auto* first = reinterpret_cast<const std::byte*>(payload->data);
    static_cast<Bytes*>(data)->assign(first, first + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] {
      return static_cast<std::uint32_t>(static_cast<const std::span<const std::byte>*>(data)->size());
    };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

/// Remote endpoints that match a local one.
class Matched {
 public:
  template <class Status>
  void note(const Status& status, const rtps::InstanceHandle_t& other) {
    const std::lock_guard lock(mutex_);
    const Guid guid = guid_of(rtps::iHandle2GUID(other));
    if (status.current_count_change > 0) guids_.insert(guid);
    if (status.current_count_change < 0) guids_.erase(guid);
  }
  bool contains(const Guid& guid) const {
    const std::lock_guard lock(mutex_);
    return guids_.contains(guid);
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return guids_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::set<Guid> guids_;
};

struct RawWriter : Writer, fd::DataWriterListener {
  fd::Publisher& publisher;
  Matched matched;
  fd::DataWriter* writer = nullptr;

  explicit RawWriter(fd::Publisher& p) : publisher(p) {}
  ~RawWriter() override {
    if (writer != nullptr) publisher.delete_datawriter(writer);
  }
  Guid guid() const override { return guid_of(writer->guid()); }
  bool write(std::span<const std::byte> bytes) override { return writer->write(&bytes); }
  bool reply(std::span<const std::byte> bytes, const Identity& request) override {
    rtps::WriteParams params;
    params.related_sample_identity().writer_guid(guid_of(request.guid));
    params.related_sample_identity().sequence_number(rtps::SequenceNumber_t(request.sequence));
    return writer->write(&bytes, params);
  }
  bool reaches(const Guid& reader) const override { return matched.contains(reader); }
  std::size_t readers() const override { return matched.size(); }
  void on_publication_matched(fd::DataWriter*, const fd::PublicationMatchedStatus& status) override {
    matched.note(status, status.last_subscription_handle);
  }
  void forget() override {
    std::size_t removed = 0;
    writer->clear_history(&removed);
  }
};

struct RawReader : Reader, fd::DataReaderListener {
  fd::Subscriber& subscriber;
  Waker& waker;
  Matched matched;
  fd::DataReader* reader = nullptr;
  Bytes bytes;
  std::map<Guid, std::uint64_t> last;  // sequence number per writer
  std::uint64_t missing = 0;

  RawReader(fd::Subscriber& s, Waker& w) : subscriber(s), waker(w) {}
  ~RawReader() override {
    if (reader != nullptr) subscriber.delete_datareader(reader);
  }
  Guid guid() const override { return guid_of(reader->guid()); }
  std::uint64_t lost() const override { return missing; }
  bool hears(const Guid& writer) const override { return matched.contains(writer); }
  void on_data_available(fd::DataReader*) override { waker.wake(); }
  void on_subscription_matched(fd::DataReader*, const fd::SubscriptionMatchedStatus& status) override {
    matched.note(status, status.last_publication_handle);
  }

  std::size_t take(std::size_t most, const std::function<void(const Sample&)>& use) override {
    fd::SampleInfo info;
    for (std::size_t n = 0; n < most; ++n) {
      if (reader->take_next_sample(&bytes, &info) != ReturnCode_t::RETCODE_OK) return n;
      if (!info.valid_data) continue;
      Sample sample;
      sample.bytes = bytes;
      sample.from = {guid_of(info.sample_identity.writer_guid()),
                     info.sample_identity.sequence_number().to64long()};
      sample.answer_to = guid_of(info.related_sample_identity.writer_guid());
      sample.written_ns = info.source_timestamp.to_ns();
      count(sample.from);
      use(sample);
    }
    return most;
  }

  /// A sample that a reader of bounded depth has dropped leaves a gap in the writer's sequence numbers.
  void count(const Identity& from) {
    if (last.size() >= writers_remembered && !last.contains(from.guid)) last.clear();
    const auto [at, is_new] = last.try_emplace(from.guid, from.sequence);
    if (!is_new && from.sequence > at->second + 1) missing += from.sequence - at->second - 1;
    at->second = from.sequence;
  }
};

template <class Qos>
void set_qos(Qos& qos, const Endpoint& e) {
  qos.reliability().kind = e.best_effort ? fd::BEST_EFFORT_RELIABILITY_QOS : fd::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      e.transient_local ? fd::TRANSIENT_LOCAL_DURABILITY_QOS : fd::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fd::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = e.depth;
  qos.resource_limits().max_samples = e.depth * 2;
  qos.resource_limits().max_instances = 1;
  qos.resource_limits().max_samples_per_instance = e.depth * 2;
  qos.resource_limits().allocated_samples = e.depth;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  const std::string user = e.type_hash.empty() ? "" : "typehash=" + e.type_hash + ";";
  qos.user_data().data_vec({user.begin(), user.end()});
}

rtps::Locator_t locator(const std::string& address) {
  rtps::Locator_t l;
  if (!rtps::IPLocator::setIPv4(l, address) || !rtps::IPLocator::isIPv4(address))
    throw Error(dds_messages::address_invalid(address));
  l.port = 0;  // the default ports of the domain
  return l;
}

/// Fast DDS ignores an address that this computer does not have, and then receives nothing.
void check_own(const std::string& address, const Where& where) {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return;
  std::vector<std::string> own;
  for (const ifaddrs* a = first; a; a = a->ifa_next) {
    char text[INET_ADDRSTRLEN];
    if (!a->ifa_addr || a->ifa_addr->sa_family != AF_INET) continue;
    if (::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(a->ifa_addr)->sin_addr, text, sizeof text))
      own.emplace_back(text);
  }
  ::freeifaddrs(first);
  if (address.starts_with("127.") || std::find(own.begin(), own.end(), address) != own.end()) return;
  throw Error(
      dds_messages::interface_unknown(where.file.empty() ? "" : where.text() + ": ", address, join(own)));
}

/// One transport, bound to the given addresses; discovery by unicast alone.
fd::DomainParticipantQos participant_qos(const DdsOptions& options) {
  fd::DomainParticipantQos qos;
  const std::vector<std::string> own =
      options.interfaces.empty() ? std::vector<std::string>{"127.0.0.1"} : options.interfaces;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = own;
  udp->maxInitialPeersRange = participants_per_host;
  udp->non_blocking_send = true;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  for (const std::string& address : own) {
    const auto here = locator(address);
    check_own(address, options.interfaces_where);
    qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(here);
    qos.wire_protocol().default_unicast_locator_list.push_back(here);
  }
  for (const std::string& address : options.peers.empty() ? own : options.peers)
    qos.wire_protocol().builtin.initialPeersList.push_back(locator(address));
  const std::string enclave = "enclave=/;";
  qos.user_data().data_vec({enclave.begin(), enclave.end()});
  qos.name("fulmar");
  return qos;
}

}  // namespace

struct Participant::Impl : fd::DomainParticipantListener {
  Found found;
  fd::DomainParticipant* participant = nullptr;
  fd::Publisher* publisher = nullptr;
  fd::Subscriber* subscriber = nullptr;
  std::map<std::string, fd::Topic*> topics;

  void on_publisher_discovery(fd::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override {
    if (info.status == rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) report(info.info, true);
  }
  void on_subscriber_discovery(fd::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) override {
    if (info.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER) report(info.info, false);
  }
  void report(const auto& other, bool writer) const {
    found(other.topicName().to_string(), other.typeName().to_string(), writer,
          other.m_qos.m_reliability.kind == fd::BEST_EFFORT_RELIABILITY_QOS);
  }

  fd::Topic* topic(const Endpoint& e) {
    const auto at = topics.find(e.topic);
    if (at != topics.end()) {
      if (at->second->get_type_name() != e.type)
        throw Error(dds_messages::topic_type_differs(e.topic, at->second->get_type_name(), e.type));
      return at->second;
    }
    if (participant->find_type(e.type).empty())
      fd::TypeSupport(new RawType(e.type, e.max_bytes)).register_type(participant);
    fd::Topic* made = participant->create_topic(e.topic, e.type, fd::TOPIC_QOS_DEFAULT);
    if (made == nullptr) throw Error(dds_messages::topic_not_created(e.topic));
    return topics[e.topic] = made;
  }
};

Participant::Participant(const DdsOptions& options, Found found) : impl_(std::make_unique<Impl>()) {
  constexpr int highest_domain = 232;  // its ports are the last ones below 65536
  if (options.domain < 0 || options.domain > highest_domain)
    throw Error(dds_messages::domain_out_of_range(options.domain, highest_domain));
  impl_->found = std::move(found);
  const fd::DomainParticipantQos qos = participant_qos(options);
  impl_->participant = fd::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(options.domain), qos, impl_.get(), fd::StatusMask::none());
  if (impl_->participant == nullptr)
    throw Error(dds_messages::participant_not_created(
        options.domain, options.interfaces.empty() ? "127.0.0.1" : join(options.interfaces)));
  impl_->publisher = impl_->participant->create_publisher(fd::PUBLISHER_QOS_DEFAULT);
  impl_->subscriber = impl_->participant->create_subscriber(fd::SUBSCRIBER_QOS_DEFAULT);
}

Participant::~Participant() {
  if (impl_->participant == nullptr) return;
  impl_->participant->set_listener(nullptr);
  impl_->participant->delete_contained_entities();
  fd::DomainParticipantFactory::get_instance()->delete_participant(impl_->participant);
}

Guid Participant::guid() const { return guid_of(impl_->participant->guid()); }

std::unique_ptr<Writer> Participant::writer(const Endpoint& endpoint) {
  auto writer = std::make_unique<RawWriter>(*impl_->publisher);
  fd::DataWriterQos qos = fd::DATAWRITER_QOS_DEFAULT;
  set_qos(qos, endpoint);
  qos.publish_mode().kind = fd::ASYNCHRONOUS_PUBLISH_MODE;
  qos.representation().m_value.push_back(fd::XCDR_DATA_REPRESENTATION);
  fd::Topic* topic = impl_->topic(endpoint);
  writer->writer =
      impl_->publisher->create_datawriter(topic, qos, writer.get(), fd::StatusMask::publication_matched());
  if (writer->writer == nullptr) throw Error(dds_messages::writer_not_created(endpoint.topic));
  return writer;
}

std::unique_ptr<Reader> Participant::reader(const Endpoint& endpoint, Waker& waker) {
  auto reader = std::make_unique<RawReader>(*impl_->subscriber, waker);
  fd::DataReaderQos qos = fd::DATAREADER_QOS_DEFAULT;
  set_qos(qos, endpoint);
  fd::Topic* topic = impl_->topic(endpoint);
  reader->reader = impl_->subscriber->create_datareader(
      topic, qos, reader.get(), fd::StatusMask::data_available() << fd::StatusMask::subscription_matched());
  if (reader->reader == nullptr) throw Error(dds_messages::reader_not_created(endpoint.topic));
  return reader;
}

std::string dds_type(const std::string& ros_name) {
  std::string name;
  std::size_t from = 0;
  for (std::size_t slash = ros_name.find('/'); slash != std::string::npos; slash = ros_name.find('/', from)) {
    name += ros_name.substr(from, slash - from) + "::";
    from = slash + 1;
  }
  return name + "dds_::" + ros_name.substr(from) + "_";
}

std::string dds_topic(const std::string& prefix, const std::string& name_space, const std::string& name) {
  std::string topic = prefix;
  for (const std::string& part : {name_space, name}) {
    const std::size_t first = part.find_first_not_of('/');
    if (first != std::string::npos) topic += "/" + part.substr(first, part.find_last_not_of('/') + 1 - first);
  }
  return topic;
}

}  // namespace fulmar::core::dds
