// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/params.hpp"

#include <algorithm>
#include <bitset>
#include <cctype>
#include <charconv>
#include <cmath>

#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/param_ranges.hpp"

namespace fulmar::fcu {

namespace {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::bitset<65536> indices(const Client& client) {
  std::bitset<65536> have;
  for (const auto& [name, param] : client.params()) have.set(param.index);
  return have;
}

/// Requests the list until parameters arrive, then reads until none has arrived for a while.
void ask_list(Client& client, const std::function<void()>& report) {
  std::uint64_t before = client.count<ParamValue>();
  for (int i = 0; i < 4 && client.count<ParamValue>() == before; ++i) {
    client.send(ParamRequestList{client.system(), 0});
    client.wait(500 * ms, [&] { return client.count<ParamValue>() > before; });
  }
  while (client.wait(60 * ms, [&] { return client.count<ParamValue>() > before; })) {
    before = client.count<ParamValue>();
    report();
    if (indices(client).count() >= client.param_count()) return;
  }
}

/// Requests some of the missing parameters.
void ask_missing(Client& client) {
  constexpr int window = 24;  // far below the controller's fifo of 256 packets
  const auto have = indices(client);
  std::vector<std::uint16_t> asked;
  for (std::uint16_t i = 0; i < client.param_count() && asked.size() < window; ++i)
    if (!have.test(i)) asked.push_back(i);
  for (const std::uint16_t i : asked)
    client.send(ParamRequestRead{static_cast<std::int16_t>(i), client.system(), 0, {}});
  client.wait(100 * ms, [&] { return indices(client).count() >= have.count() + asked.size(); });
}

void ask_one(Client& client, const std::string& name) {
  client.send(ParamRequestRead{-1, client.system(), 0, field<16>(name)});
}

bool heard_since(const Client& client, const std::string& name, std::int64_t since_ns) {
  const auto it = client.params().find(name);
  return it != client.params().end() && it->second.heard_ns >= since_ns;
}

/// " Did you mean RC_ARM_CHN or RC_ARM_THRESHOLD?"
std::string like(const std::string& wanted, const std::vector<std::string>& names) {
  std::string words = core::nearest(wanted, names);
  int n = words.empty() ? 0 : 1;
  for (const std::string& name : names)
    if (name != words && n < 4 && matches(name, wanted)) words += (n++ > 0 ? " or " : "") + name;
  return words.empty() ? fcu_messages::parameter_list_hint().line()
                       : fcu_messages::parameter_suggestion(words).line();
}

std::uint32_t parse_integer(const Param& param, const std::string& text) {
  std::int64_t value = 0;
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const auto [end, code] = std::from_chars(begin, text.data() + text.size(), value);
  if (code == std::errc::invalid_argument || end != text.data() + text.size())
    throw Error(fcu_messages::whole_number_expected(param.name, text));
  const bool too_large = code != std::errc{} || value < INT32_MIN || value > INT32_MAX;
  for (const ParamRange& range : param_ranges)
    if (range.name == param.name && (too_large || value < range.least || value > range.most))
      throw Error(fcu_messages::value_out_of_range(param.name, range.least, range.most, text));
  if (too_large) throw Error(fcu_messages::whole_number_too_large(text, param.name));
  return std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(value));
}

std::uint32_t parse_real(const Param& param, const std::string& text) {
  float value = 0;
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const auto [end, code] = std::from_chars(begin, text.data() + text.size(), value);
  if (code == std::errc::result_out_of_range) throw Error(fcu_messages::number_too_large(text, param.name));
  if (code != std::errc{} || end != text.data() + text.size())
    throw Error(fcu_messages::real_number_expected(param.name, text));
  if (!std::isfinite(value)) throw Error(fcu_messages::finite_number_expected(param.name, text));
  return std::bit_cast<std::uint32_t>(value);
}

}  // namespace

