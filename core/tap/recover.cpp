// SPDX-License-Identifier: BSD-3-Clause
// See recover.hpp. Attachments and metadata come first, then all messages in their order.
#include "core/tap/recover.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "core/error.hpp"
#include "core/tap/reader.hpp"

namespace fulmar::core {

McapWriter::Result recover_mcap(const std::filesystem::path& from, const std::filesystem::path& to) {
  const McapFile file = read_mcap(from);
  std::size_t largest = 0;
  for (const McapFile::Message& m : file.messages) largest = std::max(largest, m.data.size());
  McapWriter::Options options;
  options.file = to;
  options.profile = file.profile;
  options.library = file.library;
  options.max_message_bytes = largest;
  McapWriter out(options);

  for (const McapFile::Attachment& a : file.attachments) out.attach(a.name, a.media_type, a.content, a.log_ns);
  for (const McapFile::Metadata& m : file.metadata) out.metadata(m.name, m.pairs);
  std::map<std::uint16_t, std::uint16_t> schemas{{std::uint16_t{0}, std::uint16_t{0}}}, channels;  // old id, new id
  for (const auto& [id, s] : file.schemas) schemas[id] = out.add_schema(s.name, s.encoding, s.text);
  for (const auto& [id, c] : file.channels) channels[id] = out.add_channel(schemas.at(c.schema), c.topic, c.encoding, c.metadata);
  for (const McapFile::Message& m : file.messages) {
    std::byte* room = out.begin_message(channels.at(m.channel), m.sequence, m.log_ns, m.publish_ns);
    std::memcpy(room, m.data.data(), m.data.size());
    out.end_message(m.data.size());
  }
  return out.close();
}

}  // namespace fulmar::core
