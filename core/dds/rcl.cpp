// SPDX-License-Identifier: BSD-3-Clause
// Field by field as rcl_interfaces has them since ROS 2 Foxy.
#include "core/dds/rcl.hpp"

#include <algorithm>
#include <cmath>

namespace fulmar::core::dds {

void RclValue::write(CdrOut& out) const {
  out.number(static_cast<std::uint8_t>(type));
  out.flag(boolean);
  out.number(integer);
  out.number(number);
  out.text(text);
  out.numbers(bytes);
  out.numbers(booleans);
  out.numbers(integers);
  out.numbers(numbers);
  out.texts(texts);
}

RclValue RclValue::read(CdrIn& in) {
  RclValue value;
  const auto type = in.number<std::uint8_t>();
  if (type > static_cast<std::uint8_t>(RclType::texts))
    throw Error("there is no parameter type " + std::to_string(type));
  value.type = static_cast<RclType>(type);
  value.boolean = in.flag();
  value.integer = in.number<std::int64_t>();
  value.number = in.number<double>();
  value.text = in.text();
  value.bytes = in.numbers<std::uint8_t>();
  value.booleans = in.numbers<std::uint8_t>();
  value.integers = in.numbers<std::int64_t>();
  value.numbers = in.numbers<double>();
  value.texts = in.texts();
  return value;
}

void RclParameter::write(CdrOut& out) const {
  out.text(name);
  value.write(out);
}

std::vector<RclParameter> RclParameter::read_list(CdrIn& in) {
  constexpr std::size_t smallest = 40;  // bytes of a parameter
  std::vector<RclParameter> list(in.count(smallest));
  for (RclParameter& p : list) {
    p.name = in.text();
    p.value = RclValue::read(in);
  }
  return list;
}

void RclDescriptor::write(CdrOut& out) const {
  out.text(name);
  out.number(static_cast<std::uint8_t>(type));
  out.text(description);
  out.text(constraints);
  out.flag(read_only);
  out.flag(false);  // dynamic typing
  out.count(number_range ? 1 : 0);
  if (number_range) {
    out.number(min);
    out.number(max);
    out.number(0.0);  // step: any value
  }
  out.count(integer_range ? 1 : 0);
  if (integer_range) {
    constexpr double largest = 9.2e18;  // fits an int64
    out.number(static_cast<std::int64_t>(std::clamp(min, -largest, largest)));
    out.number(static_cast<std::int64_t>(std::clamp(max, -largest, largest)));
    out.number(std::uint64_t{1});
  }
}

}  // namespace fulmar::core::dds
