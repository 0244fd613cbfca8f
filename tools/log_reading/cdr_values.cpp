// SPDX-License-Identifier: BSD-3-Clause
#include "tools/log_reading/cdr_values.hpp"

#include "core/types/cdr_bytes.hpp"
#include "core/types/text.hpp"
#include "tools/log_reading/messages.hpp"

namespace fulmar::core {
namespace {

struct Lister {
  CdrReader in;
  std::size_t most;
  std::vector<CdrValue> list{};

  std::string value(const Field& f) {
    if (f.kind == FULMAR_TEXT) {
      const std::string_view text = in.text();
      return std::string(text.substr(0, text.find('\0')));
    }
    return with_number(f.kind, in.take(primitive_size(f.kind)), [&](auto x) {
      for (const auto& [number, word] : f.constants)
        if (static_cast<decltype(x)>(number) == x) return word;
      return number_text(x);
    });
  }

  void type(const Type& t, const std::string& path) {
    if (t.fields.empty()) in.take(1);
    for (const Field& f : t.fields) {
      const std::uint32_t n = in.elements(f);
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::string name =
            path + f.name + (f.shape == FULMAR_SCALAR ? "" : "[" + std::to_string(i) + "]");
        if (f.kind == FULMAR_STRUCT)
          type(*f.type, name + ".");
        else if (list.size() < most)
          list.push_back({name, value(f)});
        else
          throw Error(reading_messages::too_many_values(most));
      }
    }
  }
};

}  // namespace

std::vector<CdrValue> cdr_values(const Type& schema, std::span<const std::byte> message, std::size_t most) {
  Lister lister{CdrReader(message), most};
  lister.type(schema, "");
  lister.in.finish();
  return std::move(lister.list);
}

}  // namespace fulmar::core
