// SPDX-License-Identifier: BSD-3-Clause
// See export_log.hpp. A file is written under the name FILE.part and renamed when it is complete.
#include "tools/fulmar_log/export_log.hpp"

#include <array>
#include <cstdio>

#include "core/error.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {

namespace fs = std::filesystem;

std::string seconds_text(std::int64_t ns) {
  const auto size =
      ns < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  std::array<char, 16> digits;
  std::snprintf(digits.data(), digits.size(), "%09llu",
                static_cast<unsigned long long>(size % 1'000'000'000));
  std::string fraction = digits.data();
  while (!fraction.empty() && fraction.back() == '0') fraction.pop_back();
  const std::string whole = (ns < 0 ? "-" : "") + std::to_string(size / 1'000'000'000);
  return fraction.empty() ? whole : whole + "." + fraction;
}

namespace {

/// Removes partial files of a failed export. Files that were complete stay.
void remove_parts(const Tables& tables, ExportForm form, const fs::path& out, bool own_folder) {
  std::error_code ignored;
  fs::remove(out.string() + ".part", ignored);
  if (form != ExportForm::csv) return;
  for (const Table& t : tables.list()) fs::remove(out / (t.name + ".csv.part"), ignored);
  if (own_folder && fs::is_empty(out, ignored)) fs::remove(out, ignored);
}

}  // namespace

ExportResult export_log(const fs::path& log, ExportForm form, fs::path out,
                        const std::vector<std::string>& topics) {
  const std::array<const char*, 3> endings{"-csv", ".npz", ".mat"};
  if (out.empty()) out = log.stem().string() + endings[static_cast<std::size_t>(form)];
  if (fs::exists(out) && (form != ExportForm::csv || !fs::is_directory(out)))
    throw Error(log_tool_messages::export_exists(out.string()));
  const Tables tables(log, topics);
  ExportResult result{out, {}, tables.left_out(), tables.fault()};
  for (const Table& t : tables.list())
    if (t.rows > 0) result.topics.push_back({t.topic, t.rows, t.columns.size() + 2});
  if (result.topics.empty()) {
    std::string why = tables.fault().empty() ? "" : "; " + tables.fault();
    if (!tables.left_out().empty()) why += "; " + tables.left_out().front();
    throw Error(log_tool_messages::exportable_message_missing(log.string(), why));
  }
  const bool own_folder = !fs::exists(out);
  try {
    if (form == ExportForm::csv) export_csv(tables, out);
    if (form == ExportForm::npz) export_npz(tables, out);
    if (form == ExportForm::mat) export_mat(tables, out);
  } catch (...) {
    remove_parts(tables, form, out, own_folder);
    throw;
  }
  return result;
}

}  // namespace fulmar::core
