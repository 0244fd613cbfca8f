// SPDX-License-Identifier: BSD-3-Clause
// One CSV file per topic. Source: RFC 4180, lines end in LF. Numbers read back without a change.
#include <algorithm>
#include <fstream>
#include <memory>

#include "core/error.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_bytes = 1u << 18;
constexpr std::size_t max_open = 200;  // files at a time; more topics need further readings

std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string s = "\"";
  for (const char c : text) s.append(c == '"' ? 2 : 1, c);
  return s + "\"";
}

/// One file, written in large pieces.
struct Csv {
  fs::path name;
  std::ofstream out;
  std::string buffer;

  Csv(const fs::path& folder, const Table& table) : name(folder / (table.name + ".csv")) {
    if (fs::exists(name)) throw Error(log_tool_messages::export_exists(name.string()));
    out.open(name.string() + ".part", std::ios::binary | std::ios::trunc);
    if (!out) throw Error(log_tool_messages::file_not_writable(name.string()));
    buffer = "time_s,valid_s";
    for (const Column& c : table.columns) {
      buffer += "," + csv_text(c.name);
      if (!c.field->labels.empty()) buffer += "," + csv_text(c.name + ".label");
    }
    buffer += "\n";
  }
  void row(const Table& table, const Tables::Row& row) {
    buffer += seconds_text(row.time_ns) + "," + seconds_text(row.valid_ns);
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const Cell& cell = (*row.cells)[i];
      const RosField& field = *table.columns[i].field;
      const bool absent_text = cell.kind == Cell::Kind::none && field.kind == FULMAR_TEXT;
      buffer += ',';
      if (!absent_text) buffer += cell.kind == Cell::Kind::text ? csv_text(cell.text) : cell_text(cell);
      if (field.labels.empty()) continue;
      buffer += ',';
      buffer += cell_label(field, cell);
    }
    buffer += '\n';
    if (buffer.size() > buffer_bytes) flush();
  }
  void flush() {
    if (!out.write(buffer.data(), static_cast<std::streamsize>(buffer.size())))
      throw Error(log_tool_messages::disk_write_failed(name.string()));
    buffer.clear();
  }
  void finish() {
    flush();
    out.close();
    if (!out) throw Error(log_tool_messages::disk_write_failed(name.string()));
    fs::rename(name.string() + ".part", name);
  }
};

}  // namespace

void export_csv(const Tables& tables, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(log_tool_messages::folder_not_creatable(folder.string(), error.message()));
  const std::vector<Table>& list = tables.list();
  for (std::size_t first = 0; first < list.size(); first += max_open) {
    std::vector<std::unique_ptr<Csv>> files(list.size());
    for (std::size_t i = first; i < std::min(list.size(), first + max_open); ++i)
      if (list[i].rows > 0) files[i] = std::make_unique<Csv>(folder, list[i]);
    tables.rows([&](std::size_t i) { return files[i] != nullptr; },
                [&](const Tables::Row& row) { files[row.table]->row(list[row.table], row); });
    for (const auto& file : files)
      if (file) file->finish();
  }
}

}  // namespace fulmar::core
