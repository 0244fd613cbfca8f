// SPDX-License-Identifier: BSD-3-Clause
// The fields are those of rcl_interfaces since ROS 2 Foxy.
#include "links/dds/rcl.hpp"

#include "links/dds/messages.hpp"

namespace fulmar::core::dds {

void RclValue::write(CdrOut& out) const {
  out.number(static_cast<std::uint8_t>(type));
  out.flag(boolean);
  out.number(integer);
  out.number(number);
  out.text(text);
  out.count(0);  // bytes
  out.count(0);  // booleans
  out.numbers(integers);
  out.numbers(numbers);
  out.count(0);  // texts
}

RclValue RclValue::read(CdrReader& in) {
  RclValue value;
  const auto type = in.number<std::uint8_t>();
  if (type > static_cast<std::uint8_t>(RclType::texts))
    throw Error(dds_messages::parameter_type_unknown(type));
  value.type = static_cast<RclType>(type);
  value.boolean = in.flag();
  value.integer = in.number<std::int64_t>();
  value.number = in.number<double>();
  value.text = in.ended_text();
  in.numbers<std::uint8_t>();  // bytes
  in.numbers<std::uint8_t>();  // booleans
  value.integers = in.numbers<std::int64_t>();
  value.numbers = in.numbers<double>();
  in.texts();
  return value;
}

std::vector<RclParameter> read_parameters(CdrReader& in) {
  constexpr std::size_t smallest = 40;  // bytes of a parameter
  std::vector<RclParameter> list(in.count(smallest));
  for (auto& [name, value] : list) {
    name = in.ended_text();
    value = RclValue::read(in);
  }
  return list;
}

}  // namespace fulmar::core::dds
