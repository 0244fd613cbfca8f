// SPDX-License-Identifier: BSD-3-Clause
// A ROS 2 message by its definition in a bag, and a reader of some of its fields in XCDR1 bytes,
// little-endian. Sources: ROS 2 interface definition; OMG DDS-XTypes 1.3, 7.4.1.
#pragma once
#include <map>
#include <utility>

#include "csv.hpp"
#include "cursor.hpp"

namespace fulmar::sensor_log {

/// Time of recording and time of sending of a message, ns since 1970, by the clocks of recorder and sender.
/// Every topic without fields of these names has these columns.
struct Stamps {
  std::uint64_t logged = 0, published = 0;
};
inline constexpr std::array<const char*, 2> stamp_names = {"log_time", "publish_time"};

struct RosField {
  Prim prim = Prim::u8;
  std::string name, type;  ///< type: of a structure, "pkg/Name"
  bool sequence = false;   ///< the bytes hold its count
  std::size_t count = 1;
  bool array = false;                            ///< of `count`
  std::vector<std::vector<std::size_t>> wanted;  ///< per element: the columns that use it
  std::vector<RosField> inside;
};

class RosType {
 public:
  RosType(const File& file, const std::string& topic, const std::string& type, std::string_view text)
      : file_(file), topic_(topic) {
    std::string current = shorter(type);
    types_[current];
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      std::string_view line = text.substr(from, end - from);
      from = end + 1;
      line = trimmed(line.substr(0, line.find('#')));
      if (line.empty() || line.starts_with("==")) continue;
      if (line.starts_with("MSG:"))
        types_[current = shorter(std::string(trimmed(line.substr(4))))];
      else
        field(line, types_[current], current);
    }
    fields_ = grown(shorter(type), "", 0);
    names_.insert(names_.end(), stamp_names.begin(), stamp_names.end());
  }

  const std::vector<std::string>& names() const { return names_; }

