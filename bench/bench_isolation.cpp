// SPDX-License-Identifier: BSD-3-Clause
// Cost of a step in a child process above the bare round trip between two processes of the same run, asleep
// and spinning; and of a step in this process, bare, and guarded and timed. The figures are valid on an idle
// machine.
// bench_isolation [--json]
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "core/isolate/isolated.hpp"
#include "core/run/component/unit.hpp"

using namespace fulmar::core;

namespace {

constexpr std::int64_t spin_ns = 50'000;
constexpr int block = 5000,
              blocks =
                  24;  // 120 000 round trips of each kind, in turns, so that disturbances affect all kinds

// ---- the bare round trip

struct Word {
  alignas(cache_line) std::atomic<std::uint32_t> value;
  std::atomic<std::uint32_t> sleepers;

  void set(std::uint32_t to) {
    value.store(to);
    if (sleepers.load() != 0) futex_wake(value);
  }
  void await(std::uint32_t seen, bool spins) {
    const auto changed = [&] { return value.load(std::memory_order_acquire) != seen; };
    if (spins && spin_until(spin_ns, changed)) return;
    sleepers.store(1);
    while (!changed()) futex_wait(value, seen, 1'000'000'000);
    sleepers.store(0, std::memory_order_relaxed);
  }
};

struct Words {
  Word request, answer;
  std::atomic<std::uint32_t> spins;
};

// The other process: this program again.
int echo() {
  void* memory = ::mmap(nullptr, sizeof(Words), PROT_READ | PROT_WRITE, MAP_SHARED, shared_descriptor, 0);
  if (memory == MAP_FAILED) return 1;
  Words& words = *static_cast<Words*>(memory);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (std::uint32_t n = 0;; ++n) {
    words.request.await(n, words.spins.load(std::memory_order_relaxed) != 0);
    words.answer.set(n + 1);
  }
}

class Echo {
 public:
  Echo() : memory_(65536), words_(*new (memory_.data()) Words{}) {
    process_ = std::make_unique<Process>(std::filesystem::read_symlink("/proc/self/exe").string(),
                                         std::vector<std::string>{"--echo"},
                                         ChildFiles{-1, STDERR_FILENO, STDERR_FILENO, memory_.descriptor()});
  }
  void spin(bool on) {
    words_.spins.store(on);
    trip();
  }
  void trip() {
    words_.request.set(n_ + 1);
    words_.answer.await(n_++, words_.spins.load(std::memory_order_relaxed) != 0);
  }
  pid_t pid() const { return process_->pid(); }

 private:
  SharedMemory memory_;
  Words& words_;
  std::uint32_t n_ = 0;
  std::unique_ptr<Process> process_;
};

// ---- a law

Component law_component() {
  Component c;
  c.name = "law";
  c.library = Library::open(FULMAR_ISOLATION_LAW);
  c.plugin = std::make_shared<const PluginInfo>(c.library->info());
  c.wires.resize(c.info().inputs.size());
  return c;
}

IsolatedOptions options_of(const Component& c, std::int64_t spin) {
  IsolatedOptions o;
  o.name = c.name;
  o.copy = c.plugin->copy;
  o.file = c.plugin->file;
  o.spin_ns = spin;
  return o;
}

// Inputs that are all new in each step, as in a loop with equal rates.
struct Law {
  const fulmar_component* functions;
  void* instance;
  std::vector<std::vector<std::byte>> in, out;
  std::vector<std::int64_t> stamps;
  std::vector<fulmar_input> inputs;
  std::vector<fulmar_output> outputs;
  fulmar_tick tick{0, 2'500'000, 0};
  fulmar_error error{};

  Law(const ComponentInfo& info, const fulmar_component& table, void* self)
      : functions(&table), instance(self), stamps(1) {
    for (const Port& port : info.inputs) {
      in.emplace_back(port.type->size);
      inputs.push_back({in.back().data(), nullptr, nullptr, 0, 0, 0, 1, 0, FULMAR_FRESH, 0});
    }
    for (const Port& port : info.outputs) {
      out.emplace_back(port.type->size);
      outputs.push_back({out.back().data(), stamps.data(), 0, 0, 0});
    }
    functions->configure(instance, nullptr, &error);
  }
  void step() {
    tick.now_ns += 2'500'000;
    ++tick.index;
    for (fulmar_input& i : inputs) {
      ++i.sequence;
      i.valid_at_ns = tick.now_ns;
    }
    for (fulmar_output& o : outputs) {
      o.valid_at_ns = tick.now_ns;
      o.count = 0;
    }
    if (functions->step(instance, &tick, inputs.data(), outputs.data(), &error) != FULMAR_OK)
      throw Error(error.text);
  }
};

// ---- figures

struct Row {
  std::string name;
  std::vector<double> ns;
  double quantile(double q) {
    const auto at = ns.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(ns.size() - 1));
    std::nth_element(ns.begin(), at, ns.end());
    return *at;
  }
};

/// Times each call separately.
template <class F>
void time_each(Row& row, F&& call) {
  for (int i = 0; i < block; ++i) {
    const std::int64_t begin = monotonic_ns();
    call();
    row.ns.push_back(static_cast<double>(monotonic_ns() - begin));
  }
}

/// Times a thousand calls together, so that the cost of the clock is negligible.
template <class F>
void time_batches(Row& row, F&& call) {
  constexpr int batch = 1000;
  for (int i = 0; i < 20; ++i) {
    const std::int64_t begin = monotonic_ns();
    for (int k = 0; k < batch; ++k) call();
    row.ns.push_back(static_cast<double>(monotonic_ns() - begin) / batch);
  }
}

void pin(pid_t pid, int which) {
  cpu_set_t all, one;
  CPU_ZERO(&all);
  CPU_ZERO(&one);
  ::sched_getaffinity(0, sizeof all, &all);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &all) && which-- == 0) CPU_SET(cpu, &one);
  if (CPU_COUNT(&one) == 1) ::sched_setaffinity(pid, sizeof one, &one);
}

