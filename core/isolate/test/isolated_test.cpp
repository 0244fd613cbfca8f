// SPDX-License-Identifier: BSD-3-Clause
// A component in a child computes the same results as in the host.
#include "core/isolate/isolated.hpp"

#include <cmath>
#include <random>

#include "core/run/component/allocation.hpp"
#include "core/types/wire.hpp"
#include "workshop.hpp"

namespace isolated_test {

using namespace workshop;

namespace {

// Random inputs of every kind, equal for all rigs with the same seed.
void give_anything(Rig& rig, std::uint64_t number) {
  std::mt19937_64 random(number);
  const auto real = [&] { return static_cast<double>(random() % 20001) * 1e-3 - 10; };
  rig.tick = {static_cast<std::int64_t>(number) * 2'500'000, 2'500'000, number};
  if (number == 0 || random() % 3 != 0)
    rig.give({real(), real(), static_cast<std::uint32_t>(random())});
  else
    rig.inputs[0].flags = 0;
  rig.inputs[0].valid_at_ns = rig.tick.now_ns - static_cast<std::int64_t>(random() % 1000);
  rig.inputs[0].age_ns = rig.tick.now_ns - rig.inputs[0].valid_at_ns;
  if (random() % 50 == 0) rig.inputs[0].flags |= FULMAR_STALE;

  fulmar_input& word = rig.inputs[1];
  word = {};
  if (random() % 2 == 0) {
    for (std::byte& b : rig.in_data[1]) b = static_cast<std::byte>(random() % 64);
    word.data = rig.in_data[1].data();
    word.sequence = number;
    word.count = 1;
    word.valid_at_ns = static_cast<std::int64_t>(random() % 1000);
  }
  for (std::size_t i = 2; i < 4; ++i) {
    fulmar_input& in = rig.inputs[i];
    in = {};
    in.data = rig.in_data[i].data();
    in.stamps_ns = rig.in_stamps[i].data();
    in.answers = rig.answers[i].data();
    in.count = static_cast<std::uint32_t>(random() % (rig.info.inputs[i].capacity + 1));
    in.lost = static_cast<std::uint32_t>(random() % 2);
    for (std::uint32_t k = 0; k < in.count; ++k) {
      const double x = real();
      std::memcpy(rig.in_data[i].data() + k * rig.info.inputs[i].type->size, &x, sizeof x);
      rig.in_stamps[i][k] = rig.tick.now_ns + k;
      rig.answers[i][k] = {};
    }
  }
}

/// Compares two messages without the padding between their fields.
bool same_message(const Type* type, const std::byte* a, const std::byte* b) {
  if (!type) return std::memcmp(a, b, sizeof(double)) == 0;
  const CdrEncoder encoder(*type);
  std::vector<std::byte> x(encoder.max_size()), y(encoder.max_size());
  x.resize(encoder.encode(a, x.data()));
  y.resize(encoder.encode(b, y.data()));
  return x == y;
}

bool same_output(const Rig& a, const Rig& b, std::size_t i) {
  const fulmar_output &x = a.outputs[i], &y = b.outputs[i];
  if (x.count != y.count || x.lost != y.lost || x.valid_at_ns != y.valid_at_ns) return false;
  const fulmar_port_kind kind = a.info.outputs[i].kind;
  if (kind == FULMAR_OUT_QUEUE && std::memcmp(x.stamps_ns, y.stamps_ns, x.count * sizeof(std::int64_t)) != 0)
    return false;
  const Port& port = a.info.outputs[i];
  const std::size_t count = kind == FULMAR_OUT_QUEUE ? x.count : 1,
                    size = a.out_data[i].size() / port.capacity;
  for (std::size_t k = 0; k < count; ++k)
    if (!same_message(port.type.get(), a.out_data[i].data() + k * size, b.out_data[i].data() + k * size))
      return false;
  return true;
}

bool same_answers(const Rig& a, const Rig& b) {
  for (std::uint32_t k = 0; k < a.inputs[3].count; ++k)
    if (a.answers[3][k].verdict != b.answers[3][k].verdict ||
        std::strcmp(a.answers[3][k].reason, b.answers[3][k].reason) != 0)
      return false;
  return true;
}

}  // namespace

TEST_CASE("a component in a child computes the same bytes as in the host, for every kind of port") {
  Rig here("Everything"), there("Everything");
  here.here();
  SUBCASE("sleeping") {
    IsolatedOptions options = options_for("Everything");
    options.spin_ns = 0;
    there.there(options);
  }
  SUBCASE("spinning") { there.there(); }
  Table table;
  table.gain_ratio[3] = 0.25;
  table.used = 4;
  std::vector<std::byte> blob(100'000, std::byte{17});
  for (Rig* rig : {&here, &there}) {
    rig->value("table").data = &table;
    rig->value("table").size = sizeof table;
    rig->value("table").integer = 1;
    rig->value("bytes").data = blob.data();
    rig->value("bytes").size = blob.size();
    rig->value("bytes").text = "bytes.bin";
    rig->value("tag").text = "red";
    rig->value("offset").number[0] = -4;
    REQUIRE(rig->configure() == FULMAR_OK);
  }
  std::size_t wrong = 0, refused = 0, silent = 0, full = 0;
  for (std::uint64_t n = 0; n < 3000; ++n) {
    for (Rig* rig : {&here, &there}) {
      give_anything(*rig, n);
      if (n % 500 == 100) {
        rig->choose("law", static_cast<int>(n / 500 % 3));
        rig->value("gain").number[0] = 0.001 * static_cast<double>(n);
      }
      if (n % 500 == 100) rig->value("tag").text = n % 1000 == 100 ? "a longer tag" : "";
    }
    if (n % 500 == 100) wrong += here.retune() != there.retune();
    if (n % 700 == 200) {
      for (Rig* rig : {&here, &there})
        for (std::size_t i = 0; i < rig->last.size(); ++i) {
          std::memcpy(rig->last_data[i].data(), rig->out_data[i].data(), rig->last_data[i].size());
          rig->last[i] = {rig->last_data[i].data(), nullptr, nullptr, 5, 6, n, 1, 0, 0, 0};
        }
      wrong += here.activate() != there.activate();
    }
    if (n % 700 == 600) {
      here.table->deactivate(here.instance);
      there.table->deactivate(there.instance);
    }
    wrong += here.step() != there.step();
    for (std::size_t i = 0; i < here.outputs.size(); ++i) wrong += same_output(here, there, i) ? 0 : 1;
    wrong += same_answers(here, there) ? 0 : 1;
    silent += here.outputs[1].count == 0;
    full += here.outputs[2].lost;
    for (std::uint32_t k = 0; k < here.inputs[3].count; ++k)
      refused += here.answers[3][k].verdict == FULMAR_REFUSED;
  }
  CHECK(wrong == 0);
  CHECK(refused > 600);  // every case occurs
  CHECK(silent > 1000);
  CHECK(full > 100);
  CHECK(there.child->alive());
}

TEST_CASE("a second configure brings new files, and those of the first are not needed any more") {
  Rig here("Everything"), there("Everything");
  here.here();
  there.there();
  for (std::size_t size : {10u, 300'000u, 1000u, 0u}) {
    const std::vector<std::byte> blob(size, static_cast<std::byte>(size % 251));
    for (Rig* rig : {&here, &there}) {
      rig->value("bytes").data = blob.empty() ? nullptr : blob.data();
      rig->value("bytes").size = blob.size();
      REQUIRE(rig->configure() == FULMAR_OK);
    }
    for (std::uint64_t n = 0; n < 20; ++n) {
      for (Rig* rig : {&here, &there}) give_anything(*rig, n);
      if (!blob.empty()) CHECK(here.step() == there.step());
      if (!blob.empty()) CHECK(same_output(here, there, 0));
    }
  }
}

TEST_CASE("an exception arrives as its text and a failed step as its status, and the child continues") {
  Rig rig("Faulty");
  rig.there();
  rig.choose("fault", throws);
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  CHECK(rig.step() == FULMAR_FAILED);
  CHECK(rig.text() == "the law is broken");
  rig.choose("fault", fails);
  CHECK(rig.retune() == FULMAR_OK);
  CHECK(rig.step() == FULMAR_FAILED);
  CHECK(rig.text().empty());
  rig.choose("fault", none);
  rig.choose("in_retune", throws);
  CHECK(rig.retune() == FULMAR_FAILED);
  CHECK(rig.text() == "the law is broken");
  CHECK(rig.step() == FULMAR_OK);
  CHECK(rig.child->alive());
}

TEST_CASE("a value that is not a number passes through to the host's guard") {
  Rig rig("Faulty");
  rig.there();
  rig.choose("fault", not_a_number);
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  CHECK(rig.step() == FULMAR_OK);
  CHECK(std::isnan(rig.first_output().y_m));
  CHECK(rig.first_output().x_m == 1);
}

TEST_CASE("the heap calls and the heap size of a child are counted") {
  Rig rig("Faulty");
  rig.there();
  REQUIRE(rig.configure() == FULMAR_OK);
  rig.give({1, 2, 3});
  for (int i = 0; i < 100; ++i) REQUIRE(rig.step() == FULMAR_OK);
  CHECK(rig.child->allocations() == 0);
  CHECK(rig.child->heap_growth() == 0);
  rig.choose("fault", allocates);
  REQUIRE(rig.retune() == FULMAR_OK);
  for (int i = 0; i < 100; ++i) REQUIRE(rig.step() == FULMAR_OK);
  CHECK(rig.child->allocations() == 100);  // allocated and freed
  CHECK(rig.child->heap_growth() == 0);
  rig.choose("fault", leaks);
  REQUIRE(rig.retune() == FULMAR_OK);
  for (int i = 0; i < 100; ++i) REQUIRE(rig.step() == FULMAR_OK);
  CHECK(rig.child->allocations() == 200);
  CHECK(rig.child->heap_growth() >= 100'000);
  CHECK(rig.child->heap_growth() < 110'000);
}

TEST_CASE("two children run in parallel, and the death of one does not affect the other") {
  Rig one("Faulty"), two("Faulty");
  one.there();
  two.there();
  one.choose("fault", aborts);
  one.value("at").number[0] = 1;
  REQUIRE(one.configure() == FULMAR_OK);
  REQUIRE(two.configure() == FULMAR_OK);
  for (int i = 0; i < 1000; ++i) {
    one.give({1.0 * i, 1, 1});
    two.give({2.0 * i, 2, 2});
    REQUIRE(one.step() == FULMAR_OK);
    REQUIRE(two.step() == FULMAR_OK);
    REQUIRE(one.first_output().x_m == 1.0 * i);
    REQUIRE(two.first_output().x_m == 2.0 * i);
  }
  one.tick.now_ns = 1'000'000'000;
  CHECK(one.step() == FULMAR_FAILED);
  two.give({7, 8, 9});
  CHECK(two.step() == FULMAR_OK);
  CHECK(two.first_output().y_m == 8);
}

TEST_CASE("the proxy does not allocate in flight") {
  if (!counts_allocations()) {
    MESSAGE("skipped: this build does not count");
    return;
  }
  Rig rig("Everything"), dying("Faulty");
  rig.there();
  dying.there();
  dying.choose("fault", exits);
  REQUIRE(rig.configure() == FULMAR_OK);
  REQUIRE(dying.configure() == FULMAR_OK);
  give_anything(rig, 0);
  dying.give({1, 2, 3});
  const std::vector<fulmar_value> live = rig.values;
  const std::uint64_t before = thread_allocations();
  for (int i = 0; i < 100; ++i) rig.step();
  rig.table->retune(rig.instance, live.data(), &rig.error);
  rig.activate();
  rig.table->deactivate(rig.instance);
  dying.step();
  dying.step();
  CHECK(thread_allocations() == before);
  CHECK_FALSE(dying.child->alive());
}

}  // namespace isolated_test
