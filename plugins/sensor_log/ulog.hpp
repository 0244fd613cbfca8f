// SPDX-License-Identifier: BSD-3-Clause
// PX4's log. Source: the ULog file format in PX4's user guide. After a head there are records of a size, a
// kind and a payload; formats name the fields of a message, which are packed.
#pragma once
#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "cursor.hpp"

namespace fulmar::sensor_log {

class Ulog {
 public:
  /// `topic`: "sensor_mag", or "sensor_mag#1" for the second instance.
  Ulog(const File& file, std::string_view topic) : file_(file), topic_(topic) {
    if (!file.bytes.starts_with("ULog\x01\x12\x35"))
      refuse(file.key, sensor_log_messages::file_not_ulog(file.path));
  }

  Table read(const std::vector<Wanted>& wanted) {
    Table table;
    table.columns.resize(wanted.size());
    scan([&](const Cursor& data) {
      if (places_.empty()) resolve(wanted);
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        Cursor field = data;
        field.take(places_[i].at);
        put_number(places_[i].prim, field, table.columns[i], wanted[i]);
      }
      table.lines.push_back(table.rows() + 1);
    });
    table.cut_at = cut_at_;
    return table;
  }

  /// Throws if there is no such topic.
  Topic look() {
    scan([](const Cursor&) {});
    Topic topic{name_, {}};
    for (const Place& each : flat()) topic.columns.push_back(each.name);
    return topic;
  }

 private:
  struct Place {
    std::string name;
    Prim prim = Prim::u8;
    std::size_t at = 0;
  };

  template <class Use>
  void scan(const Use& use) {
    Cursor all{&file_, file_.bytes, 0, 0};
    all.take(16);
    logged_ = false;
    cut_at_ = 0;
    while (all.more()) {
      const std::size_t end = end_of_part(all.at);
      if (!whole_record(all, end)) {
        if (end == file_.bytes.size()) cut_at_ = all.at;
        all.at = end;
        continue;
      }
      const auto size = all.number<std::uint16_t>();
      const char kind = all.number<char>();
      Cursor record = all.part(size);
      if (kind == 'B') flags(record);
      if (kind == 'F') format(record.take(size));
      if (kind == 'A') new_topic(record);
      if (kind == 'D' && record.number<std::uint16_t>() == id_ && logged_) use(record.part(record.left()));
    }
    if (!logged_)
      refuse(file_.key.substr(0, file_.key.rfind('.')) + ".topic",
             cut_at_ > 0 ? sensor_log_messages::topic_unknown_in_cut_file(topic_, file_.path, all_of(topics_),
                                                                          cut_at_)
                         : sensor_log_messages::topic_unknown(topic_, file_.path, all_of(topics_)));
  }

  /// PX4 writes until the power fails: the last record of a part may be incomplete.
  static bool whole_record(Cursor at, std::size_t end) {
    constexpr std::size_t head = 3;
    return end - at.at >= head && end - at.at - head >= at.number<std::uint16_t>();
  }

  /// End of the part of the file that contains `at`: data appended after a crash are a new part.
  std::size_t end_of_part(std::size_t at) const {
    std::size_t end = file_.bytes.size();
    for (const std::uint64_t begin : appended_)
      if (begin > at && begin < end) end = static_cast<std::size_t>(begin);
    return end;
  }

  /// Incompatible flags. PX4 sets one of them, for data appended after a crash.
  void flags(Cursor& record) {
    record.take(8);
    const std::string_view bits = record.take(8);
    for (std::size_t i = 0; i < bits.size(); ++i)
      if ((bits[i] & ~(i == 0 ? 1 : 0)) != 0) refuse(file_.key, sensor_log_messages::log_too_new(file_.path));
    if (bits[0] == 0) return;
    for (std::uint64_t& begin : appended_) begin = record.number<std::uint64_t>();
  }

