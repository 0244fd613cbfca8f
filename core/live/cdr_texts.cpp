// SPDX-License-Identifier: BSD-3-Clause
// XCDR1 of the host's own services: texts without a bound, and answers. Little endian.
#include "core/live/describe.hpp"
#include "core/types/cdr_bytes.hpp"

namespace fulmar::core::live {
namespace {

std::string taken(CdrOut out) {
  const std::vector<std::byte> bytes = out.take();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::string cdr_answer(bool accepted, std::string_view reason) {
  CdrOut out;
  out.flag(accepted);
  out.text(reason);
  return taken(std::move(out));
}

std::string cdr_text(std::string_view text) {
  CdrOut out;
  out.text(text);
  return taken(std::move(out));
}

std::vector<std::string> cdr_texts(std::string_view bytes, std::size_t count) try {
  CdrReader in(std::as_bytes(std::span(bytes)));
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) texts.emplace_back(in.ended_text());
  return texts;
} catch (const Error& e) {
  throw Error(std::string("the request: ") + e.what());
}

}  // namespace fulmar::core::live
