// SPDX-License-Identifier: BSD-3-Clause
// See recover.hpp. The log is read twice: attachments and metadata come first, then all messages in their
// order.
#include "tools/fulmar_log/recover.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "core/error.hpp"
#include "core/log/out_file.hpp"
#include "core/log/reader.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {

std::string Recovery::left_out_text() const {
  std::string text;
  const auto add = [&](std::uint64_t n, const std::string& what, const char* rest) {
    if (n > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + what + (n == 1 ? "" : "s") + rest;
  };
  add(left_out.chunks, "damaged chunk", "");
  add(left_out.attachments, "damaged attachment", "");
  add(left_out.metadata, "damaged record", " of metadata");
  add(left_out.others, "other damaged record", "");
  if (left_out.messages > 0)
    text += (text.empty() ? "" : ", ") + log_tool_messages::messages_without_topic(left_out.messages).line();
  return text;
}

Recovery recover_log(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (OutFile::grows(from)) throw Error(log_tool_messages::log_still_growing(from.string()));
  Salvage salvage(from), again(from);
  McapStream first(from, &salvage), second(from, &again);
  Recovery recovery = recover_log(first, second, to, from.string());
  recovery.left_out = salvage.left_out();
  return recovery;
}

Recovery recover_log(McapStream& first, McapStream& second, const std::filesystem::path& to,
                     const std::string& name) {
  std::size_t largest = 0;
  bool any = false;
  for (const McapFile::Message* m = first.next(); m; m = first.next(), any = true)
    largest = std::max(largest, m->data.size());
  const McapFile& log = first.log();
  if (!any && log.attachments.empty() && !log.complete)
    throw Error(located(name, log_tool_messages::log_not_recoverable(
                                  log.fault.empty() ? log_tool_messages::log_damaged().line() : log.fault)));
  McapWriter::Options options;
  options.file = to;
  options.profile = log.profile;
  options.library = log.library;
  options.max_message_bytes = largest;
  McapWriter out(options);

  for (const McapFile::Attachment& a : log.attachments) out.attach(a.name, a.media_type, a.content, a.log_ns);
  for (const McapFile::Metadata& m : log.metadata) out.metadata(m.name, m.pairs);
  std::map<std::uint16_t, std::uint16_t> schemas{{std::uint16_t{0}, std::uint16_t{0}}},
      channels;  // old id, new id
  for (const auto& [id, s] : log.schemas) schemas[id] = out.add_schema(s.name, s.encoding, s.text);
  for (const auto& [id, c] : log.channels) {
    const auto schema = schemas.find(c.schema);
    channels[id] = out.add_channel(schema == schemas.end() ? std::uint16_t{0} : schema->second, c.topic,
                                   c.encoding, c.metadata);
  }
  bool grows = false;
  while (const McapFile::Message* m = second.next()) {
    const auto channel = channels.find(m->channel);
    grows = channel == channels.end() ||
            m->data.size() > largest;  // new since the first reading: no room is reserved for it
    if (grows) break;
    std::byte* room = out.begin_message(channel->second, m->sequence, m->log_ns, m->publish_ns);
    if (!m->data.empty()) std::memcpy(room, m->data.data(), m->data.size());
    out.end_message(m->data.size());
  }
  Recovery r{
      out.close(), {}, grows ? log_tool_messages::log_grown().line() : log.fault, log.complete && !grows};
  std::error_code ignored;
  if (!r.written.error.empty()) std::filesystem::remove(r.written.file, ignored);
  return r;
}

McapWriter::Result recover_mcap(const std::filesystem::path& from, const std::filesystem::path& to) {
  return recover_log(from, to).written;
}

}  // namespace fulmar::core
