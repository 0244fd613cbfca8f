// SPDX-License-Identifier: BSD-3-Clause
#include "core/log/mcap_summary.hpp"

namespace fulmar::core::mcap {
namespace {

void append_statistics(Bytes& to, const std::vector<Schema>& schemas, const std::vector<Channel>& channels,
                       const Totals& file) {
  const std::size_t start = to.begin(statistics);
  Bytes counts;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  for (const Schema& s : schemas) schema_count = static_cast<std::uint16_t>(schema_count + s.stored);
  for (std::size_t id = 0; id < channels.size(); ++id) {
    if (!channels[id].stored) continue;
    ++channel_count;
    counts.number(static_cast<std::uint16_t>(id)).number(channels[id].messages);
  }
  to.number(file.messages).number(schema_count).number(channel_count);
  to.number(file.attachments).number(file.metadata_records).number(file.chunks);
  to.number(file.messages > 0 ? file.span.first : std::uint64_t{0}).number(file.span.last);
  to.number(static_cast<std::uint32_t>(counts.size())).append(counts);
  to.end(start);
}

}  // namespace

void write_summary(Bytes& block, const OutFile& out, const std::vector<Schema>& schemas,
                   const std::vector<Channel>& channels, const Totals& file) {
  block.record(data_end, [&] { block.number(out.crc()); });
  const std::size_t summary_start = block.size();

  Bytes offsets;
  std::size_t group = summary_start;
  const auto end_group = [&](Code code) {
    if (block.size() > group) {
      offsets.record(summary_offset, [&] {
        offsets.number(code).number(out.size() + group).number(std::uint64_t{block.size() - group});
      });
    }
    group = block.size();
  };
  for (std::size_t i = 0; i < schemas.size(); ++i) {
    if (schemas[i].stored) schemas[i].write(block, static_cast<std::uint16_t>(i + 1));
  }
  end_group(schema);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].stored) channels[i].write(block, static_cast<std::uint16_t>(i));
  }
  end_group(channel);
  append_statistics(block, schemas, channels, file);
  end_group(statistics);
  block.append(file.chunk_indexes);
  end_group(chunk_index);
  block.append(file.attachment_indexes);
  end_group(attachment_index);
  block.append(file.metadata_indexes);
  end_group(metadata_index);
  const std::size_t offset_start = block.size();
  block.append(offsets);

  const std::size_t start = block.begin(footer);
  block.number(std::uint64_t{out.size() + summary_start}).number(std::uint64_t{out.size() + offset_start});
  block.patch(start - 8, std::uint64_t{20});  // the checksum covers the footer up to itself, including its
                                              // length
  block.number(crc_of(0, {block.data() + summary_start, block.size() - summary_start}));
  block.raw(magic.data(), magic.size());
}

}  // namespace fulmar::core::mcap
