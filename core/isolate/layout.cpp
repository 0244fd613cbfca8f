// SPDX-License-Identifier: BSD-3-Clause
// Layout of the ports and parameters of an isolated component in the shared memory.
#include "core/isolate/shared.hpp"
#include "core/loader/fnv.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t page = 65536;  // the largest page of arm64

struct Room {
  std::size_t end = sizeof(ControlBlock);
  std::size_t take(std::size_t bytes) {
    const std::size_t at = (end + cache_line - 1) / cache_line * cache_line;
    end = at + bytes;
    return at;
  }
};

Place place(Room& room, const Port& port, bool single) {
  Place p;
  p.kind = port.kind;
  p.message = port.type ? port.type->size : sizeof(double);
  p.capacity = single ? 1 : port.capacity;
  p.data = room.take(p.message * p.capacity);
  const bool stamped = !single && (port.kind == FULMAR_IN_QUEUE || port.kind == FULMAR_IN_REQUEST ||
                                   port.kind == FULMAR_OUT_QUEUE);
  if (stamped) p.stamps = room.take(sizeof(std::int64_t) * p.capacity);
  if (!single && port.kind == FULMAR_IN_REQUEST) p.answers = room.take(sizeof(fulmar_answer) * p.capacity);
  return p;
}

// Hashes the tables of ports and parameters, on which host and child must agree.
template <class Item>
void sign(Fnv& signature, const std::vector<Item>& items) {
  signature.number(items.size());
  for (const Item& item : items) {
    signature.text(item.name);
    signature.number(item.kind);
    signature.number(item.capacity);
    signature.number(item.type ? item.type->hash : 0);
  }
}

}  // namespace

Layout::Layout(const ComponentInfo& info) {
  Room room;
  inputs_at = room.take(sizeof(SharedInput) * info.inputs.size());
  outputs_at = room.take(sizeof(SharedOutput) * info.outputs.size());
  for (const Port& port : info.inputs) inputs.push_back(place(room, port, false));
  for (const Port& port : info.outputs) outputs.push_back(place(room, port, false));
  last_at = room.take(sizeof(SharedInput) * info.outputs.size());
  for (const Port& port : info.outputs) last.push_back(place(room, port, true));
  values_at = room.take(sizeof(SharedValue) * info.params.size());
  for (const ParamInfo& param : info.params) {
    const std::size_t capacity = param.kind == FULMAR_STRING ? param.capacity : 0;
    texts.push_back({capacity > 0 ? room.take(capacity) : 0, capacity});
  }
  size = (room.end + page - 1) / page * page;

  Fnv all;
  all.number(sizeof(ControlBlock));
  all.number(size);
  sign(all, info.inputs);
  sign(all, info.outputs);
  sign(all, info.params);
  signature = all.value();
}

}  // namespace fulmar::core
