// SPDX-License-Identifier: BSD-3-Clause
// Fills described structs from YAML: numbers with units, text, enums, nested structs, arrays and lists.
#include "core/graph/record.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>

#include "core/graph/messages.hpp"
#include "core/graph/quantity.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

template <class T>
void put(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

/// "stall_alpha_rad" -> "stall_alpha"; a name without a unit stays.
std::string without_suffix(const std::string& field) {
  const auto split = split_suffix(field);
  return split ? split->name : field;
}

/// Set by the host when a record is supplied; a file must not set it.
bool is_given(const Field& field) {
  return field.name == "given" && field.kind == FULMAR_BOOL && field.shape == FULMAR_SCALAR;
}

/// Form of one value: the unit it inherits, whether the key omits the unit, and its name in faults.
struct RecordPlace {
  std::string path;
  std::string unit;
  UnitRule rule = UnitRule::optional;
};

class Filler {
 public:
  explicit Filler(Report& report) : report_(report) {}

  void fill_struct(const Type& type, const Node& node, std::byte* data, const RecordPlace& place,
                   const std::vector<std::string>& also) {
    if (node.is(Node::Kind::sequence) && is_tuple(type)) return fill_tuple(type, node, data, place);
    if (!node.is(Node::Kind::map))
      return fault(node, place.path, graph_messages::record_map_expected(type.name, found_words(node)));
    std::map<const Field*, const Node::Entry*> seen;
    for (const Node::Entry& entry : node.entries) {
      if (std::find(also.begin(), also.end(), entry.key) != also.end()) continue;
      const std::string path = place.path.empty() ? entry.key : place.path + "." + entry.key;
      const Field* field = field_for(type, entry, place, also);
      if (!field) continue;
      if (const auto [first, is_new] = seen.try_emplace(field, &entry); !is_new)
        report_.add(entry.where(), located(path, graph_messages::field_repeated(
                                                     first->second->key, first->second->where().text())));
      fill_field(*field, entry.value, data + field->offset, place_of(*field, entry.key, path, place));
    }
  }

  /// `rest`: the remaining path, such as "waypoints[2].up"; its first step is a field of `type`.
  void fill_path(const Type& type, const std::string& rest, const Node& node, std::byte* data,
                 const RecordPlace& place) {
    const std::size_t dot = rest.find('.');
    const std::string step = rest.substr(0, dot), name = step.substr(0, step.find('['));
    Node::Entry entry{name, node.line, {}};
    entry.value.file = node.file;
    const Field* const field = field_for(type, entry, place, {});
    if (!field) return;
    const std::string path = place.path.empty() ? step : place.path + "." + step;
    const RecordPlace inside = place_of(*field, name, path, place);
    std::byte* at = data + field->offset;
    const bool indexed = step.size() > name.size();
    if (indexed && !(at = item_at(*field, step.substr(name.size()), node, at, path))) return;
    if (dot == std::string::npos)
      return indexed ? fill_element(*field, node, at, inside) : fill_field(*field, node, at, inside);
    if (field->kind != FULMAR_STRUCT || (field->shape != FULMAR_SCALAR && !indexed))
      return fault(node, path,
                   field->shape != FULMAR_SCALAR ? graph_messages::item_index_missing(path)
                                                 : graph_messages::field_without_parts());
    fill_path(*field->type, rest.substr(dot + 1), node, at, inside);
  }

  void fill_field(const Field& field, const Node& node, std::byte* at, const RecordPlace& place) {
    if (field.shape == FULMAR_SCALAR) return fill_element(field, node, at, place);
    const bool list = field.shape == FULMAR_LIST;
    if (!is_a(Node::Kind::sequence, node, place.path, "a list of " + size_words(field), report_)) return;
    const std::size_t n = node.items.size();
    if (list ? n > field.count : n != field.count)
      return fault(node, place.path,
                   graph_messages::item_count_invalid(n, n == 1 ? " item" : " items", size_words(field)));
    if (list) put(at, static_cast<std::uint32_t>(n));
    std::byte* item = list ? at + field.items : at;
    const bool rising = field.in_record.rising && field.kind == FULMAR_F64;
    for (std::size_t i = 0; rising && i < n; ++i) put(item + i * field.stride, unread);
    for (std::size_t i = 0; i < n; ++i) {
      const std::string path = place.path + "[" + std::to_string(i) + "]";
      fill_element(field, node.items[i], item + i * field.stride, {path, place.unit, place.rule});
      if (field.kind == FULMAR_STRUCT) check_whole(*field.type, node.items[i], path);
    }
    if (rising) check_rising(field, node, item, place.path);
  }

 private:
  static constexpr double unread = std::numeric_limits<double>::quiet_NaN();  // of an item with a fault

  /// An item of a list must be complete: it has no defaults.
  void check_whole(const Type& type, const Node& item, const std::string& path) {
    if (!item.is(Node::Kind::map)) return;
    if (const std::vector<std::string> missing = missing_in_record(type, item); !missing.empty())
      fault(item, path, graph_messages::item_incomplete(type.name, join(missing)));
  }

  void check_rising(const Field& field, const Node& node, const std::byte* item, const std::string& path) {
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      double before = 0, value = 0;
      std::memcpy(&before, item + (i - 1) * field.stride, sizeof before);
      std::memcpy(&value, item + i * field.stride, sizeof value);
      if (std::isnan(before) || std::isnan(value)) return;  // an item has its own fault
      if (value > before) continue;
      return fault(node.items[i], path + "[" + std::to_string(i) + "]",
                   graph_messages::list_not_rising(
                       trimmed(node.items[i].text),
                       value == before ? " is there twice"
                                       : " comes after " + std::string(trimmed(node.items[i - 1].text))));
    }
  }

  /// Form of a field under `key`: when the key omits the unit, the value has it.
  static RecordPlace place_of(const Field& field, const std::string& key, const std::string& path,
                              const RecordPlace& outside) {
    const bool own_unit = !field.unit.empty(), exact = key == field.name;
    const UnitRule rule = own_unit ? (exact ? UnitRule::optional : UnitRule::required) : outside.rule;
    return {path, own_unit ? field.unit : outside.unit, rule};
  }

  /// The item "[2]" of a list; null and a fault when the list is shorter.
  std::byte* item_at(const Field& field, const std::string& index, const Node& node, std::byte* at,
                     const std::string& path) {
    std::uint32_t i = 0, n = field.shape == FULMAR_SCALAR ? 0 : field.count;
    if (field.shape == FULMAR_LIST) std::memcpy(&n, at, sizeof n);
    const auto [end, code] = std::from_chars(index.data() + 1, index.data() + index.size(), i);
    if (code != std::errc{} || std::string_view(end, index.data() + index.size()) != "]")
      fault(node, path, graph_messages::item_index_invalid(index));
    else if (field.shape == FULMAR_SCALAR)
      fault(node, path, graph_messages::field_not_list(field.name));
    else if (i >= n)
      fault(node, path,
            n == 0 ? graph_messages::list_empty()
                   : graph_messages::item_index_excessive(n, n == 1 ? " item" : " items", n - 1));
    else
      return (field.shape == FULMAR_LIST ? at + field.items : at) + i * field.stride;
    return nullptr;
  }

  static std::string size_words(const Field& field) {
    return (field.shape == FULMAR_LIST ? "at most " : "exactly ") + std::to_string(field.count);
  }

  /// A vector or quaternion: plain numbers whose unit comes from the enclosing field, so that a list is
  /// complete.
  static bool is_tuple(const Type& type) {
    return !type.frame.empty() && std::all_of(type.fields.begin(), type.fields.end(), [](const Field& field) {
      return field.kind == FULMAR_F64 && field.shape == FULMAR_SCALAR;
    });
  }

  void fill_tuple(const Type& type, const Node& node, std::byte* data, const RecordPlace& place) {
    const std::vector<std::string> names = names_of(type.fields);
    if (node.items.size() != names.size())
      return fault(node, place.path,
                   graph_messages::number_count_invalid(names.size(), join(names), node.items.size()));
    for (std::size_t i = 0; i < names.size(); ++i)
      fill_element(type.fields[i], node.items[i], data + type.fields[i].offset,
                   {place.path + "." + names[i], place.unit, place.rule});
  }

  const Field* field_for(const Type& type, const Node::Entry& entry, const RecordPlace& place,
                         const std::vector<std::string>& also) {
    if (const Field* field = field_of_key(type, entry.key); field && !is_given(*field)) return field;
    if (report_.full()) return nullptr;
    std::vector<std::string> names, shorter, same;
    for (const Field& field : type.fields) {
      if (is_given(field)) continue;
      names.push_back(field.name);
      shorter.push_back(without_suffix(field.name));
      if (without_suffix(field.name) == entry.key) same.push_back(field.name);
    }
    names.insert(names.end(), also.begin(), also.end());
    const std::string near = near_words(entry.key, shorter);
    const std::string prefix = place.path.empty() ? "" : place.path + ": ";
    if (same.size() > 1)
      report_.add(entry.where(), graph_messages::field_ambiguous(prefix, entry.key, join(same)));
    else
      report_.add(entry.where(), graph_messages::field_unknown(
                                     prefix, entry.key, type.name,
                                     near.empty() ? choices_text(entry.key, names)
                                                  : " Did you mean " + near + "?" + choices_text("", names)));
    return nullptr;
  }

  /// A height has many names: suggests all of them that exist.
  static std::string near_words(const std::string& key, const std::vector<std::string>& fields) {
    static const std::vector<std::string> heights = {"alt", "altitude", "alt_msl", "height", "up"};
    const bool height = std::find(heights.begin(), heights.end(), key) != heights.end();
    std::string words;
    for (const std::string& field : fields)
      if (height && std::find(heights.begin(), heights.end(), field) != heights.end())
        words += (words.empty() ? "'" : " or '") + field + "'";
    const std::string near = words.empty() ? nearest(key, fields) : "";
    return near.empty() ? words : "'" + near + "'";
  }

  void fill_element(const Field& field, const Node& node, std::byte* at, const RecordPlace& place) {
    if (field.kind == FULMAR_STRUCT) return fill_struct(*field.type, node, at, place, {});
    if (field.kind == FULMAR_TEXT) return fill_text(field, node, at, place);
    if (is_real(field.kind)) return fill_float(field, node, at, place);
    if (is_integer(field.kind)) return fill_integer(field, node, at, place);
    if (field.kind == FULMAR_ENUM) {
      const auto word = scalar_word(node, place.path, field.labels, report_);
      if (word) put(at, static_cast<std::uint8_t>(*word));
    } else {
      const auto flag = scalar_flag(node, place.path, report_);
      if (flag) put(at, static_cast<std::uint8_t>(*flag));
    }
  }

  void fill_text(const Field& field, const Node& node, std::byte* at, const RecordPlace& place) {
    const auto text = scalar_text_for(field.stride, node, place.path, report_);
    if (!text) return;
    std::memset(at, 0, field.stride);
    std::memcpy(at, text->data(), text->size());
  }

  void fill_float(const Field& field, const Node& node, std::byte* at, const RecordPlace& place) {
    const auto value =
        scalar_number(node, place.path, {place.unit, place.rule, field.min, field.max}, report_);
    if (!value) return;
    if (field.kind == FULMAR_F64) return put(at, *value);
    if (std::abs(*value) > std::numeric_limits<float>::max())
      return fault(node, place.path, graph_messages::value_exceeds_field(trimmed(node.text)));
    put(at, static_cast<float>(*value));
  }

  template <class T>
  static void put_integer(std::byte* at, const std::string& text, double value, bool scaled) {
    T exact{};
    const auto [end, code] =
        std::from_chars(text.data(), text.data() + text.size(), exact);  // keeps all 64 bits
    if (!scaled && code == std::errc{} && end == text.data() + text.size()) return put(at, exact);
    constexpr double lowest = static_cast<double>(std::numeric_limits<T>::lowest());
    const double above = std::ldexp(1.0, std::numeric_limits<T>::digits);
    if (value != std::floor(value)) throw Error(graph_messages::integer_invalid(text));
    if (value < lowest || value >= above)
      throw Error(graph_messages::integer_out_of_range(text, std::numeric_limits<T>::lowest(),
                                                       std::numeric_limits<T>::max()));
    put(at, static_cast<T>(value));
  }

  void fill_integer(const Field& field, const Node& node, std::byte* at, const RecordPlace& place) {
    if (!is_a(Node::Kind::scalar, node, place.path, "a whole number", report_)) return;
    try {
      const Quantity quantity = parse_quantity(node.text);
      double value = convert(quantity, place.unit, place.rule);
      if (!quantity.unit.empty()) value = std::round(value * 1e3) / 1e3;  // rounding: 0.1 s is exactly 1e8 ns
      check_range(quantity, value, place.unit, field.min, field.max);
      const bool scaled = !quantity.unit.empty();
      with_number(field.kind, at, [&](auto was) {
        if constexpr (std::is_integral_v<decltype(was)>)
          put_integer<decltype(was)>(at, quantity.text, value, scaled);
      });
    } catch (const Error& error) {
      fault(node, place.path, error.diagnostic);
    }
  }

  void fault(const Node& node, const std::string& path, const Diagnostic& message) {
    report_.add(node.where(), located(path, message));
  }

  Report& report_;
};

}  // namespace

