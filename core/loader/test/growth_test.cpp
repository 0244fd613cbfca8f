// SPDX-License-Identifier: BSD-3-Clause
// Plugins of other minor versions of the contract: older ones with shorter tables, newer ones with longer
// ones.
#include <doctest/doctest.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstring>

#include "core/loader/table.hpp"
#include "workshop.hpp"

namespace growth_test {

using namespace fulmar::core;
using namespace workshop;

// A struct that had the first two members in ABI 1.0.
struct Grown {
  std::uint32_t name, kind;
  std::uint64_t added;
};

}  // namespace growth_test

template <>
inline constexpr std::uint32_t fulmar::core::size_in_1_0<growth_test::Grown> =
    offsetof(growth_test::Grown, kind) + sizeof(growth_test::Grown::kind);

namespace growth_test {

TEST_CASE("the sizes of ABI 1.0 stay the same, whatever is appended") {
  if (sizeof(void*) != 8) return;
  // measured with the header of 1.0
  CHECK(size_in_1_0<fulmar_field> == 80);
  CHECK(size_in_1_0<fulmar_type> == 48);
  CHECK(size_in_1_0<fulmar_port> == 32);
  CHECK(size_in_1_0<fulmar_param> == 112);
  CHECK(size_in_1_0<fulmar_component> == 144);
}

TEST_CASE(
    "what a shorter element of an older version lacks is zero; a longer one of a newer version is cut") {
  const TableReader tables;
  alignas(8) static const std::uint32_t older[] = {1, 2, 3, 4};
  for (std::uint32_t i = 0; i < 2; ++i) {
    const Grown one = tables.element(reinterpret_cast<const Grown*>(older), 8, i, "the elements");
    CHECK(one.name == 1 + 2 * i);
    CHECK(one.kind == 2 + 2 * i);
    CHECK(one.added == 0);
  }
  alignas(8) static const std::uint64_t newer[] = {0x200000001, 7, 99, 0x400000003, 8, 99};
  const Grown second = tables.element(reinterpret_cast<const Grown*>(newer), 24, 1, "the elements");
  CHECK(second.name == 3);
  CHECK(second.kind == 4);
  CHECK(second.added == 8);
  CHECK_THROWS_WITH(tables.element(reinterpret_cast<const Grown*>(older), 4, 0, "the elements"),
                    "loader.table_stride_invalid(the elements, 4, 8)");
  CHECK_THROWS_WITH(tables.element(reinterpret_cast<const Grown*>(newer), 20, 0, "the elements"),
                    "loader.table_stride_invalid(the elements, 20, 8)");
}

TEST_CASE("a plugin whose tables are longer than this host's is read and works") {
  for (const char* name : {"longer_tables", "older_minor"}) {
    const auto library = Library::open(plugin(name));
    const PluginInfo& info = library->info();
    CHECK(info.abi_minor == (name[0] == 'l' ? 7 : 0));
    REQUIRE(info.components.size() == 2);
    CHECK(info.components[1].name == "Two");
    REQUIRE(info.components[1].outputs.size() == 2);
    CHECK(info.components[1].outputs[1].name == "second");
    REQUIRE(info.components[1].params.size() == 2);
    CHECK(info.components[1].params[1].name == "trim");
    CHECK(info.components[1].params[1].initial[0] == 0.5);
    REQUIRE(info.components[1].outputs[1].type->fields.size() == 2);
    CHECK(info.components[1].outputs[1].type->fields[1].name == "y_m");
    double first[2] = {0, 0}, second[2] = {0, 0};
    fulmar_output outputs[2]{};
    outputs[0].data = first;
    outputs[1].data = second;
    fulmar_error error{};
    const fulmar_tick tick{0, 2500000, 0};
    void* self = library->functions(1).create(1, &error);
    CHECK(library->functions(1).step(self, &tick, nullptr, outputs, &error) == FULMAR_OK);
    CHECK(second[1] == 42);
    library->functions(1).destroy(self);
  }
}

TEST_CASE("of an entry of ABI 1.0 only the members of ABI 1.0 are read") {
  const auto good = Library::open(plugin("good"));  // provides its component
  static char page_text[] = "1.0.0";
  constexpr std::size_t page = 65536, size = offsetof(fulmar_plugin, open_script);
  auto* memory = static_cast<std::byte*>(
      ::mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  REQUIRE(memory != MAP_FAILED);
  fulmar_plugin entry{};
  entry.abi_major = FULMAR_ABI_MAJOR;
  entry.component_count = 1;
  entry.component_stride = sizeof(fulmar_component);
  entry.version = entry.toolchain = entry.flags = page_text;
  entry.components = &good->functions(0);
  std::memcpy(memory + page - size, &entry, size);
  REQUIRE(::mprotect(memory + page, page, PROT_NONE) == 0);
  const auto& at_the_end = *reinterpret_cast<const fulmar_plugin*>(memory + page - size);
  CHECK(read_entry(at_the_end, "old.so").components.at(0).name == "Scaler");
  reinterpret_cast<fulmar_plugin*>(memory + page - size)->abi_minor = 1;
  CHECK_THROWS_WITH(read_entry(at_the_end, "old.so"), "old.so: loader.entry_outside_memory");
  ::munmap(memory, 2 * page);
}

}  // namespace growth_test
