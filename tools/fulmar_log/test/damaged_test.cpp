// SPDX-License-Identifier: BSD-3-Clause
// For any bytes of a log, info, export, recover and diff give a result or an error, within the limit of
// memory.
#include <doctest/doctest.h>

#include <cstdlib>
#include <map>
#include <random>

#include "core/error.hpp"
#include "core/log/test/log_kit.hpp"
#include "core/log/test/read_mcap.hpp"
#include "tools/fulmar_log/diff.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/info.hpp"
#include "tools/fulmar_log/recover.hpp"

namespace damaged_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// Bytes flipped, cut off, lengths blown up, pieces doubled or missing.
std::string spoilt(std::string bytes, std::mt19937& random) {
  const auto place = [&](std::size_t room) {
    return random() % std::max<std::size_t>(1, bytes.size() - room);
  };
  switch (random() % 6) {
    case 0: bytes.resize(place(0)); break;
    case 1:
      for (auto n = 1 + random() % 20; n > 0; --n) bytes[place(1)] ^= static_cast<char>(1 + random() % 255);
      break;
    case 2: {  // a number with all bits, or nearly
      const std::uint64_t huge = ~std::uint64_t{0} >> random() % 64;
      std::memcpy(bytes.data() + place(8), &huge, random() % 2 == 0 ? 4 : 8);
      break;
    }
    case 3: bytes.erase(place(0), 1 + random() % 5000); break;
    case 4: bytes.insert(place(0), bytes.substr(place(0), 1 + random() % 5000)); break;
    default:  // the length of a record near the front
      bytes[8 + random() % 200] ^= static_cast<char>(1u << random() % 8);
  }
  return bytes;
}

/// Without the checksums of chunks and attachments the content itself is read.
McapWriter::Options plain(const std::filesystem::path& file) {
  return {.file = file, .zstd_level = 0, .chunk_bytes = 3000};
}

int tried = 0, refused = 0;

template <class F>
void attempt(F&& what) {
  ++tried;
  try {
    what();
  } catch (const Error& e) {
    ++refused;
    CHECK(std::string(e.what()).size() > 10);
  }
}

/// Sets the checksum of every chunk to 0, which means none.
std::string without_sums(std::string bytes) {
  for (std::size_t at = 8; at + 9 <= bytes.size() - 8;) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + at + 1, 8);
    if (bytes[at] == 6) std::memset(bytes.data() + at + 9 + 24, 0, 4);
    at += 9 + length;
  }
  return bytes;
}

}  // namespace

TEST_CASE("no damage to a log is worse than an error") {
  const Folder folder;
  write_sample({.file = folder.path / "whole.mcap"}, 300);
  write_sample(plain(folder.path / "plain.mcap"), 60);
  const std::string whole = contents(folder.path / "whole.mcap"),
                    open = without_sums(contents(folder.path / "plain.mcap"));
  std::mt19937 random(3);
  const int files = FULMAR_SANITIZED && std::getenv("FULMAR_LONG") == nullptr
                        ? 250
                        : 1000;  // a sanitizer takes ten times as long
  const std::filesystem::path bad = folder.path / "bad.mcap", out = folder.path / "out";
  for (int i = 0; i < files; ++i) {
    store(bad, spoilt(i % 2 == 0 ? whole : open, random));
    attempt([&] { read_info(bad); });
    attempt([&] { export_log(bad, ExportForm::csv, out / "csv", {}); });
    attempt([&] { export_log(bad, ExportForm::npz, out / "a.npz", {}); });
    attempt([&] { export_log(bad, ExportForm::mat, out / "a.mat", {}); });
    attempt([&] { recover_log(bad, out / "a.mcap"); });
    attempt([&] { diff_logs(bad, folder.path / "whole.mcap"); });
    std::filesystem::remove_all(out);
    std::filesystem::create_directory(out);
  }
  CHECK(tried == 6 * files);
  CHECK(refused > files / 10);
  CHECK(refused < tried);
}