const Field* field_of_key(const Type& type, const std::string& key) {
  if (const Field* exact = type.find(key)) return exact;
  const Field* found = nullptr;
  for (const Field& field : type.fields) {
    if (without_suffix(field.name) != key) continue;
    if (found) return nullptr;
    found = &field;
  }
  return found;
}

std::vector<std::string> missing_in_record(const Type& type, const Node& map) {
  std::vector<std::string> missing;
  const auto instead = std::find_if(map.entries.begin(), map.entries.end(), [&](const Node::Entry& entry) {
    const Field* const field = field_of_key(type, entry.key);
    return field && field->in_record.instead;
  });
  for (const Field& field : type.fields) {
    if (instead != map.entries.end() ? !field.in_record.instead : !field.in_record.required) continue;
    const auto given = std::find_if(map.entries.begin(), map.entries.end(), [&](const Node::Entry& entry) {
      return field_of_key(type, entry.key) == &field;
    });
    const bool there = given != map.entries.end();
    if (there && !given->value.is(Node::Kind::map)) continue;  // its fault is reported already
    const std::string name = without_suffix(field.name);
    const std::vector<std::string> inside =
        field.type ? missing_in_record(*field.type, there ? given->value : Node{})
                   : std::vector<std::string>();
    for (const std::string& part : inside) missing.push_back(name + "." + part);
    if (!there && inside.empty()) missing.push_back(name);
  }
  return missing;
}

void fill_record(const Type& type, const Node& node, std::byte* data, const std::string& path, Report& report,
                 const std::vector<std::string>& also) {
  if (node.is(Node::Kind::missing)) return;
  Filler(report).fill_struct(type, node, data, {path, "", UnitRule::optional}, also);
}

void fill_record_field(const Type& type, const std::string& field, const Node& node, std::byte* data,
                       const std::string& path, Report& report) {
  Filler(report).fill_path(type, field, node, data, {path, "", UnitRule::optional});
}

void mark_given(const Type& type, std::byte* data) {
  const Field* field = type.find("given");
  if (field && is_given(*field)) put(data + field->offset, std::uint8_t{1});
}

}  // namespace fulmar::core