  void want(const std::vector<Wanted>& wanted) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (mark(fields_, "", wanted[i].name, i)) continue;
      const auto stamp = std::find(stamp_names.begin(), stamp_names.end(), wanted[i].name);
      if (stamp == stamp_names.end()) refuse_column(wanted[i], topic_ + " of " + file_.path, names_);
      stamped_[static_cast<std::size_t>(stamp - stamp_names.begin())].push_back(i);
    }
  }

  void read(const Stamps& stamps, Cursor bytes, const std::vector<Wanted>& wanted, Table& table) const {
    put_stamp(stamps.logged, stamped_[0], wanted, table);
    put_stamp(stamps.published, stamped_[1], wanted, table);
    const auto head = bytes.take(4);
    if (head[0] != 0 || head[1] != 1) refuse(file_.key, sensor_log_messages::message_not_xcdr(file_.path));
    bytes = bytes.part(bytes.left());  // the alignment of numbers counts from here
    walk(fields_, bytes, wanted, &table);
  }

 private:
  /// "sensor_msgs/msg/Imu" -> "sensor_msgs/Imu"
  static std::string shorter(std::string type) {
    if (const std::size_t at = type.find("/msg/"); at != std::string::npos) type.erase(at, 4);
    return type;
  }

  void field(std::string_view line, std::vector<RosField>& fields, const std::string& inside) {
    const std::size_t blank = std::min(line.find_first_of(" \t"), line.size());
    std::string_view type = line.substr(0, blank), name = trimmed(line.substr(blank));
    name = name.substr(0, name.find_first_of(" \t"));
    if (name.empty() || name.find('=') != std::string_view::npos) return;
    if (const std::string_view all = line.substr(blank);
        trimmed(trimmed(all).substr(name.size())).starts_with("="))
      return;  // a constant
    RosField f;
    f.name = name;
    if (const std::size_t at = type.find('['); at != std::string_view::npos) {
      const std::string_view size = type.substr(at + 1, type.size() - at - 2);
      f.array = !size.empty() && size.front() != '<';
      f.sequence = !f.array;
      if (f.array) std::from_chars(size.data(), size.data() + size.size(), f.count);
      type = type.substr(0, at);
    }
    f.prim = prim_of(type.substr(0, type.find('<')));
    f.type = type;
    if (f.type == "Header") f.type = "std_msgs/Header";
    if (f.prim == Prim::structure && f.type.find('/') == std::string::npos)
      f.type = inside.substr(0, inside.find('/')) + "/" + f.type;
    f.type = shorter(f.type);
    fields.push_back(std::move(f));
  }

  static Prim prim_of(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, Prim>, 17> all = {
        {{"bool", Prim::u8},
         {"byte", Prim::u8},
         {"char", Prim::u8},
         {"uint8", Prim::u8},
         {"int8", Prim::i8},
         {"uint16", Prim::u16},
         {"int16", Prim::i16},
         {"uint32", Prim::u32},
         {"int32", Prim::i32},
         {"uint64", Prim::u64},
         {"int64", Prim::i64},
         {"float32", Prim::f32},
         {"float64", Prim::f64},
         {"string", Prim::text},
         {"builtin_interfaces/Time", Prim::time},
         {"builtin_interfaces/msg/Time", Prim::time},
         {"time", Prim::time}}};
    for (const auto& [name, prim] : all)
      if (name == type) return prim;
    return Prim::structure;
  }

  std::vector<RosField> grown(const std::string& type, const std::string& prefix, int depth) {
    const auto found = types_.find(type);
    if (found == types_.end() || depth > 16 || ++structures_ > 1000)
      refuse(file_.key, sensor_log_messages::type_unknown(file_.path, topic_, type));
    std::vector<RosField> fields = found->second;
    for (RosField& f : fields) {
      const std::string name = prefix + f.name;
      if (f.prim == Prim::structure) {
        f.inside = grown(f.type, name + ".", depth + 1);
      } else if (f.prim != Prim::text && !f.sequence) {
        names_.push_back(f.array ? name + "[0]" : name);
        f.wanted.resize(std::min<std::size_t>(f.count, 1024));
      }
    }
    if (fields.empty()) fields.emplace_back();  // in ROS 2 an empty structure has one byte
    return fields;
  }

  static bool mark(std::vector<RosField>& fields, const std::string& prefix, const std::string& name,
                   std::size_t column) {
    for (RosField& f : fields) {
      const std::string here = prefix + f.name;
      if (f.prim == Prim::structure && !f.sequence && !f.array && mark(f.inside, here + ".", name, column))
        return true;
      for (std::size_t i = 0; i < f.wanted.size(); ++i)
        if (name == (f.array ? here + "[" + std::to_string(i) + "]" : here)) {
          f.wanted[i].push_back(column);
          return true;
        }
    }
    return false;
  }

  static void put_stamp(std::uint64_t ns, const std::vector<std::size_t>& columns,
                        const std::vector<Wanted>& wanted, Table& table) {
    constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
    for (const std::size_t i : columns)
      put(table.columns[i], wanted[i], static_cast<std::int64_t>(std::min(ns, most)));
  }

  static void align(Cursor& bytes, std::size_t to) { bytes.take((to - bytes.at % to) % to); }

  /// `table`: null for a part that no column uses.
  static void walk(const std::vector<RosField>& fields, Cursor& bytes, const std::vector<Wanted>& wanted,
                   Table* table) {
    for (const RosField& f : fields) {
      std::size_t count = f.count;
      if (f.sequence) {
        align(bytes, 4);
        count = bytes.number<std::uint32_t>();
      }
      if (count > bytes.left()) bytes.fault(sensor_log_messages::message_cut(count, bytes.left()));
      for (std::size_t i = 0; i < count; ++i) {
        if (f.prim == Prim::structure)
          walk(f.inside, bytes, wanted, f.sequence || f.array ? nullptr : table);
        else
          element(f, i < f.wanted.size() && table ? &f.wanted[i] : nullptr, bytes, wanted, table);
      }
    }
  }

  static void element(const RosField& f, const std::vector<std::size_t>* columns, Cursor& bytes,
                      const std::vector<Wanted>& wanted, Table* table) {
    align(bytes, size_of(f.prim));
    if (f.prim == Prim::text) return void(bytes.text());
    const Cursor start = bytes;
    bytes.take(f.prim == Prim::time ? 8 : size_of(f.prim));
    for (std::size_t k = 0; columns && k < columns->size(); ++k) {
      const std::size_t i = (*columns)[k];
      Cursor value = start;
      if (f.prim != Prim::time) {
        put_number(f.prim, value, table->columns[i], wanted[i]);
      } else {
        const std::int64_t s = value.number<std::int32_t>();
        put(table->columns[i], wanted[i], s * 1'000'000'000 + value.number<std::uint32_t>());
      }
    }
  }

  const File& file_;
  std::string topic_;
  std::size_t structures_ = 0;
  std::map<std::string, std::vector<RosField>> types_;
  std::vector<RosField> fields_;
  std::vector<std::string> names_;
  std::array<std::vector<std::size_t>, 2> stamped_;  ///< the columns that use a stamp
};

}  // namespace fulmar::sensor_log
