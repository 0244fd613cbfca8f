// SPDX-License-Identifier: BSD-3-Clause
// See compare_text.hpp.
#include "tools/fulmar_log/compare_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/quantities.hpp"
#include "tools/fulmar_log/terminal.hpp"

namespace fulmar::states {
namespace {

using core::printable;
using core::seconds;
using nlohmann::json;
constexpr std::size_t max_name = 20;

std::string name_of(const std::string& name) { return printable(name.substr(0, max_name)); }

std::string head_of(const Side& side, const std::string& name, const Judged& judged) {
  std::string out = fmt::format("{:<8} {} of {}: {} samples", name, printable(side.topic),
                                printable(side.log->file.filename().string()), judged.samples);
  if (judged.samples > 0)
    out += fmt::format(", {:.1f} s to {:.1f} s", seconds(judged.first_ns), seconds(judged.last_ns));
  out += "\n";
  if (judged.not_finite > 0)
    out += fmt::format("  {} hold what is no number, which is left out\n", judged.not_finite);
  if (judged.not_new > 0)
    out += fmt::format("  {} more are not later than the one before: left out\n", judged.not_new);
  if (!side.log->fault.empty()) out += fmt::format("  its log is cut off: {}\n", printable(side.log->fault));
  return out;
}

std::string difference_rows(const Pair& p) {
  const Comparison& c = p.made;
  if (c.pairs == 0) return "\nAt no time are both there: nothing can be compared.\n";
  std::string out =
      fmt::format("\n{:<26} {:>10} {:>10} {:>10}         both valid\n",
                  name_of(p.second_name) + " - " + name_of(p.first_name), "mean", "rms", "largest");
  for (std::size_t i = 0; i < quantities().size(); ++i) {
    const Moments& m = c.difference[i];
    if (m.n == 0) continue;
    out += fmt::format("  {:<24} {:10.4f} {:10.4f} {:10.4f} {:<6} {:8.1f} %\n", quantities()[i].words,
                       m.mean(), m.rms(), m.most, quantities()[i].unit,
                       100 * static_cast<double>(m.n) / static_cast<double>(c.times));
  }
  if (c.truths_apart_m)
    out += fmt::format("The truths of the two logs are up to {:.3g} m apart: these are two flights.\n",
                       *c.truths_apart_m);
  return out;
}

/// The columns of one estimate; those of reported standard deviations where either has any.
std::string error_cells(const Errors& e, std::size_t row, bool claims) {
  const consistency::Channel& c = e.claimed[row];
  std::string out = e.all[row].n > 0 ? fmt::format("{:9.4f}", e.all[row].rms()) : fmt::format("{:>9}", "-");
  if (!claims) return out;
  return out + (c.n > 0 ? fmt::format(" {:9.4f} {:8.3f} {:5.3f}", c.claim(), c.share_1(), c.share_2())
                        : fmt::format(" {:>9} {:>8} {:>5}", "-", "-", "-"));
}

bool has_claims(const Errors& e) {
  return std::any_of(e.claimed.begin(), e.claimed.end(), [](const auto& c) { return c.n > 0; });
}

std::string nees_text(const std::string& name, const Errors& e) {
  if (e.nees_n == 0) return "";
  return fmt::format("  NEES of 9, {}: mean {:.1f}, {:.1f} % of the time inside {:.2f} to {:.2f}{}\n", name,
                     e.nees.mean(), 100 * e.nees.inside(), consistency::Nees::low, consistency::Nees::high,
                     e.correlated ? "" : "; correlations taken for 0");
}

std::string errors(const Pair& p) {
  const Errors &a = p.made.first.errors, &b = p.made.second.errors;
  const bool truth = !p.first.truth.empty() || !p.second.truth.empty();
  if (a.pairs + b.pairs == 0) return "";
  const std::string first = truth ? p.first.truth : p.first.fixes,
                    second = truth ? p.second.truth : p.second.fixes;
  const std::string& topic = first.empty() ? second : first;
  const bool claims = has_claims(a) || has_claims(b);
  const std::string title = log_tool_messages::error_against(printable(topic)).text,
                    name = name_of(p.first_name);
  std::string out;
  if (claims)
    out = fmt::format(
        "\n{0:<30} {1:<32} {2}\n{3:<26} {4:>9} {5:>9} {6:>8} {7:>5}  {4:>9} {5:>9} {6:>8} {7:>5}\n", title,
        name, name_of(p.second_name), "", "rms", "claimed", "within 1", "2");
  else
    out = fmt::format("\n{}: rms\n{:<26} {:>9}  {:>9}\n", title, "", name.substr(0, 9),
                      name_of(p.second_name).substr(0, 9));
  for (std::size_t i = 0; i < quantities().size(); ++i) {
    if (a.all[i].n + b.all[i].n == 0) continue;
    out += fmt::format("  {:<24} {}  {} {}\n", quantities()[i].words, error_cells(a, i, claims),
                       error_cells(b, i, claims), quantities()[i].unit);
  }
  return out + nees_text(name_of(p.first_name), a) + nees_text(name_of(p.second_name), b);
}

json side_json(const Side& side, const std::string& name, const Judged& j) {
  return {{"name", name},
          {"log", side.log->file.string()},
          {"topic", side.topic},
          {"samples", j.samples},
          {"from_s", seconds(j.first_ns)},
          {"to_s", seconds(j.last_ns)},
          {"not_finite", j.not_finite},
          {"not_new", j.not_new},
          {"fault", side.log->fault.empty() ? json(nullptr) : json(side.log->fault)}};
}

json errors_json(const Side& side, const Errors& e) {
  json o{{"truth", side.truth.empty() ? json(nullptr) : json(side.truth)},
         {"fixes", side.fixes.empty() ? json(nullptr) : json(side.fixes)},
         {"compared", e.pairs},
         {"channels", json::object()},
         {"nees", nullptr}};
  for (std::size_t i = 0; i < quantities().size(); ++i) {
    if (e.all[i].n == 0) continue;
    json& row = o["channels"][quantities()[i].key] = {{"rms", e.all[i].rms()},    {"mean", e.all[i].mean()},
                                                      {"largest", e.all[i].most}, {"claimed", nullptr},
                                                      {"within_1", nullptr},      {"within_2", nullptr}};
    if (const consistency::Channel& c = e.claimed[i]; c.n > 0) {
      row["claimed"] = c.claim();
      row["within_1"] = c.share_1();
      row["within_2"] = c.share_2();
    }
  }
  if (e.nees_n > 0)
    o["nees"] = {{"mean", e.nees.mean()}, {"inside", e.nees.inside()}, {"correlated", e.correlated}};
  return o;
}

}  // namespace

std::string text_of(const Pair& p) {
  return head_of(p.first, name_of(p.first_name), p.made.first) +
         head_of(p.second, name_of(p.second_name), p.made.second) + difference_rows(p) + errors(p);
}

json json_of(const Pair& p) {
  const Comparison& c = p.made;
  json o{
      {"first", side_json(p.first, p.first_name, c.first)},
      {"second", side_json(p.second, p.second_name, c.second)},
      {"equal", c.equal},
      {"compared", c.pairs},
      {"difference", json::object()},
      {"errors",
       {{"first", errors_json(p.first, c.first.errors)}, {"second", errors_json(p.second, c.second.errors)}}},
      {"truths_apart_m", c.truths_apart_m ? json(*c.truths_apart_m) : json(nullptr)}};
  for (std::size_t i = 0; i < quantities().size(); ++i)
    if (const Moments& m = c.difference[i]; m.n > 0)
      o["difference"][quantities()[i].key] = {
          {"mean", m.mean()},
          {"rms", m.rms()},
          {"largest", m.most},
          {"both_valid_frac", static_cast<double>(m.n) / static_cast<double>(c.times)}};
  return o;
}

}  // namespace fulmar::states