std::vector<Param> read_params(Client& client,
                               const std::function<void(std::size_t, std::size_t)>& progress) {
  client.forget_params();
  const auto report = [&] {
    if (progress) progress(indices(client).count(), client.param_count());
  };
  ask_list(client, report);
  if (client.params().empty()) throw Error(fcu_messages::parameter_request_unanswered(client.name()));
  int idle = 0;
  for (std::size_t have = indices(client).count(); have < client.param_count() && idle < 20;) {
    ask_missing(client);
    const std::size_t got = indices(client).count();
    idle = got > have ? 0 : idle + 1;
    have = got;
    report();
  }
  std::vector<Param> list;
  for (const auto& [name, param] : client.params()) list.push_back(param);
  std::sort(list.begin(), list.end(), [](const Param& a, const Param& b) { return a.index < b.index; });
  if (list.size() != client.param_count())
    throw Error(fcu_messages::parameters_incomplete(list.size(), client.param_count(), client.name()));
  return list;
}

Param read_param(Client& client, const std::string& name) {
  const std::string wanted = upper(name);
  if (wanted.empty() || wanted.size() > 16) throw Error(fcu_messages::parameter_name_invalid(name));
  for (int i = 0; i < 3; ++i) {
    const std::int64_t since = client.now_ns();
    ask_one(client, wanted);
    if (client.wait(250 * ms, [&] { return heard_since(client, wanted, since); }))
      return client.params().at(wanted);
  }
  // an unknown name gets no answer, like a lost one
  std::vector<std::string> names;
  for (const Param& param : read_params(client)) {
    if (param.name == wanted) return param;
    names.push_back(param.name);
  }
  throw Error(fcu_messages::parameter_unknown(name, like(wanted, names)));
}

std::vector<Param> read_some(Client& client, const std::vector<std::string>& names) {
  const std::int64_t since = client.now_ns();
  const auto missing = [&] {
    std::vector<std::string> out;
    std::copy_if(names.begin(), names.end(), std::back_inserter(out),
                 [&](const std::string& n) { return !heard_since(client, n, since); });
    return out;
  };
  for (int i = 0; i < 8 && !missing().empty(); ++i) {
    for (const std::string& name : missing()) ask_one(client, name);
    client.wait(250 * ms, [&] { return missing().empty(); });
  }
  std::vector<Param> out;
  for (const std::string& name : names)
    if (heard_since(client, name, since)) out.push_back(client.params().at(name));
  return out;
}

std::uint32_t parse_value(const Param& param, const std::string& text) {
  return param.whole ? parse_integer(param, text) : parse_real(param, text);
}

bool set_param(Client& client, const Param& now, std::uint32_t bits) {
  if (now.bits == bits) return false;
  Param wanted = now;
  wanted.bits = bits;
  const std::int64_t since = client.now_ns();
  const auto taken = [&] {
    return heard_since(client, now.name, since) && client.params().at(now.name).bits == bits;
  };
  for (int i = 0; i < 6; ++i) {
    client.send(
        ParamSet{bits, client.system(), 0, field<16>(now.name), now.whole ? param_int32 : param_real32});
    ask_one(client, now.name);  // an echo is sent only for a change; a request is always answered
    if (client.wait(250 * ms, taken)) return true;
  }
  if (!heard_since(client, now.name, since))
    throw Error(fcu_messages::set_not_confirmed(client.name(), now.name));
  throw Error(fcu_messages::set_not_effective(now.name, wanted.text(), client.params().at(now.name).text()));
}

bool matches(const std::string& name, const std::string& pattern) {
  const std::string p = upper(pattern);
  if (p.find_first_of("*?") == std::string::npos) return name.find(p) != std::string::npos;
  const std::function<bool(std::size_t, std::size_t)> from = [&](std::size_t i, std::size_t j) {
    if (j == p.size()) return i == name.size();
    if (p[j] == '*') return from(i, j + 1) || (i < name.size() && from(i + 1, j));
    return i < name.size() && (p[j] == '?' || p[j] == name[i]) && from(i + 1, j + 1);
  };
  return from(0, 0);
}

}  // namespace fulmar::fcu