struct Figures {
  Row bare_asleep{"round trip asleep, bare", {}}, step_asleep{"step in a child, asleep", {}};
  Row bare_spinning{"round trip spinning, bare", {}}, step_spinning{"step in a child, spinning", {}};
  Row in_process{"step in this process, bare", {}}, guarded{"step in this process, guarded and timed", {}};
  std::vector<Row*> rows() {
    return {&bare_asleep, &step_asleep, &bare_spinning, &step_spinning, &in_process, &guarded};
  }
};

// Steps it as the loop does.
class Guarded {
 public:
  explicit Guarded(const Component& c) : unit_(c, {}) {
    unit_.configure();
    slots_.resize(unit_.in.readers.size());
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const Port& port = *unit_.in.readers[i].port;
      slots_[i].published.resize(port.type->size);
      slots_[i].port = &port;
      unit_.in.readers[i].slot = &slots_[i];
      unit_.in.readers[i].plans.push_back(copy_plan(*port.type, *port.type));
    }
  }
  void step() {
    const std::int64_t begin = monotonic_ns();
    for (Slot& slot : slots_) ++slot.sequence;
    if (!has_stepped(unit_.step(now_ns_ += 2'500'000, 0))) throw Error(unit_.problem.text);
    unit_.out.publish([](Slot&) {});
    times_.add(monotonic_ns() - begin);
  }

 private:
  Unit unit_;
  std::vector<Slot> slots_;
  Histogram times_;
  std::int64_t now_ns_ = 0;
};

void measure(Figures& f) {
  const Component c = law_component();
  Isolated sleeper(c.info(), options_of(c, 0)), spinner(c.info(), options_of(c, spin_ns));
  Echo echo;
  for (const pid_t pid : {sleeper.pid(), spinner.pid(), echo.pid()}) pin(pid, 1);
  pin(0, 0);
  fulmar_error error{};
  void* here = c.library->functions(0).create(1, &error);
  Law asleep(c.info(), Isolated::functions(), &sleeper), spinning(c.info(), Isolated::functions(), &spinner);
  Law inside(c.info(), c.library->functions(0), here);
  Guarded guarded(c);
  for (int i = 0; i < blocks; ++i) {
    echo.spin(false);
    time_each(f.bare_asleep, [&] { echo.trip(); });
    time_each(f.step_asleep, [&] { asleep.step(); });
    echo.spin(true);
    time_each(f.bare_spinning, [&] { echo.trip(); });
    echo.spin(false);
    time_each(f.step_spinning, [&] { spinning.step(); });
    time_batches(f.in_process, [&] { inside.step(); });
    time_batches(f.guarded, [&] { guarded.step(); });
  }
  c.library->functions(0).destroy(here);
}

void print(Figures& f, bool json) {
  const double asleep = f.step_asleep.quantile(0.5) - f.bare_asleep.quantile(0.5);
  const double spinning = f.step_spinning.quantile(0.5) - f.bare_spinning.quantile(0.5);
  double load = 0;
  ::getloadavg(&load, 1);
  const unsigned cpus = std::thread::hardware_concurrency();
  if (!json) {
    for (Row* row : f.rows())
      std::printf("%-48s %9.0f %9.0f ns\n", row->name.c_str(), row->quantile(0.5), row->quantile(0.99));
    std::printf("%-48s %9.0f           ns\n%-48s %9.0f           ns\n", "a child's own cost, asleep", asleep,
                "a child's own cost, spinning", spinning);
    std::printf("%u CPUs, load average %.2f\n", cpus, load);
    return;
  }
  nlohmann::json all = {{"child asleep, excess_ns", asleep},
                        {"child spinning, excess_ns", spinning},
                        {"load_average", load},
                        {"cpus", cpus}};
  for (Row* row : f.rows())
    all[row->name] = {{"p50_ns", row->quantile(0.5)}, {"p99_ns", row->quantile(0.99)}};
  std::printf("%s\n", all.dump(2).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--echo") == 0) return echo();
  const bool json = argc == 2 && std::strcmp(argv[1], "--json") == 0;
  if (argc > 1 && !json) {
    std::fputs("usage: bench_isolation [--json]\n", stderr);
    return 2;
  }
  try {
    Figures figures;
    measure(figures);
    print(figures, json);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