TEST_CASE("a damaged chunk costs what is in it; the rest is recovered") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 4000);
  std::string bytes = contents(folder.path / "a.mcap");
  std::size_t chunks = 0;
  for (std::size_t at = 8; at + 9 < bytes.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + at + 1, 8);
    if (bytes[at] == 6 && ++chunks == 3) bytes[at + 9 + length / 2] ^= 0x10;
    if (bytes[at] == 15) break;
    at += 9 + length;
  }
  store(folder.path / "bad.mcap", bytes);
  const Recovery r = recover_log(folder.path / "bad.mcap", folder.path / "good.mcap");
  CHECK(r.written.error == "");
  CHECK(r.left_out.chunks == 1);
  CHECK_FALSE(r.was_whole);
  CHECK(r.written.messages == 5000 - 500);
  CHECK(read_info(folder.path / "good.mcap").file.complete);
  CHECK_FALSE(read_info(folder.path / "bad.mcap").file.complete);
}

namespace {

/// Ten chunks of a second each, two attachments, one metadata; with the places of its records by their kind.
struct Pieces {
  Folder folder;
  std::string bytes;
  std::map<int, std::vector<std::size_t>> places;
  std::vector<std::uint64_t> times_ns;

  Pieces() {
    Sample sample({.file = folder.path / "a.mcap"});
    sample.writer.attach("b.txt", "text/plain", std::string(500, 'b'), epoch_ns);
    const std::uint16_t x = sample.channel("/x", *number_type()), y = sample.channel("/y", *number_type());
    for (int i = 0; i < 1000; ++i) {
      sample.write(i % 2 == 0 ? x : y, i * 10'000'000LL, bytes_of(Number{1.5 * i}));
      times_ns.push_back(static_cast<std::uint64_t>(epoch_ns + i * 10'000'000LL));
    }
    sample.writer.close();
    bytes = contents(folder.path / "a.mcap");
    for (std::size_t at = 8; at + 9 < bytes.size();) {
      std::uint64_t length = 0;
      std::memcpy(&length, bytes.data() + at + 1, 8);
      places[bytes[at]].push_back(at);
      at += 9 + length;
    }
  }
  std::string flipped(int code, std::size_t n, std::size_t byte, int bit = 4) const {
    std::string bad = bytes;
    bad[places.at(code).at(n) + byte] ^= static_cast<char>(1 << bit);
    return bad;
  }
  std::string without_end(std::string bad) const { return bad.substr(0, places.at(15).at(0)); }

  /// Everything but this chunk is there, in order, each with its own value.
  Recovery check(const std::string& bad, int lost_chunk) {
    const std::filesystem::path file = folder.path / "bad.mcap", good = folder.path / "good.mcap";
    store(file, bad);
    std::filesystem::remove(good);
    const Recovery r = recover_log(file, good);
    CHECK(r.written.error == "");
    CHECK_FALSE(r.was_whole);
    const WholeLog log = read_mcap(good);
    CHECK(log.complete);
    std::vector<int> found, wanted;
    for (const McapFile::Message& m : log.messages) {
      Number n{};
      const std::string& topic = log.channels.at(m.channel).topic;
      CHECK(log.schemas.at(log.channels.at(m.channel).schema).text == ros_definition(*number_type()));
      cdr_decode(*number_type(), m.data.data(), m.data.size(), bytes_of(n));
      found.push_back(static_cast<int>(n.value_ratio / 1.5));
      CHECK(topic == (found.back() % 2 == 0 ? "/x" : "/y"));
      CHECK(m.log_ns == times_ns.at(static_cast<std::size_t>(found.back())));
    }
    for (int i = 0; i < 1000; ++i)
      if (i / 100 != lost_chunk) wanted.push_back(i);
    CHECK(found == wanted);
    CHECK(r.left_out.chunks == (lost_chunk < 0 ? 0 : 1));
    CHECK(r.left_out.messages == 0);
    CHECK(log.attachments.size() == 2 - r.left_out.attachments);
    CHECK(log.metadata.size() == 1 - r.left_out.metadata);
    return r;
  }
};

constexpr int chunk_code = 6, index_code = 7, attachment_code = 9, metadata_code = 12, head = 9;

}  // namespace

