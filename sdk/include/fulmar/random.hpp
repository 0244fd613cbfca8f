// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that are equal for equal seeds on every system: std::normal_distribution differs between
// standard libraries. Sources: Blackman & Vigna, xoshiro256++ 1.0 and splitmix64 (public domain); Doornik,
// "An improved ziggurat method" (2005).
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace fulmar {

/// One step of splitmix64: turns any counter into well-mixed bits.
constexpr std::uint64_t splitmix64(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// Seed for stream `stream` of a component: the number of draws of one stream does not change another.
constexpr std::uint64_t mix_seed(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t state = splitmix64(seed) ^ stream;
  return splitmix64(state);
}

namespace detail {

/// Layers of equal area under exp(-x^2/2).
struct Ziggurat {
  static constexpr std::size_t layers = 128;
  static constexpr double tail = 3.442619855899;       ///< start of the tail
  static constexpr double area = 9.91256303526217e-3;  ///< area of each layer
  std::array<double, layers + 1> edge{};
  std::array<double, layers> ratio{};  ///< part of a layer below the curve over its whole height

  Ziggurat() {
    double f = std::exp(-0.5 * tail * tail);
    edge[0] = area / f;
    edge[1] = tail;
    for (std::size_t i = 2; i < layers; ++i) {
      edge[i] = std::sqrt(-2 * std::log(area / edge[i - 1] + f));
      f = std::exp(-0.5 * edge[i] * edge[i]);
    }
    edge[layers] = 0;
    for (std::size_t i = 0; i < layers; ++i) ratio[i] = edge[i + 1] / edge[i];
  }
  static const Ziggurat& table() {
    static const Ziggurat ziggurat;
    return ziggurat;
  }
};

}  // namespace detail

class Random {
 public:
  explicit Random(std::uint64_t seed) : ziggurat_(&detail::Ziggurat::table()) {
    for (auto& word : state_) word = splitmix64(seed);
  }

  std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Mean 0, standard deviation 1.
  double normal() {
    const auto& z = *ziggurat_;
    for (;;) {
      const std::uint64_t word = bits();
      const std::size_t i = word & (detail::Ziggurat::layers - 1);
      const double u = static_cast<double>(static_cast<std::int64_t>(word) >> 11) *
                       0x1p-52;  // [-1, 1), from bits other than those of i
      const double x = u * z.edge[i];
      if (std::abs(u) < z.ratio[i]) return x;
      if (i == 0) return normal_tail(u < 0);
      const double f0 = std::exp(-0.5 * (z.edge[i] * z.edge[i] - x * x));
      const double f1 = std::exp(-0.5 * (z.edge[i + 1] * z.edge[i + 1] - x * x));
      if (f1 + uniform() * (f0 - f1) < 1) return x;
    }
  }

 private:
  double normal_tail(bool negative) {  // Marsaglia (1964)
    for (;;) {
      const double x = std::log(1 - uniform()) / detail::Ziggurat::tail;
      const double y = std::log(1 - uniform());
      if (-2 * y >= x * x) return negative ? x - detail::Ziggurat::tail : detail::Ziggurat::tail - x;
    }
  }

  std::array<std::uint64_t, 4> state_{};
  const detail::Ziggurat* ziggurat_;
};

}  // namespace fulmar
