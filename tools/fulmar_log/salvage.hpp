// SPDX-License-Identifier: BSD-3-Clause
// Continues the reading of a damaged log: damaged parts are left out. The next chunk, attachment or metadata
// is found by the summary, else by a search.
#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/log/mcap_bytes.hpp"
#include "core/log/reader.hpp"

namespace fulmar::core {

/// Parts that a salvage has left out.
struct LeftOut {
  std::uint32_t chunks = 0, attachments = 0, metadata = 0;  // damaged ones
  std::uint32_t others = 0;                                 // records of unknown type
  std::uint64_t messages = 0;  // messages of a channel that only a damaged chunk defines
};

/// State of one reading of one file.
class Salvage : public McapSalvage {
 public:
  explicit Salvage(const std::filesystem::path& file);
  ~Salvage();
  Salvage(const Salvage&) = delete;
  Salvage& operator=(const Salvage&) = delete;
  void check_head(std::uint64_t place, std::uint8_t code, std::uint64_t length) override;
  void check_whole(std::uint64_t place, std::uint8_t code, std::uint64_t length) override;
  std::uint64_t go_on(std::uint64_t place, std::uint8_t code, std::uint64_t behind) override;
  void lost_message() override { ++left_out_.messages; }
  const LeftOut& left_out() const { return left_out_; }

 private:
  void read_summary();
  void name_place(std::uint8_t code, mcap::Cursor of);
  std::uint64_t next_stored(std::uint64_t at) const;
  std::uint64_t next_place(std::uint64_t place);
  bool begins_record(mcap::Data head, std::uint64_t at);
  std::uint64_t length_within(std::uint8_t code);
  std::uint64_t pass_text();
  template <class T>
  T number_here();
  void seek(std::uint64_t to);
  void read(std::byte* to, std::uint64_t bytes);

  std::ifstream in_;
  int holes_ = -1;  // the same file, for queries of its holes
  std::uint64_t size_ = 0, place_ = 0;
  std::map<std::uint64_t, std::uint8_t> named_;  // places in the summary, and their record types
  LeftOut left_out_;
};

}  // namespace fulmar::core