namespace {

/// Bytes that this process has read so far; 0 where the system does not count them.
std::uint64_t bytes_read() {
  std::ifstream in("/proc/self/io");
  std::string word;
  std::uint64_t n = 0;
  return in >> word >> n && word == "rchar:" ? n : 0;
}

}  // namespace

TEST_CASE("what lies behind gigabytes that were never written is recovered without reading them") {
  Pieces p;
  const std::size_t last = p.places.at(chunk_code).at(9);
  const std::string chunk = p.bytes.substr(last, p.places.at(index_code).back() - last);
  const std::filesystem::path file = p.folder.path / "sparse.mcap.part";
  constexpr std::uint64_t hole = std::uint64_t{5} << 30, max_read = 50'000'000;
  for (const bool behind : {false, true}) {
    CAPTURE(behind);
    store(file, p.bytes.substr(0, last + 40));
    std::filesystem::resize_file(file, hole);
    if (behind) std::ofstream(file, std::ios::binary | std::ios::app) << chunk;
    const std::uint64_t before = bytes_read();
    const Recovery r = recover_log(file, p.folder.path / "good.mcap");
    CHECK(bytes_read() - before < max_read);
    CHECK(r.left_out.chunks == 1);
    CHECK(r.written.messages == (behind ? 1000 : 900));
    std::filesystem::remove(p.folder.path / "good.mcap");
  }
}

TEST_CASE("one flipped bit costs the chunk or the attachment in which it is, and nothing else") {
  Pieces p;
  REQUIRE(p.places[chunk_code].size() == 10);
  REQUIRE(p.places[attachment_code].size() == 2);
  for (const std::size_t n : {0u, 1u, 9u}) {
    CAPTURE(n);
    const int chunk = static_cast<int>(n);
    CHECK(p.check(p.flipped(chunk_code, n, head + 100), chunk).left_out_text() == "1 damaged chunk");
    p.check(p.flipped(chunk_code, n, 0), chunk);          // its code
    p.check(p.flipped(chunk_code, n, head + 18), chunk);  // the size it unpacks to
    for (const std::size_t byte : {1u, 2u, 6u, 8u})
      p.check(p.flipped(chunk_code, n, byte), chunk);  // its length
    for (const std::size_t byte : {0u, 1u, 2u, 6u}) p.check(p.flipped(index_code, 2 * n, byte), -1);
  }
  CHECK(p.check(p.flipped(attachment_code, 1, head + 200), -1).left_out_text() == "1 damaged attachment");
  for (const std::size_t byte : {0u, 1u, 2u, 6u}) {
    CHECK(p.check(p.flipped(attachment_code, 0, byte), -1).left_out.attachments == 1);
    CHECK(p.check(p.flipped(metadata_code, 0, byte), -1).left_out.metadata == 1);
  }
}

TEST_CASE("without the summary at its end, too, a log is read on behind what is damaged") {
  Pieces p;
  for (const std::size_t n : {1u, 8u}) {
    const int chunk = static_cast<int>(n);
    p.check(p.without_end(p.flipped(chunk_code, n, head + 100)), chunk);
    for (const std::size_t byte : {1u, 2u, 6u}) p.check(p.without_end(p.flipped(chunk_code, n, byte)), chunk);
    for (const std::size_t byte : {1u, 2u, 6u})
      p.check(p.without_end(p.flipped(index_code, 2 * n, byte)), -1);
  }
  CHECK(p.check(p.without_end(p.flipped(attachment_code, 0, head + 30)), -1).left_out.attachments == 1);
  CHECK(p.check(p.without_end(p.flipped(attachment_code, 0, 2)), -1).left_out.attachments == 1);
  CHECK(p.check(p.without_end(p.flipped(index_code, 4, 2)), -1).left_out_text() == "1 other damaged record");
  // The topics stand in the first chunk alone.
  store(p.folder.path / "bad.mcap", p.without_end(p.flipped(chunk_code, 0, head + 100)));
  const Recovery r = recover_log(p.folder.path / "bad.mcap", p.folder.path / "rest.mcap");
  CHECK(r.written.messages == 0);
  CHECK(r.left_out_text() == "1 damaged chunk, log_tool.messages_without_topic(900)");
}

