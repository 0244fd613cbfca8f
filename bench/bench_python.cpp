// SPDX-License-Identifier: BSD-3-Clause
// Additional cost of a step in Python relative to the same step in C++: VehicleState and GuidanceCommand in,
// AttitudeCommand and a probe out, 100 Hz.
// bench_python [--json]
#include <dlfcn.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "fulmar/abi.h"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace {

std::int64_t now_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

const fulmar_plugin& entry_of(const char* file) {
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  return *static_cast<const fulmar_plugin*>(dlsym(library, FULMAR_ENTRY_SYMBOL));
}

struct Times {
  double p50_us, p99_us, max_us;
};

/// Steps one component, each step timed separately, with pauses of `pause_ns` as in a flight of that rate (0:
/// none).
class Stepper {
 public:
  explicit Stepper(const fulmar_component& c) : c_(c) {
    fulmar_error error{};
    instance_ = c.create(1, &error);
    if (instance_ == nullptr) throw std::runtime_error(error.text);
    std::vector<fulmar_value> values(c.param_count);
    for (std::uint32_t i = 0; i < c.param_count; ++i)
      std::memcpy(values[i].number, c.params[i].initial, sizeof c.params[i].initial);
    if (c.configure(instance_, values.data(), &error) != FULMAR_OK) throw std::runtime_error(error.text);
    for (fulmar_input& in : inputs_) {
      in.count = 1;
      in.sequence = 1;
      in.flags = FULMAR_FRESH;
    }
    inputs_[0].data = &state_;
    inputs_[1].data = &command_;
  }
  ~Stepper() { c_.destroy(instance_); }
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  Times run(int steps, std::int64_t pause_ns, bool asleep) {
    std::vector<double> each;
    fulmar_error error{};
    for (int i = 0; i < steps; ++i) {
      const fulmar_tick tick{10'000'000ll * i, 10'000'000, static_cast<std::uint64_t>(i)};
      command_.course_rad = 0.001 * (i % 100);
      fulmar_output outputs[2] = {{&attitude_, nullptr, tick.now_ns, 0, 0},
                                  {&probe_, nullptr, tick.now_ns, 0, 0}};
      const std::int64_t begin = now_ns();
      const std::uint32_t status = c_.step(instance_, &tick, inputs_, outputs, &error);
      each.push_back(1e-3 * static_cast<double>(now_ns() - begin));
      if (status != FULMAR_OK) throw std::runtime_error(error.text);
      if (pause_ns > 0 && asleep) {
        const timespec pause{0, pause_ns};
        nanosleep(&pause, nullptr);
      } else {
        for (const std::int64_t end = begin + pause_ns; now_ns() < end;) continue;
      }
    }
    std::sort(each.begin(), each.end());
    return {each[each.size() / 2], each[each.size() * 99 / 100], each.back()};
  }

 private:
  const fulmar_component& c_;
  void* instance_ = nullptr;
  fulmar::VehicleState state_;
  fulmar::GuidanceCommand command_;
  fulmar::AttitudeCommand attitude_;
  double probe_ = 0;
  fulmar_input inputs_[2] = {};
};

std::string text_of(const char* file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

int main(int argc, char** argv) {
  const bool json = argc > 1 && std::strcmp(argv[1], "--json") == 0;
  try {
    const fulmar_plugin& python = entry_of(FULMAR_PYTHON_PLUGIN);
    const std::string text = text_of(FULMAR_LAW_PY);
    fulmar_error error{};
    const fulmar_plugin* script = python.open_script(FULMAR_LAW_PY, text.data(), text.size(), &error);
    if (script == nullptr) throw std::runtime_error(error.text);
    Stepper in_python(script->components[0]), in_cpp(entry_of(FULMAR_LAW_SO).components[0]);
    const struct {
      const char* name;
      int steps;
      std::int64_t pause_ns;
      bool asleep;
    } ways[] = {{"at once", 200'000, 0, false},
                {"100_hz, core kept awake", 500, 10'000'000, false},
                {"100_hz, asleep between", 500, 10'000'000, true}};
    std::string out = "{";
    for (const auto& way : ways) {
      const Times bare = in_cpp.run(way.steps, way.pause_ns, way.asleep),
                  step = in_python.run(way.steps, way.pause_ns, way.asleep);
      char line[320];
      std::snprintf(line, sizeof line,
                    json ? "%s\n  \"%s\": {\"cpp_p50_us\": %.3f, \"cpp_p99_us\": %.3f, \"excess_p50_us\": "
                           "%.3f, \"python_p50_us\": %.3f, "
                           "\"python_p99_us\": %.3f}"
                         : "%s%s: C++ %.2f us p50, %.2f us p99; excess of Python %.2f us p50; Python %.2f us "
                           "p50, %.2f us p99\n",
                    json && out.size() > 1 ? "," : "", way.name, bare.p50_us, bare.p99_us,
                    step.p50_us - bare.p50_us, step.p50_us, step.p99_us);
      if (json)
        out += line;
      else
        std::printf("%s", line);
    }
    if (json) std::printf("%s\n}\n", out.c_str());
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