  void new_topic(Cursor& record) {
    const auto instance = record.number<std::uint8_t>();
    const auto id = record.number<std::uint16_t>();
    const std::string name(record.take(record.left()));
    const std::string topic = instance == 0 ? name : name + "#" + std::to_string(instance);
    if (std::find(topics_.begin(), topics_.end(), topic) == topics_.end()) topics_.push_back(topic);
    if (topic == topic_) {
      logged_ = true;
      id_ = id;
      name_ = name;
    }
  }

  /// "sensor_mag:uint64_t timestamp;float x;"
  void format(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return;
    formats_[std::string(text.substr(0, colon))] = std::string(text.substr(colon + 1));
  }

  void resolve(const std::vector<Wanted>& wanted) {
    const std::vector<Place> all = flat();
    std::vector<std::string> names;
    for (const Place& each : all) names.push_back(each.name);
    for (const Wanted& each : wanted) {
      std::size_t i = 0;
      while (i < all.size() && all[i].name != each.name) ++i;
      if (i == all.size()) refuse_column(each, topic_ + " of " + file_.path, names);
      places_.push_back(all[i]);
    }
  }

  std::vector<Place> flat() const {
    std::vector<Place> all;
    std::size_t at = 0;
    flatten(name_, "", at, all, 0);
    return all;
  }

  void flatten(const std::string& type, const std::string& prefix, std::size_t& at, std::vector<Place>& all,
               int depth) const {
    const auto found = formats_.find(type);
    if (found == formats_.end() || depth > 8)
      refuse(file_.key, sensor_log_messages::format_missing(file_.path, type));
    std::string_view rest = found->second;
    const std::size_t before = all.size();
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(';'), rest.size());
      const std::string_view field = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      const std::size_t blank = field.find(' ');
      if (blank == std::string_view::npos) continue;
      one(field.substr(0, blank), prefix + std::string(field.substr(blank + 1)), at, all, depth);
    }
    if (all.size() == before) refuse(file_.key, sensor_log_messages::format_empty(file_.path, type));
  }

  /// "float[3]", "prefix.gyro_rad"
  void one(std::string_view type, const std::string& name, std::size_t& at, std::vector<Place>& all,
           int depth) const {
    const std::size_t bracket = std::min(type.find('['), type.size());
    const std::string_view base = type.substr(0, bracket);
    std::size_t count = 1;
    if (bracket < type.size()) std::from_chars(type.data() + bracket + 1, type.data() + type.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      if (all.size() > 65535)  // a message has at most 65535 bytes
        refuse(file_.key, sensor_log_messages::format_too_large(file_.path, type, name));
      const std::string each = bracket < type.size() ? name + "[" + std::to_string(i) + "]" : name;
      const Prim prim = prim_of(base);
      if (prim == Prim::structure) {
        flatten(std::string(base), each + ".", at, all, depth + 1);
      } else {
        all.push_back({each, prim, at});
        at += size_of(prim);
      }
    }
  }

  static Prim prim_of(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, Prim>, 12> all = {{{"uint8_t", Prim::u8},
                                                                        {"int8_t", Prim::i8},
                                                                        {"uint16_t", Prim::u16},
                                                                        {"int16_t", Prim::i16},
                                                                        {"uint32_t", Prim::u32},
                                                                        {"int32_t", Prim::i32},
                                                                        {"uint64_t", Prim::u64},
                                                                        {"int64_t", Prim::i64},
                                                                        {"float", Prim::f32},
                                                                        {"double", Prim::f64},
                                                                        {"bool", Prim::u8},
                                                                        {"char", Prim::u8}}};
    for (const auto& [name, prim] : all)
      if (name == type) return prim;
    return Prim::structure;
  }

  const File& file_;
  std::string topic_, name_;
  bool logged_ = false;
  std::array<std::uint64_t, 3> appended_{};  // offsets of appended data; 0: none
  std::size_t cut_at_ = 0;                   // the incomplete record; 0: none
  std::uint16_t id_ = 0;
  std::vector<std::string> topics_;
  std::map<std::string, std::string> formats_;
  std::vector<Place> places_;
};

}  // namespace fulmar::sensor_log