TEST_CASE("where nothing can be saved no file is made, nor of a log that is still being written") {
  const Folder folder;
  const std::filesystem::path bad = folder.path / "bad.mcap", good = folder.path / "good.mcap";
  write_sample({.file = folder.path / "a.mcap"}, 400);
  store(bad, contents(folder.path / "a.mcap").substr(0, 30) + std::string(5000, 'x'));
  CHECK_THROWS_WITH_AS(recover_log(bad, good), doctest::Contains("log_tool.log_not_recoverable(byte "),
                       Error);
  CHECK_FALSE(std::filesystem::exists(good));
  CHECK_FALSE(std::filesystem::exists(good.string() + ".part"));
  Sample open({.file = folder.path / "open.mcap"});
  CHECK_THROWS_WITH_AS(recover_log(folder.path / "open.mcap.part", good),
                       doctest::Contains("log_tool.log_still_growing("), Error);
  CHECK_FALSE(std::filesystem::exists(good.string() + ".part"));
}

TEST_CASE(
    "of a log that grows between its two readings the recovery ends at the first message that the first has "
    "not foreseen") {
  const Folder folder;
  const auto log = [&](const char* name, bool larger, bool channel) {
    Sample sample({.file = folder.path / name});
    const std::uint16_t x = sample.channel("/x", *number_type());
    for (int i = 0; i < 5; ++i) sample.write(x, i, bytes_of(Number{1.0 * i}));
    if (larger) {
      std::memset(sample.writer.begin_message(x, 5, 5, 5), 1, 100'000);
      sample.writer.end_message(100'000);
    }
    if (channel) sample.write(sample.channel("/y", *number_type()), 6, bytes_of(Number{6}));
    if (larger || channel) sample.write(x, 7, bytes_of(Number{7}));
    sample.writer.close();
    return folder.path / name;
  };
  const std::filesystem::path before = log("before.mcap", false, false);
  for (const auto& after : {log("larger.mcap", true, false), log("channel.mcap", false, true)}) {
    McapStream first(before), second(after);
    const Recovery r = recover_log(first, second, folder.path / ("recovered_" + after.filename().string()));
    CHECK(r.written.messages == 5);
    CHECK(r.fault == "log_tool.log_grown");
    CHECK_FALSE(r.was_whole);
    const WholeLog recovered = read_mcap(r.written.file);
    CHECK(recovered.complete);
    CHECK(recovered.messages.size() == 5);
  }
  McapStream first(before), second(before);
  CHECK(recover_log(first, second, folder.path / "recovered.mcap").was_whole);
}

TEST_CASE("schemas without end are not kept in memory") {
  const Folder folder;
  {
    std::ofstream out(folder.path / "a.mcap", std::ios::binary);
    const auto put = [&](auto value) { out.write(reinterpret_cast<const char*>(&value), sizeof value); };
    out.write("\x89MCAP0\r\n", 8);
    constexpr std::uint32_t text = 2u << 20;
    for (std::uint16_t id = 1; id <= 20; ++id) {  // the texts are holes in the file
      put('\3');
      put(std::uint64_t{2 + 4 + 4 + 4 + text});
      put(id);
      put(std::uint32_t{0});
      put(std::uint32_t{0});
      put(text);
      out.seekp(text, std::ios::cur);
    }
    put('\0');
  }
  McapStream stream(folder.path / "a.mcap");
  CHECK(stream.next() == nullptr);
  CHECK(stream.log().schemas.size() == 15);  // 16 of 2 MB and some bytes are more than 32 MB
  CHECK(stream.log().fault.ends_with(": log.schemas_too_large"));
}

}  // namespace damaged_test
